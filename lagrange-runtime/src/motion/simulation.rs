//! [`Simulation`]: a motion under error control, its samples and its inputs.
//!
//! The integrator takes steps of its own choice and may be ahead of the state that the caller sees. Between
//! their ends it has a polynomial. That of [`Jets`](crate::Jets) is as accurate as the steps themselves, so
//! that neither [`Simulation::advance_to`] nor [`Simulation::every`] ever shortens one. That of [`Dop853`]
//! has the error of the tolerance: `every` reads from it, `advance_to` shortens the last step to land exactly
//! on its target. After a sample inside a step the motion goes on from the ends of that step, never from the
//! sample, so sampling costs no accuracy. A change of inputs does restart at the state that the caller sees.

use crate::constraints::{Constrained, Reactions};
use crate::integrator::{Adaptive, Dop853};
use crate::number::real::Ordered;
pub use crate::system::control::{Control, Feedback, Held};
use crate::system::error::{Cause, MotionError, magnitude};
use crate::system::limits::Limits;
pub use crate::system::method::Steps;
use crate::system::state::State;
use crate::system::{System, check_masses};

/// A motion of `system` by method `M`, with inputs from `C`.
#[derive(Clone, Copy, Debug)]
pub struct Simulation<'a, S, C, M, const N: usize, const K: usize = 0>
where
    S: System<N, K>,
    M: Adaptive<S, C, N, K>,
{
    pub(crate) system: &'a S,
    pub(crate) constants: S::Constants,
    pub(crate) control: C,
    pub(crate) limits: Limits<S::Scalar>,
    pub(crate) memory: M::Memory,
    /// The state that the caller sees: the end of the step, or a sample inside it.
    pub(crate) state: State<S::Scalar, N>,
    /// Whether the state that the motion started from has been checked.
    begun: bool,
    /// The time of the last event, and its uncertainty \[s].
    pub(crate) event: Option<[S::Scalar; 2]>,
}

impl<'a, S, M, const N: usize, const K: usize> Simulation<'a, S, Held<S::Scalar, K>, M, N, K>
where
    S: System<N, K>,
    S::Scalar: Ordered,
    M: Adaptive<S, Held<S::Scalar, K>, N, K>,
{
    /// A motion from `start` with inputs at zero.
    #[inline]
    pub fn new(system: &'a S, start: State<S::Scalar, N>) -> Self {
        let control = Held([num_traits::Zero::zero(); K]);
        let memory = M::begin(system, start);
        let (constants, limits) = (system.constants(), Limits::new());
        Self { system, constants, control, limits, memory, state: start, begun: false, event: None }
    }

    /// Holds these inputs.
    #[inline]
    #[must_use]
    pub fn with_inputs(mut self, inputs: [S::Scalar; K]) -> Self {
        self.set_inputs(inputs);
        self
    }

    /// Holds these inputs from [`Simulation::state`] on. The motion goes on from exactly that state.
    #[inline]
    pub fn set_inputs(&mut self, inputs: [S::Scalar; K]) {
        if inputs != self.control.0 {
            self.control.0 = inputs;
            M::restart(&mut self.memory, self.state);
        }
    }

    /// Takes the inputs from a function of the state (continuous feedback) from here on, by [`Dop853`]:
    /// nothing is known of the derivatives of such a function.
    ///
    /// A system with contacts or dry friction goes through them with inputs that are held. There this does
    /// not compile: write a law of the state as a `#[force]`, or set the inputs at the times of a controller
    /// (`set_inputs`, then `advance_by`).
    #[inline]
    #[must_use]
    pub fn with_control<F>(self, control: F) -> Simulation<'a, S, Feedback<F>, Dop853, N, K>
    where
        F: Fn(&State<S::Scalar, N>) -> [S::Scalar; K],
    {
        let Self { system, constants, limits, state, .. } = self;
        let memory = <Dop853 as Adaptive<S, Feedback<F>, N, K>>::begin(system, state);
        let control = Feedback(control);
        Simulation { system, constants, control, limits, memory, state, begun: false, event: None }
    }
}

impl<'a, S, C, M, const N: usize, const K: usize> Simulation<'a, S, C, M, N, K>
where
    S: System<N, K>,
    S::Scalar: Ordered,
    C: Control<S::Scalar, N, K>,
    M: Adaptive<S, C, N, K>,
{
    /// The system that moves: its parameters.
    #[inline]
    pub fn system(&self) -> &'a S {
        self.system
    }

    /// Tolerated local error, relative to the size of each coordinate and velocity in a step. Default 1e-10,
    /// for `f32` 100 ε. [`Jets`](crate::Jets) take their order from it.
    #[inline]
    #[must_use]
    pub fn with_tolerance(mut self, tolerance: S::Scalar) -> Self {
        (self.limits.relative, self.limits.absolute) = (tolerance, None);
        self
    }

    /// Tolerated local error of a component y: `absolute` + `relative` · |y|. Below rounding a tolerance
    /// means rounding.
    #[inline]
    #[must_use]
    pub fn with_tolerances(mut self, relative: S::Scalar, absolute: S::Scalar) -> Self {
        (self.limits.relative, self.limits.absolute) = (relative, Some(absolute));
        self
    }

    /// Longest step \[s]. Set it for systems in which something short happens that a long step might jump
    /// over.
    #[inline]
    #[must_use]
    pub fn with_step_limit(mut self, longest: S::Scalar) -> Self {
        self.limits.step = Some(longest);
        self
    }

    /// The largest number of steps, rejected ones included, for one call of `advance_to` or one sample.
    /// Parts of a step on which switches have to be looked for by themselves count as well.
    /// Default 10 million.
    #[inline]
    #[must_use]
    pub fn with_max_steps(mut self, steps: u64) -> Self {
        self.limits.attempts = steps;
        self
    }

    /// The limits, to be changed in place: the memory of a motion with derivatives is large.
    #[inline]
    pub(crate) fn limits(&mut self) -> &mut Limits<S::Scalar> {
        &mut self.limits
    }

    /// The source of the inputs.
    #[inline]
    pub fn control(&self) -> &C {
        &self.control
    }

    /// The state: the last one reached or sampled without error.
    #[inline]
    pub fn state(&self) -> &State<S::Scalar, N> {
        &self.state
    }

    /// Goes on from another state: a thrust, a reset, a bounce. It is checked as the start of a motion is,
    /// when the motion goes on. The inputs and the length of the steps stay what they are, and a state on a
    /// kink is on the side of it on which the motion was. Contacts and friction begin anew.
    #[inline]
    pub fn set_state(&mut self, state: State<S::Scalar, N>) {
        let is_other = state != self.state;
        self.state = state;
        self.begun = false;
        if is_other {
            M::begin_anew(&mut self.memory, state);
        } else {
            M::restart(&mut self.memory, state);
        }
    }

    /// Time of the state \[s].
    #[inline]
    pub fn t(&self) -> S::Scalar {
        self.state.t
    }

    /// T + V at the state.
    #[inline]
    pub fn energy(&self) -> S::Scalar {
        self.system.energy_at(&self.constants, self.state.t, &self.state.q, &self.state.v)
    }

    /// Inputs at the state.
    #[inline]
    pub fn inputs(&self) -> [S::Scalar; K] {
        self.control.inputs(&self.state)
    }

    /// The cost of the motion so far.
    #[inline]
    pub fn steps(&self) -> Steps {
        M::counts(&self.memory)
    }

    /// Moves to exactly time `t` \[s], forward or backward, and returns the state there.
    ///
    /// # Errors
    /// [`Cause::InvalidTime`], `InvalidTolerance`, `InvalidStep` for bad arguments; [`Cause::NotFinite`] for
    /// a bad start or bad parameters; [`Cause::PositionViolated`] or `VelocityViolated` for a start off the
    /// constraints; the system's own cause, `NotFinite`, [`Cause::StepTooSmall`] or `ToleranceTooFine` where
    /// the motion cannot go on, with the time; [`Cause::TooManySteps`]. The state is then the last good one
    /// before that.
    #[inline]
    pub fn advance_to(&mut self, t: S::Scalar) -> Result<&State<S::Scalar, N>, MotionError<S::Scalar>> {
        self.check(t)?;
        self.begin()?;
        if t != self.state.t {
            let mut attempts = self.limits.attempts;
            let Self { system, constants, control, limits, memory, .. } = self;
            match M::advance(memory, *system, constants, control, limits, t, &mut attempts) {
                Ok(state) => self.state = state,
                Err(error) => {
                    let reached = *M::end(memory);
                    // After a rewind the sample may be further than what was reached.
                    if (t - reached.t) * (t - reached.t) < (t - self.state.t) * (t - self.state.t) {
                        self.state = reached;
                    }
                    return Err(error);
                }
            }
        }
        Ok(&self.state)
    }

    /// Moves by `dt` \[s], backward if negative.
    ///
    /// # Errors
    /// As [`Simulation::advance_to`]; [`Cause::TimeTooCoarse`] where `dt` is lost in the sum with the time.
    #[inline]
    pub fn advance_by(&mut self, dt: S::Scalar) -> Result<&State<S::Scalar, N>, MotionError<S::Scalar>> {
        use crate::number::real::Real;
        let (from, to) = (self.state.t, self.state.t + dt);
        if to == from && from.is_finite() && dt != num_traits::Zero::zero() {
            return Err(too_coarse(from, dt));
        }
        self.advance_to(to)
    }

    /// States at t + k·`dt` for k = 0, 1, 2, … from the present t on, backward if `dt` \[s] is negative.
    ///
    /// The iterator does not end by itself. After an error it returns the error once and then `None`. The
    /// state of the motion is that of the last sample.
    #[inline]
    pub fn every(&mut self, dt: S::Scalar) -> Samples<'_, Self, S::Scalar> {
        let start = self.state.t;
        Samples { motion: self, start, dt, next: Some(0) }
    }

    /// Moves to time `t` by interpolation within the integrator's own steps.
    #[inline]
    fn sample(&mut self, t: S::Scalar) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>> {
        self.check(t)?;
        self.begin()?;
        if t != self.state.t {
            let mut attempts = self.limits.attempts;
            let Self { system, constants, control, limits, memory, .. } = self;
            self.state = M::sample(memory, *system, constants, control, limits, t, &mut attempts)?;
        }
        Ok(self.state)
    }

    /// The state at a time within the last step, without moving there.
    #[inline]
    pub(crate) fn peek(&mut self, t: S::Scalar) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>> {
        let Self { system, constants, control, limits, memory, .. } = self;
        M::sample(memory, *system, constants, control, limits, t, &mut limits.attempts.clone())
    }

    /// Checks the start: the state must be finite, masses positive and constraints satisfied. Removes
    /// rounding errors from a start on constraints.
    #[inline]
    pub(crate) fn begin(&mut self) -> Result<(), MotionError<S::Scalar>> {
        if self.begun {
            return Ok(());
        }
        if S::READ && self.steps().evaluations == 0 {
            crate::system::reading::checked(self.system, &self.state, &self.control.inputs(&self.state))?;
        }
        let t = self.state.t;
        let failed = |cause| MotionError { cause, t };
        if !self.state.is_finite() {
            return Err(failed(Cause::NotFinite));
        }
        check_masses(self.system, &self.constants, &self.state)?;
        if S::CONSTRAINED {
            self.system.begin_at(&self.constants, &mut self.state).map_err(failed)?;
            M::restart(&mut self.memory, self.state);
        }
        self.begun = true;
        Ok(())
    }

    /// The state in the regime that it begins with: on the contacts that are closed.
    pub(crate) fn settled(&mut self) -> Result<&State<S::Scalar, N>, MotionError<S::Scalar>> {
        self.begin()?;
        let Self { system, constants, control, limits, memory, state, .. } = self;
        *state =
            M::advance(memory, *system, constants, control, limits, state.t, &mut limits.attempts.clone())?;
        Ok(&self.state)
    }

    /// Refuses a bad target or bad limits.
    #[inline]
    pub(crate) fn check(&self, t: S::Scalar) -> Result<(), MotionError<S::Scalar>> {
        use crate::number::real::Real;
        let verdict = if t.is_finite() { self.limits.check() } else { Err(Cause::InvalidTime) };
        verdict.map_err(|cause| MotionError { cause, t: self.state.t })
    }
}

impl<S, C, M, const N: usize, const K: usize> Simulation<'_, S, C, M, N, K>
where
    S: Constrained<N, K>,
    S::Scalar: Ordered,
    C: Control<S::Scalar, N, K>,
    M: Adaptive<S, C, N, K>,
{
    /// The multipliers of all constraints at the state, by name: `motion.reactions().rod`.
    #[inline]
    pub fn reactions(&self) -> Reactions<S::Reactions> {
        let State { t, q, v } = &self.state;
        self.system.reactions_at(&self.constants, *t, q, v, &self.inputs())
    }
}

/// The error of a step that is lost in the sum with a time.
#[cold]
fn too_coarse<R: Ordered>(t: R, dt: R) -> MotionError<R> {
    // Twice a step that is lost is no longer than the spacing: the first that is not lost leads to the next
    // number.
    let mut spacing = dt;
    while t + spacing == t {
        spacing += spacing;
    }
    let cause = Cause::TimeTooCoarse { spacing: magnitude((t + spacing - t).abs().largest()) };
    MotionError { cause, t }
}

/// Samples of a motion at equal intervals; see [`Simulation::every`].
#[derive(Debug)]
pub struct Samples<'m, M, R> {
    motion: &'m mut M,
    start: R,
    dt: R,
    /// Number of the next sample; `None` after an error.
    next: Option<u64>,
}

impl<S, C, M, const N: usize, const K: usize> Iterator
    for Samples<'_, Simulation<'_, S, C, M, N, K>, S::Scalar>
where
    S: System<N, K>,
    S::Scalar: Ordered,
    C: Control<S::Scalar, N, K>,
    M: Adaptive<S, C, N, K>,
{
    type Item = Result<State<S::Scalar, N>, MotionError<S::Scalar>>;

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        use crate::number::real::Real;
        let k = self.next?;
        // A product, not a sum: the time of a late sample is as exact as that of an early one.
        let t = self.start + S::Scalar::from_f64(k as f64) * self.dt;
        let result = if !self.dt.is_finite() || self.dt == num_traits::Zero::zero() {
            Err(MotionError { cause: Cause::InvalidStep, t: self.start })
        } else if k > 0 && t == self.motion.state.t && t.is_finite() {
            Err(too_coarse(t, self.dt))
        } else {
            self.motion.sample(t)
        };
        self.next = result.is_ok().then_some(k.wrapping_add(1));
        Some(result)
    }
}

impl<S, C, M, const N: usize, const K: usize> core::iter::FusedIterator
    for Samples<'_, Simulation<'_, S, C, M, N, K>, S::Scalar>
where
    S: System<N, K>,
    S::Scalar: Ordered,
    C: Control<S::Scalar, N, K>,
    M: Adaptive<S, C, N, K>,
{
}

#[cfg(test)]
mod tests;
