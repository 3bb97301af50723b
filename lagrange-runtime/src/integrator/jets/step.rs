//! One step: expansion, length, end.

use super::super::adaptive::Adaptive;
use super::super::landing::{Check, Determined, LENGTHS, Landing, SHORTER};
use super::super::step_size::{self, Limits};
use super::expansion::expand;
use super::probe::{self, PLACES, Probe};
use super::{Jets, singular};
use crate::error::Cause;
use crate::real::{Ordered, Real};
use crate::simulation::Held;
use crate::smooth::Smooth;

/// A step that failed its check is repeated with this part of its length.
const HALF: f64 = 0.5;

/// One step from the end of the last one towards `target`.
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
    (memory.start, memory.residue) = (memory.end, memory.end_residue);
    if !memory.start.is_finite() {
        return Err(Cause::NotFinite);
    }
    let left = target - memory.start.t;
    let begins = S::CONSTRAINED && memory.determined.is_none();
    let mut here = None;
    if begins {
        let footing = system.land_at(constants, &mut memory.start.clone())?;
        memory.ulps = [footing.ulps_q, footing.ulps_v];
        here = Some(footing.independence);
    }
    let natural = expand(memory, system, control, limits, left, attempts)?;
    if let Some(here) = here {
        if !here.is_determined() && singular::start(memory, system, constants, control, limits, left, &here)?
        {
            memory.counts.accepted += 1;
            return Ok(());
        }
        memory.determined = Some(Determined::at_start(&here));
    }
    let resolution = memory.resolution();
    let is_free = natural.is_none();
    let mut natural = natural.unwrap_or_else(|| left.abs());
    // The coefficients do not know what rounding has hidden from them.
    if S::STEEP || S::CONSTRAINED && memory.last.is_positive() {
        natural = probe::restrained(natural, memory.last, left.abs());
    }
    let length = limits.clip(natural);
    if !is_free && step_size::is_below(length, resolution) {
        return Err(Cause::StepTooSmall);
    }
    memory.reach(length / memory.unit.abs());
    memory.next = if is_free { num_traits::Zero::zero() } else { natural };
    // Of a polynomial in time only the equations tell whether it holds. A constrained step is always compared with them.
    if !S::CONSTRAINED && (S::STEEP || is_free) {
        let free = is_free.then_some(left);
        shorten(memory, system, constants, control, limits, (free, resolution))?;
    }
    if !memory.end.is_finite() {
        return Err(memory.stay(Cause::NotFinite));
    }
    if S::CONSTRAINED {
        land(memory, system, constants, control, limits, natural, attempts)?;
    }
    memory.last = (memory.end.t - memory.start.t).abs();
    memory.counts.accepted += 1;
    Ok(())
}

/// Ends a step of a constrained motion where it can be checked and goes on well: at the length that it has, or near that.
#[inline]
fn land<S, const N: usize, const K: usize>(
    memory: &mut <Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    system: &S,
    constants: &S::Constants,
    control: &Held<S::Scalar, K>,
    limits: &Limits<S::Scalar>,
    natural: S::Scalar,
    attempts: &mut u64,
) -> Result<(), Cause>
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    let unit = memory.unit.abs();
    let mut theta = (memory.end.t - memory.start.t).abs() / unit;
    let mut natural = natural / unit;
    let (resolution, mut base, mut others) = (memory.resolution(), theta, LENGTHS.iter());
    loop {
        let Some(mut determined) = memory.determined else { return Ok(()) };
        let check = Check { system, constants, inputs: &control.0, limits, from: &memory.start };
        let slopes = |theta| memory.series.slopes(theta, memory.orders).map(|slope| slope / memory.unit);
        let on_the_way = |landing: &Landing<S::Scalar, N>| {
            !S::STEEP
                || (1..PLACES).all(|place| {
                    let theta = S::Scalar::from_f64(place as f64 / PLACES as f64) * theta;
                    check.agrees(&memory.place(theta), &slopes(theta), landing)
                })
        };
        let landed = check.land(&memory.end, Some(&slopes(theta)));
        let cause = match landed
            .map(|landing| Landing { is_right: landing.is_right && on_the_way(&landing), ..landing })
        {
            Ok(landing) if landing.is_right && determined.accepts(&landing.footing.independence) => {
                determined.learn(&landing.footing.independence);
                memory.determined = Some(determined);
                memory.ulps = [landing.footing.ulps_q, landing.footing.ulps_v];
                memory.correct(landing.end);
                return Ok(());
            }
            Ok(landing) if landing.is_right => {
                if let Some(&part) = others.next() {
                    theta = S::Scalar::from_f64(part) * base;
                } else {
                    // A limit of the step must not keep it where it cannot end.
                    base = if base < natural { natural } else { S::Scalar::from_f64(SHORTER) * base };
                    (theta, natural, others) = (base, num_traits::Zero::zero(), LENGTHS.iter());
                }
                Cause::Undetermined { constraint: landing.footing.independence.weakest }
            }
            wrong => {
                base = S::Scalar::from_f64(HALF) * theta;
                (theta, others) = (base, LENGTHS.iter());
                wrong.err().unwrap_or(Cause::StepTooSmall)
            }
        };
        memory.counts.rejected += 1;
        if *attempts == 0 {
            return Err(memory.stay(Cause::TooManySteps));
        }
        *attempts -= 1;
        if step_size::is_below(theta * unit, resolution) {
            return Err(memory.stay(cause));
        }
        memory.reach(theta);
    }
}

/// Halves the step until it obeys the equations of motion. For a polynomial in time, what is left to go is given.
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
        // At rest, how strong the forces ahead are is the only measure of the roundings of one that sets in.
        probe.compared(left / memory.unit, &mut strongest);
    }
    let (mut length, mut is_shorter) = (memory.end.t - start.t, false);
    while !probe.agrees(length / memory.unit, &mut strongest) {
        length *= S::Scalar::from_f64(0.5);
        if step_size::is_below(length.abs(), resolution) {
            return Err(memory.stay(Cause::StepTooSmall));
        }
        memory.counts.rejected += 1;
        is_shorter = true;
    }
    if is_shorter {
        memory.reach(length / memory.unit);
    }
    memory.strongest = strongest;
    Ok(())
}
