//! One step: expansion, length, end.

use core::cmp::Ordering;

use super::super::adaptive::Adaptive;
use super::super::step_size::{self, Limits};
use super::probe::{self, Probe};
use super::{Jets, JetsMemory, NEAR};
use crate::error::Cause;
use crate::real::{Ordered, Real, larger, smaller};
use crate::simulation::Held;
use crate::smooth::Smooth;
use crate::system::Blur;

/// A step that shrinks to this may do so because of noise.
const SHRUNK: f64 = 0.75;

/// Noise that is far from mattering does not in so many steps that shrink after it.
const CALM: u8 = 3;

/// A step that ends where too little is certain is repeated with this part of its length.
const RETREAT: f64 = 0.6;

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
    let number = S::Scalar::from_f64;
    let before = (memory.start, memory.residue);
    (memory.start, memory.residue) = (memory.end, memory.end_residue);
    let mut from = memory.start;
    if !from.is_finite() {
        return Err(Cause::NotFinite);
    }
    let mut limits: Limits<S::Scalar> = *limits;
    let none = [num_traits::Zero::zero(); N];
    let mut left = target - from.t;
    let resolution = number(4.0) * S::Scalar::epsilon() * from.t.abs() + step_size::smallest();
    let mut remembered = memory.next.is_positive();
    let mut unit = if remembered { memory.next } else { left.abs() };
    let (mut overflowed, mut rescaled, mut retreated, mut blur) = (false, false, false, None);
    let mut lengthened = false;
    loop {
        if *attempts == 0 {
            return Err(Cause::TooManySteps);
        }
        *attempts -= 1;
        memory.unit = left.signum() * unit;
        memory.counts.evaluations += 1;
        let JetsMemory { constants: jet, tables, series, orders, unit: signed, .. } = memory;
        let solved =
            system.jet_at(jet, from.t, &from.q, &from.v, &control.0, *signed, *orders, tables, series);
        if !solved {
            return Err(Cause::NotFinite);
        }
        let steady = remembered && !rescaled;
        let mut tolerated = memory.tolerated(&limits, num_traits::One::one(), steady, [&none; 2]);
        let mut span = number(1.0);
        // In a unit much longer than the step the first terms are no measure of the size.
        while tolerated < number(0.5) * span && tolerated * number(NEAR * NEAR) > num_traits::One::one() {
            span = tolerated;
            tolerated = memory.tolerated(&limits, span, steady, [&none; 2]);
        }
        let shrinks = S::CONSTRAINED && remembered && tolerated < number(SHRUNK);
        if shrinks && blur.is_none() && memory.calm > 0 {
            memory.calm -= 1;
        } else if shrinks || blur.is_some() {
            let known: Blur<_, N> = blur.unwrap_or_else(|| system.blur_at(from.t, &from.q, &from.v));
            let (Blur { q, v, .. }, back) = (known, from.t - before.0.t);
            blur = Some(known);
            if !step_size::is_noisy(&known) {
                // Nothing but a step that is shorter.
                memory.calm = if step_size::is_clear(&known) { CALM } else { 0 };
            } else if step_size::is_known(&known, &limits) {
                let [q, v] = [q, v].map(|noise| noise.map(|x| number(step_size::ACROSS) * x));
                tolerated = larger(tolerated, memory.tolerated(&limits, span, false, [&q, &v]));
            } else if (back * left).is_positive() {
                // Too close to a configuration in which constraints depend on each other: the last step ends earlier.
                unit = number(RETREAT) * back.abs();
                limits.step = Some(limits.clip(unit));
                (memory.start, memory.residue) = before;
                (memory.end, memory.end_residue) = before;
                (from, left, remembered, retreated) = (before.0, target - before.0.t, false, true);
                continue;
            } else {
                return Err(Cause::StepTooSmall);
            }
        }
        let is_finite = memory.is_finite();
        if is_finite && tolerated == number(f64::INFINITY) {
            // A polynomial in time, or coefficients that underflow.
            if !S::STEEP && remembered && unit < left.abs() {
                (unit, remembered) = (left.abs(), false);
                memory.counts.rejected += 1;
                continue;
            }
            let mut natural = left.abs();
            if S::STEEP {
                natural = probe::restrained(natural, memory.last, natural);
            }
            memory.reach(limits.clip(natural) / unit);
            memory.next = num_traits::Zero::zero();
            shorten(memory, system, constants, control, &limits, (Some(left), resolution))?;
        } else if is_finite
            && (tolerated < number(NEAR) || overflowed)
            && tolerated * number(NEAR) > num_traits::One::one()
        {
            // A shorter step than the tolerance allows where coefficients overflow in a longer unit.
            let mut natural = smaller(tolerated, number(NEAR)) * unit;
            if S::STEEP {
                natural = probe::restrained(natural, memory.last, left.abs());
            }
            let length = limits.clip(natural);
            if length.partial_cmp(&resolution) != Some(Ordering::Greater) {
                return Err(Cause::StepTooSmall);
            }
            memory.reach(length / unit);
            // After a retreat the next step is to ask for its noise.
            memory.next = if retreated { natural + natural } else { natural };
            if S::STEEP {
                shorten(memory, system, constants, control, &limits, (None, resolution))?;
            }
        } else {
            // A unit far from the step: coefficients near the ends of the arithmetic, or beyond.
            let cause = if is_finite { Cause::StepTooSmall } else { Cause::NotFinite };
            overflowed |= !is_finite;
            let factor =
                if is_finite { smaller(larger(tolerated, number(1e-9)), number(1e9)) } else { number(1e-3) };
            // Two units may each ask for the other: a component that starts with many zero derivatives has no size but in
            // the unit. The shorter one is sure.
            overflowed |= lengthened && factor < num_traits::One::one();
            lengthened |= factor > num_traits::One::one();
            unit *= factor;
            rescaled = true;
            memory.counts.rejected += 1;
            if unit.partial_cmp(&resolution) != Some(Ordering::Greater) {
                return Err(cause);
            }
            continue;
        }
        if !memory.end.is_finite() {
            (memory.end, memory.end_residue) = (memory.start, memory.residue);
            return Err(Cause::NotFinite);
        }
        if S::CONSTRAINED {
            let mut end = memory.end;
            if let Err(cause) = system.project_at(constants, &mut end) {
                (memory.end, memory.end_residue) = (memory.start, memory.residue);
                return Err(cause);
            }
            memory.correct(end);
        }
        memory.last = (memory.end.t - memory.start.t).abs();
        memory.counts.accepted += 1;
        return Ok(());
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
        if length.abs().partial_cmp(&resolution) != Some(Ordering::Greater) {
            (memory.end, memory.end_residue) = (memory.start, memory.residue);
            return Err(Cause::StepTooSmall);
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
