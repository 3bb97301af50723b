//! The traits of methods of integration, for a [`System`] to name one: [`Adaptive`] under error control,
//! [`FixedStep`] in steps of the caller's.

use super::System;
use super::error::{Cause, MotionError};
use super::limits::Limits;
use super::state::State;
use crate::number::elements::array;
use crate::number::real::{Ordered, Real};

/// A method that takes steps of a size chosen by the caller.
#[diagnostic::on_unimplemented(
    message = "`{Self}` takes no fixed steps of `{S}`",
    label = "no method of fixed steps for this system",
    note = "methods of fixed steps are `Jet<8>` (or another order), `Rk4`, `Leapfrog`, `Gauss4` and their kin",
    note = "methods under error control, such as `Dop853`, are for `simulate_with::<Dop853>(…)`"
)]
pub trait FixedStep<S: System<N, K>, const N: usize, const K: usize> {
    /// The memory of the method between steps. It belongs to one system with its constants. It survives
    /// failed steps and changes of the inputs, so a method checks whether it still applies.
    type Memory: Copy + core::fmt::Debug;

    /// Whether it follows contacts and dry friction.
    #[doc(hidden)]
    const SWITCHES: bool = false;

    /// The memory before the first step.
    fn begin(system: &S) -> Self::Memory;

    /// The state after a step of `h` from `from`, with the inputs `u` held. The time of the result is `from.t
    /// + h`. A result that is not finite is left to the caller.
    ///
    /// # Errors
    /// Why the step could not be taken: constraints or switches that do not allow it, or equations of an
    /// implicit method that were not solved.
    fn step(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        from: &State<S::Scalar, N>,
        h: S::Scalar,
        u: &[S::Scalar; K],
    ) -> Result<State<S::Scalar, N>, Cause>;
}

/// The polynomial of a step.
#[derive(Clone, Copy, Debug)]
pub struct Terms<'a, R, const N: usize> {
    /// Terms of the coordinates, from the first order on, in a unit of time of the method.
    pub q: &'a [[R; N]],
    /// Terms of the velocities.
    pub v: &'a [[R; N]],
    /// The length of the step in that unit.
    pub length: R,
    /// The unit \[s].
    pub unit: R,
    /// The residue of rounding of the time of the start \[s].
    pub residue: R,
    /// Terms of the reactions from order zero on, the rows of an order side by side. Empty where they are not
    /// known.
    pub reactions: &'a [R],
    /// Terms of the functions that the series follows, from the first order on, likewise.
    pub functions: &'a [R],
    /// The relative truncation error of the polynomial, where no tolerance bounds it.
    pub left: R,
}

impl<R: Real, const N: usize> Terms<'_, R, N> {
    /// Σ |summands| of the state after a part of the step, which bound its rounding errors.
    pub(crate) fn sizes(&self, start: &State<R, N>, part: R) -> State<R, N> {
        let theta = (part * self.length).abs();
        let sums = |numbers: &[R; N], rows: &[[R; N]]| {
            let gains = rows
                .iter()
                .rev()
                .fold([R::zero(); N], |sums, row| array(|i| R::mul_add(sums[i], theta, row[i].abs())));
            array(|i| R::mul_add(gains[i], theta, numbers[i].abs()))
        };
        let t = start.t.abs() + (theta * self.unit).abs();
        State { t, q: sums(&start.q, self.q), v: sums(&start.v, self.v) }
    }
}

/// Counts of a motion so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Steps {
    /// Steps taken.
    pub accepted: u64,
    /// Steps tried and repeated with a shorter length.
    pub rejected: u64,
    /// Evaluations of the accelerations, or Taylor expansions.
    pub evaluations: u64,
}

/// A method under error control, for motions with inputs from `C`. It may be ahead of the state that its
/// caller sees, and goes on from the ends of its own steps.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not simulate `{S}` under error control",
    label = "no adaptive method of this system",
    note = "`simulate(…)` takes the best adaptive method of a system, and `simulate_with` takes `Dop853`, or `Jets` for a smooth system",
    note = "methods of fixed steps, such as `Rk4`, are for `stepper::<Rk4>(…)`, where you choose the steps"
)]
pub trait Adaptive<S: System<N, K> + ?Sized, C, const N: usize, const K: usize> {
    /// The memory of a motion by this method between steps.
    type Memory: Copy + core::fmt::Debug;

    /// Whether steps are as long as the caller says, however fast the motion changes.
    const IS_PACED: bool = false;
    /// Whether a step knows how reactions change on it. If not, what holds is asked where a step begins.
    const FOLLOWS_REACTIONS: bool = true;

    /// Whether its steps may be blind to functions of the system that are narrow.
    const IS_BLIND: bool = false;

    /// The memory of a motion that begins at a state.
    fn begin(system: &S, start: State<S::Scalar, N>) -> Self::Memory
    where
        S::Scalar: Ordered;

    /// Goes on from a state, as after a change of the inputs.
    fn restart(memory: &mut Self::Memory, state: State<S::Scalar, N>)
    where
        S::Scalar: Ordered;

    /// Begins at a state that is not the motion's own.
    fn begin_anew(memory: &mut Self::Memory, state: State<S::Scalar, N>)
    where
        S::Scalar: Ordered,
    {
        Self::restart(memory, state);
    }

    /// The start of the last step.
    fn start(memory: &Self::Memory) -> &State<S::Scalar, N>;

    /// The end of the last step.
    fn end(memory: &Self::Memory) -> &State<S::Scalar, N>;

    /// One step from the end of the last one towards time `t` \[s], and perhaps beyond it.
    ///
    /// # Errors
    /// As [`Adaptive::advance`].
    fn step(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        control: &C,
        limits: &Limits<S::Scalar>,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> Result<(), MotionError<S::Scalar>>
    where
        S::Scalar: Ordered;

    /// The first step of a motion that begins near a configuration in which constraints depend on each other.
    /// It leads across that configuration if possible. False for a method that evaluates inside its steps.
    fn pass(
        _memory: &mut Self::Memory,
        _system: &S,
        _constants: &S::Constants,
        _control: &C,
        _limits: &Limits<S::Scalar>,
        _t: S::Scalar,
        _attempts: &mut u64,
    ) -> bool
    where
        S::Scalar: Ordered,
    {
        false
    }

    /// The cost of the motion so far.
    fn counts(memory: &Self::Memory) -> Steps;

    /// The memory of a motion that goes on from a state by the equations of another system of the same kind,
    /// which knows roughly how long its steps are.
    fn go_on(memory: &mut Self::Memory, system: &S, state: State<S::Scalar, N>)
    where
        S::Scalar: Ordered,
    {
        *memory = Self::begin(system, state);
    }

    /// The polynomial of the last step; `None` for a method that has none.
    fn terms(_memory: &Self::Memory) -> Option<Terms<'_, S::Scalar, N>>
    where
        S::Scalar: Ordered,
    {
        None
    }

    /// The state at a part of the last step, from 0 to 1. A time could not name it as exactly, because times
    /// have finite resolution.
    ///
    /// # Errors
    /// As [`Adaptive::advance`].
    fn within(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        control: &C,
        limits: &Limits<S::Scalar>,
        part: S::Scalar,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>>
    where
        S::Scalar: Ordered;

    /// The state at exactly time `t` \[s], as accurate as the ends of steps are.
    ///
    /// # Errors
    /// Why and when the motion cannot go on; [`Adaptive::end`] is then the last good state.
    fn advance(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        control: &C,
        limits: &Limits<S::Scalar>,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>>
    where
        S::Scalar: Ordered;

    /// The state at time `t` \[s] without a step that ends there, accurate to the tolerance.
    ///
    /// # Errors
    /// As [`Adaptive::advance`].
    fn sample(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        control: &C,
        limits: &Limits<S::Scalar>,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>>
    where
        S::Scalar: Ordered;
}
