//! [`Paced`]: one Taylor series to the end of a step that the caller chose, as a part of a motion whose
//! equations switch.
//!
//! There is no error control, as in [`Jet`](crate::Jet). A step is halved only for the sake of constraints:
//! where bringing its end back onto them would change it by more than the step itself, or where there are
//! several and its series does not tell the motion. Beside a configuration in which they depend on each
//! other it is also halved where it changes an energy that is conserved.

use super::super::jet::is_sound;
use super::super::landing::energy::is_kept;
use super::JetsMemory;
use crate::number::real::{Ordered, Real, larger};
use crate::system::attitude;
use crate::system::control::Held;
use crate::system::diagnose;
use crate::system::error::{Cause, MotionError};
use crate::system::limits::Limits;
use crate::system::method::{Adaptive, Steps, Terms};
use crate::system::smooth::Smooth;
use crate::system::state::State;

/// The most halvings of a step.
const HALVINGS: i32 = 6;

/// Taylor steps of order `ORDER` that end where the caller says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Paced<const ORDER: usize>;

/// The memory of a step.
type Memory<S, const N: usize, const K: usize, const ORDER: usize> =
    <Paced<ORDER> as Adaptive<S, Held<<S as crate::System<N, K>>::Scalar, K>, N, K>>::Memory;

impl<C: Copy, T: Copy + Default, R: Ordered, const N: usize, const P: usize> JetsMemory<C, T, R, N, P> {
    /// Counts time from another instant on.
    pub(crate) fn count_from(&mut self, instant: R) {
        self.start.t -= instant;
        self.end.t -= instant;
    }
}

/// Expands one series about the start of the memory, for a step of `unit` \[s]. False if the step is too
/// long.
fn reach<S, const N: usize, const K: usize, const ORDER: usize>(
    memory: &mut Memory<S, N, K, ORDER>,
    system: &S,
    constants: &S::Constants,
    inputs: &[S::Scalar; K],
    unit: S::Scalar,
) -> Result<bool, Cause>
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    let from = memory.start;
    memory.counts.evaluations += 1;
    (memory.unit, memory.is_as_expanded) = (unit, true);
    let JetsMemory { constants: of_jets, tables, series, .. } = memory;
    let State { t, q, v } = &from;
    if !system.jet_at(of_jets, *t, q, v, inputs, unit, ORDER, tables, series) {
        return Err(Cause::NotFinite);
    }
    if S::COUPLED && !is_sound(series, &from) {
        return Ok(false);
    }
    memory.reach(num_traits::One::one());
    if !memory.end.is_finite() {
        return Err(Cause::NotFinite);
    }
    if !S::CONSTRAINED {
        return Ok(true);
    }
    let mut end = memory.end;
    match system.project_at(constants, &mut end, Some(&from)) {
        Err(Cause::StepTooLong) => return Ok(false),
        projected => projected?,
    }
    memory.correct(end);
    if S::COUPLED && S::CONSERVES_ENERGY && !is_kept(system, constants, &from, &end) {
        // If constraints are far from depending on each other, the length that the caller chose has lost the
        // energy, and the step stands.
        return Ok(system.land_at(constants, &mut end, None)?.independence.are_far_apart());
    }
    Ok(true)
}

/// One step to time `t`, or less far if that is too long for one.
fn advance<S, const N: usize, const K: usize, const ORDER: usize>(
    memory: &mut Memory<S, N, K, ORDER>,
    system: &S,
    constants: &S::Constants,
    inputs: &[S::Scalar; K],
    t: S::Scalar,
    attempts: &mut u64,
) -> Result<(), Cause>
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    if let Some(settled) = attitude::settle(S::ORIENTATIONS, &memory.end) {
        memory.begin(settled);
    }
    (memory.start, memory.residue) = (memory.end, memory.end_residue);
    let left = (t - memory.start.t) - memory.residue.t;
    for halvings in 0..=HALVINGS {
        if *attempts == 0 {
            return Err(memory.stay(Cause::TooManySteps));
        }
        *attempts -= 1;
        let unit = left * S::Scalar::from_f64(0.5).powi(halvings);
        match reach::<S, N, K, ORDER>(memory, system, constants, inputs, unit) {
            Ok(true) => {
                if halvings == 0 {
                    (memory.end.t, memory.end_residue.t) = (t, num_traits::Zero::zero());
                }
                memory.counts.accepted += 1;
                return Ok(());
            }
            Ok(false) => memory.counts.rejected += 1,
            Err(cause) => return Err(memory.stay(cause)),
        }
    }
    let here = memory.series.independence;
    let undetermined =
        Cause::Undetermined { constraint: here.weakest, name: S::NAMES.constraint(here.weakest) };
    let is_known = here.rank < here.rows || here.is_determined();
    Err(memory.stay(if is_known { Cause::StepTooLong } else { undetermined }))
}

impl<S, const N: usize, const K: usize, const ORDER: usize> Adaptive<S, Held<S::Scalar, K>, N, K>
    for Paced<ORDER>
where
    S: Smooth<N, K>,
{
    type Memory = JetsMemory<S::JetConstants, S::Tables<ORDER>, S::Scalar, N, ORDER>;
    const IS_PACED: bool = true;
    // Reactions have two orders fewer than coordinates: below the fourth order straight lines at best.
    const FOLLOWS_REACTIONS: bool = ORDER > 3;

    fn begin(system: &S, start: State<S::Scalar, N>) -> Self::Memory
    where
        S::Scalar: Ordered,
    {
        let mut memory = JetsMemory::new(system.jet_constants(), start, S::ORIENTATIONS);
        memory.orders = ORDER;
        memory
    }

    fn restart(memory: &mut Self::Memory, state: State<S::Scalar, N>)
    where
        S::Scalar: Ordered,
    {
        memory.begin(state);
    }

    fn start(memory: &Self::Memory) -> &State<S::Scalar, N> {
        &memory.start
    }

    fn end(memory: &Self::Memory) -> &State<S::Scalar, N> {
        &memory.end
    }

    fn step(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        control: &Held<S::Scalar, K>,
        _limits: &Limits<S::Scalar>,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> Result<(), MotionError<S::Scalar>>
    where
        S::Scalar: Ordered,
    {
        advance::<S, N, K, ORDER>(memory, system, constants, &control.0, t, attempts).map_err(|cause| {
            let State { t, q, v } = memory.end;
            let cause = match cause {
                Cause::NotFinite => diagnose(system, constants, t, &q, &v),
                cause => cause,
            };
            MotionError { cause, t }
        })
    }

    fn counts(memory: &Self::Memory) -> Steps {
        memory.counts
    }

    fn go_on(memory: &mut Self::Memory, system: &S, state: State<S::Scalar, N>)
    where
        S::Scalar: Ordered,
    {
        memory.constants = system.jet_constants();
        memory.begin(state);
        memory.counts = Steps::default();
    }

    fn terms(memory: &Self::Memory) -> Option<Terms<'_, S::Scalar, N>>
    where
        S::Scalar: Ordered,
    {
        let terms = memory.terms(S::followed);
        Some(Terms { left: left(&terms), ..terms })
    }

    fn within(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        _control: &Held<S::Scalar, K>,
        _limits: &Limits<S::Scalar>,
        part: S::Scalar,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>>
    where
        S::Scalar: Ordered,
    {
        let state = memory.at_part(part);
        onto(memory, system, constants, state)
    }

    fn advance(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        control: &Held<S::Scalar, K>,
        limits: &Limits<S::Scalar>,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>>
    where
        S::Scalar: Ordered,
    {
        Self::sample(memory, system, constants, control, limits, t, attempts)
    }

    fn sample(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        control: &Held<S::Scalar, K>,
        limits: &Limits<S::Scalar>,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>>
    where
        S::Scalar: Ordered,
    {
        while !memory.covers(t) {
            Self::step(memory, system, constants, control, limits, t, attempts)?;
        }
        let state = memory.at(t);
        onto(memory, system, constants, state)
    }
}

/// The share of the last two terms in the change of a velocity over a step, the largest of all.
fn left<R: Ordered, const N: usize>(terms: &Terms<'_, R, N>) -> R {
    let length = terms.length.abs();
    let sizes = |i: usize| terms.v.iter().rev().fold(R::zero(), |sum, row| (sum + row[i].abs()) * length);
    let last = |i: usize| {
        let last = terms.v.iter().enumerate().rev().take(2);
        last.fold(R::zero(), |sum, (order, row)| sum + row[i].abs() * length.powi(order as i32 + 1))
    };
    (0..N).fold(R::zero(), |left, i| {
        let (last, size) = (last(i), sizes(i));
        if size.is_positive() { larger(left, last / size) } else { left }
    })
}

/// A state on the step, moved onto the constraints like its ends.
fn onto<S, const N: usize, const K: usize, const ORDER: usize>(
    memory: &Memory<S, N, K, ORDER>,
    system: &S,
    constants: &S::Constants,
    mut state: State<S::Scalar, N>,
) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>>
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    if S::CONSTRAINED && state.t != memory.end.t {
        let failed = |cause| MotionError { cause, t: memory.end.t };
        system.project_at(constants, &mut state, None).map_err(failed)?;
    }
    Ok(state)
}
