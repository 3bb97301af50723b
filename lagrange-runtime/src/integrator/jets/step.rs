//! One step: expansion, length, end.

use super::super::hidden::{InEquations, Passage};
use super::super::landing::{Check, Determined, Landing};
use super::super::lengths::{Lengths, Verdict, wanted};
use super::super::step_size;
use super::super::vanishing::near_roots;
use super::expansion::{expand, too_small};
use super::leap::leap;
use super::probe::{self, Probe, faults_along};
use super::singular::{self, Beyond};
use super::{Jets, JetsMemory};
use crate::number::elements::Each;
use crate::number::real::{Ordered, Real, any, larger, smaller};
use crate::system::attitude;
use crate::system::control::Held;
use crate::system::error::Cause;
use crate::system::limits::Limits;
use crate::system::method::Adaptive;
use crate::system::smooth::Smooth;
use crate::system::state::State;

/// The largest ratio of a step of a constrained motion to the one before it. The end of every step is checked
/// anyway. This bound serves polynomials whose high coefficients cancel exactly and would allow any length:
/// it keeps the end within reach of the check.
const LONGER: f64 = 32.0;

/// One step from the end of the last one towards `target`: that of a series, or where none is long enough the
/// leap over a kink.
#[inline]
pub(super) fn step<S, const N: usize, const K: usize>(
    memory: &mut <Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    system: &S,
    constants: &S::Constants,
    control: &Held<S::Scalar, K>,
    limits: &Limits<S::Scalar>,
    target: S::Scalar,
    attempts: &mut u64,
) -> Result<(), Cause>
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    // The tables are those of a series again after every other step.
    let has_leapt = S::ROOTED && !memory.is_as_expanded && memory.last.is_positive();
    match stride(memory, system, constants, control, limits, target, attempts) {
        Err(Cause::StepTooSmall | Cause::NotFinite)
            if S::ROOTED && leap(memory, system, constants, control, limits, target, has_leapt) =>
        {
            Ok(())
        }
        stepped => stepped,
    }
}

/// The step of a series.
#[inline]
fn stride<S, const N: usize, const K: usize>(
    memory: &mut <Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    system: &S,
    constants: &S::Constants,
    control: &Held<S::Scalar, K>,
    limits: &Limits<S::Scalar>,
    target: S::Scalar,
    attempts: &mut u64,
) -> Result<(), Cause>
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    if let Some(settled) = attitude::settle(S::ORIENTATIONS, &memory.end) {
        <Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::restart(memory, settled);
        memory.prepare(limits);
    }
    (memory.start, memory.residue) = (memory.end, memory.end_residue);
    if !memory.start.is_finite() {
        return Err(Cause::NotFinite);
    }
    let left = target - memory.start.t;
    let begins = S::CONSTRAINED && memory.determined.is_none();
    let mut here = None;
    if begins {
        let footing = system.land_at(constants, &mut memory.start.clone(), None)?;
        memory.stand(&footing);
        here = Some(footing.independence);
    }
    let natural = expand(memory, system, control, limits, left, attempts)?;
    if let Some(here) = here {
        let first = (left, Beyond::Determined);
        if !here.is_determined()
            && singular::start(memory, system, constants, control, limits, first)
                .map_err(|cause| memory.stay(cause))?
        {
            memory.counts.accepted += 1;
            return Ok(());
        }
        memory.determined = Some(Determined::at_start(&here));
    }
    let resolution = memory.resolution();
    let is_free = natural.is_none();
    let mut natural = natural.unwrap_or_else(|| left.abs());
    // Coefficients do not show what rounding has hidden from them.
    if S::STEEP {
        // A target nearer than time resolves is no reason for a shorter step.
        let resolved = smaller(natural, S::Scalar::from_f64(2.0) * resolution);
        natural = larger(probe::restrained(natural, memory.last, left.abs()), resolved);
    } else if S::CONSTRAINED && memory.last.is_positive() {
        natural = smaller(natural, S::Scalar::from_f64(LONGER) * memory.last);
    }
    let length = limits.clip(natural);
    if !is_free && step_size::is_below(length, resolution) {
        return Err(too_small(memory));
    }
    // The difference of the times would not do, since rounding errors grow with time.
    let theta = length / memory.unit.abs();
    memory.reach(theta);
    memory.next = if is_free { num_traits::Zero::zero() } else { natural };
    // The end of a polynomial in time is told by the equations alone. A constrained step is always compared
    // with them.
    let hiding = InEquations { system, control, roots: true };
    if !S::CONSTRAINED && (S::STEEP || is_free || comes_near_roots(memory, &hiding, theta)) {
        let free = is_free.then_some(left);
        shorten(memory, system, constants, control, limits, (free, resolution))?;
    }
    if !memory.end.is_finite() {
        return Err(memory.stay(Cause::NotFinite));
    }
    if S::CONSTRAINED {
        let lengths = [theta, natural / memory.unit.abs()];
        land(memory, system, constants, control, limits, (lengths, left), attempts)?;
    }
    memory.last = (memory.end.t - memory.start.t).abs();
    memory.counts.accepted += 1;
    Ok(())
}

/// Ends a step of a constrained motion where it can be checked and the motion goes on well: at its present
/// length or near that. `measured` is that length, for which error control has measured the error; `natural`
/// is the length without a limit. Both are in units of the scaled time. Beyond `measured` only a part of
/// the error is known to be small.
#[inline]
fn land<S, const N: usize, const K: usize>(
    memory: &mut <Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    system: &S,
    constants: &S::Constants,
    control: &Held<S::Scalar, K>,
    limits: &Limits<S::Scalar>,
    ([measured, natural], left): ([S::Scalar; 2], S::Scalar),
    attempts: &mut u64,
) -> Result<(), Cause>
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    let (Some(so_far), Some(here)) = (memory.determined, memory.independence) else { return Ok(()) };
    let unit = memory.unit.abs();
    let mut theta = measured;
    // The length that leads across is looked for once: where the step begins or has ended beside such a
    // configuration.
    let mut is_beside = !here.are_far_apart();
    if is_beside && let Some(across) = beyond(memory, limits, theta) {
        theta = across;
        memory.reach(theta);
    }
    let mut lengths = Lengths::new(so_far, &here, limits.relative, [measured, natural, theta]);
    if !memory.last.is_positive() {
        lengths = lengths.on_the_way(left.abs() / unit);
    }
    loop {
        let check = Check { system, constants, inputs: &control.0, limits, from: &memory.start };
        let slopes = |theta| memory.series.slopes(theta, memory.orders).each(|slope| slope / memory.unit);
        let on_the_way = |landing: &Landing<S::Scalar, N>| {
            let state_at = |theta| memory.state_at(theta);
            let hiding = InEquations { system, control, roots: true };
            let passage = Passage { hiding: &hiding, state_at: &state_at, theta };
            // The end is checked beside this.
            let look = |theta, state: &State<S::Scalar, N>, is_end| {
                let agrees = is_end || check.agrees(state, &slopes(theta), landing);
                if agrees { num_traits::Zero::zero() } else { num_traits::One::one() }
            };
            !(S::STEEP || comes_near_roots(memory, &hiding, theta))
                || !any(faults_along(&passage, &memory.start, look))
        };
        let last_terms = |landing: &Landing<S::Scalar, N>| {
            theta <= measured
                || memory.last_terms(theta).iter().all(|term| check.is_small_along(term, landing))
        };
        let landed = check.land(&memory.end, Some(&slopes(theta))).map(|mut landing| {
            landing.is_right = landing.is_right && on_the_way(&landing) && last_terms(&landing);
            landing
        });
        let ends_beside = landed.as_ref().is_ok_and(|landing| !landing.footing.independence.are_far_apart());
        let cause = match lengths.judge(&check, theta, landed) {
            Verdict::Take(landing, determined) => {
                let (there, wanted) = (landing.footing.independence.least, wanted(limits.relative));
                if there < here.least && here.least < wanted {
                    let across = (left, Beyond::Wanted(wanted));
                    if singular::start(memory, system, constants, control, limits, across) == Ok(true) {
                        return Ok(());
                    }
                }
                memory.determined = Some(determined);
                memory.stand(&landing.footing);
                memory.correct(landing.end);
                return Ok(());
            }
            Verdict::Try { length, cause } => {
                theta = length;
                if ends_beside
                    && !core::mem::replace(&mut is_beside, true)
                    && let Some(across) = beyond(memory, limits, measured)
                {
                    lengths = lengths.based_on(across);
                    theta = across;
                }
                cause
            }
            Verdict::GiveUp(cause) => {
                let across = (left, Beyond::Better);
                return match singular::start(memory, system, constants, control, limits, across) {
                    Ok(true) => Ok(()),
                    _ => Err(memory.stay(cause)),
                };
            }
        };
        memory.counts.rejected += 1;
        if *attempts == 0 {
            return Err(memory.stay(Cause::TooManySteps));
        }
        *attempts -= 1;
        if step_size::is_below(theta * unit, memory.resolution()) {
            return Err(memory.stay(cause));
        }
        memory.reach(theta);
    }
}

/// The length, in units of the scaled time, that leads across a configuration in which constraints depend on
/// each other, if the rounding errors that grow there keep the step to the length `theta`.
#[cold]
#[inline(never)]
fn beyond<C, T, R, const N: usize>(memory: &JetsMemory<C, T, R, N>, limits: &Limits<R>, theta: R) -> Option<R>
where
    C: Copy,
    T: Copy + Default,
    R: Ordered,
{
    let unit = memory.unit.abs();
    let mut longest = limits.clip(memory.reach_across(limits, theta)? * unit);
    if memory.last.is_positive() {
        longest = probe::restrained(longest, memory.last, longest);
    }
    (longest > theta * unit).then(|| longest / unit)
}

/// Whether a root comes near zero in the first `theta` units, at whose end the memory is.
#[inline]
fn comes_near_roots<S, const N: usize, const K: usize>(
    memory: &<Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    hiding: &InEquations<'_, S, Held<S::Scalar, K>, K>,
    theta: S::Scalar,
) -> bool
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    S::ROOTED && any(near_roots(hiding, [&memory.start, &memory.end], theta * memory.unit))
}

/// Halves the step until it obeys the equations of motion. `free` is the time to go if the motion is a
/// polynomial in time.
#[cold]
fn shorten<S, const N: usize, const K: usize>(
    memory: &mut <Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    system: &S,
    constants: &S::Constants,
    control: &Held<S::Scalar, K>,
    limits: &Limits<S::Scalar>,
    (free, resolution): (Option<S::Scalar>, S::Scalar),
) -> Result<(), Cause>
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    let absolute = limits.absolute.unwrap_or_else(num_traits::Zero::zero) + step_size::smallest();
    let mut strongest = memory.strongest;
    let start = memory.start;
    let probe = Probe {
        system,
        constants,
        inputs: &control.0,
        start: &start,
        series: &memory.series,
        orders: memory.orders,
        unit: memory.unit,
        tolerances: [limits.relative, absolute],
    };
    if let (Some(left), false) = (free, memory.last.is_positive()) {
        probe.look_ahead(left / memory.unit, &mut strongest);
    }
    if !S::STEEP {
        probe.level(&mut strongest);
    }
    let (mut length, mut is_shorter, mut is_measured) = (memory.end.t - start.t, false, false);
    while any(probe.faults(length / memory.unit, &mut strongest)) {
        if !core::mem::replace(&mut is_measured, true) {
            probe.measure(&mut strongest);
            continue;
        }
        length *= S::Scalar::from_f64(0.5);
        if step_size::is_below(length.abs(), resolution) {
            let cause = too_small(memory);
            return Err(memory.stay(cause));
        }
        memory.counts.rejected += 1;
        is_shorter = true;
    }
    if is_shorter {
        memory.reach(length / memory.unit);
    }
    if S::STEEP {
        memory.strongest = strongest;
    }
    Ok(())
}
