//! One step: expansion, length, end.

use core::cmp::Ordering;

use super::super::adaptive::Adaptive;
use super::super::step_size::{self, Limits};
use super::{Jets, JetsMemory, NEAR};
use crate::error::Cause;
use crate::real::{Ordered, Real, larger, smaller};
use crate::simulation::Held;
use crate::smooth::Smooth;

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
    (memory.start, memory.residue) = (memory.end, memory.end_residue);
    let from = memory.start;
    if !from.is_finite() {
        return Err(Cause::NotFinite);
    }
    let left = target - from.t;
    let resolution = number(4.0) * S::Scalar::epsilon() * from.t.abs() + step_size::smallest();
    let mut remembered = memory.next.is_positive();
    let mut unit = if remembered { memory.next } else { left.abs() };
    let (mut overflowed, mut rescaled) = (false, false);
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
        let mut tolerated = memory.tolerated(limits, num_traits::One::one(), steady);
        let mut span = number(1.0);
        // In a unit much longer than the step the first terms are no measure of the size.
        while tolerated < number(0.5) * span && tolerated * number(NEAR * NEAR) > num_traits::One::one() {
            span = tolerated;
            tolerated = memory.tolerated(limits, span, steady);
        }
        let is_finite = memory.is_finite();
        if is_finite && tolerated == number(f64::INFINITY) {
            // A polynomial in time, or coefficients that underflow.
            if remembered && unit < left.abs() {
                (unit, remembered) = (left.abs(), false);
                memory.counts.rejected += 1;
                continue;
            }
            memory.reach(limits.clip(left.abs()) / unit);
            memory.next = num_traits::Zero::zero();
            // Of x″ = t⁴⁰ all coefficients vanish at t = 0.
            while !moves_on(memory, system, constants, control, limits) {
                let length = number(0.5) * (memory.end.t - memory.start.t);
                if length.abs().partial_cmp(&resolution) != Some(Ordering::Greater) {
                    (memory.end, memory.end_residue) = (memory.start, memory.residue);
                    return Err(Cause::StepTooSmall);
                }
                memory.reach(length / memory.unit);
            }
        } else if is_finite
            && (tolerated < number(NEAR) || overflowed)
            && tolerated * number(NEAR) > num_traits::One::one()
        {
            // A shorter step than the tolerance allows where coefficients overflow in a longer unit.
            let natural = smaller(tolerated, number(NEAR)) * unit;
            let length = limits.clip(natural);
            if length.partial_cmp(&resolution) != Some(Ordering::Greater) {
                return Err(Cause::StepTooSmall);
            }
            memory.reach(length / unit);
            memory.next = natural;
        } else {
            // A unit far from the step: coefficients near the ends of the arithmetic, or beyond.
            let cause = if is_finite { Cause::StepTooSmall } else { Cause::NotFinite };
            overflowed |= !is_finite;
            let factor =
                if is_finite { smaller(larger(tolerated, number(1e-9)), number(1e9)) } else { number(1e-3) };
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
        memory.counts.accepted += 1;
        return Ok(());
    }
}

/// Whether the end of the step obeys the equations of motion: the accelerations there are those of the polynomial.
#[cold]
fn moves_on<S, const N: usize, const K: usize>(
    memory: &<Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    system: &S,
    constants: &S::Constants,
    control: &Held<S::Scalar, K>,
    limits: &Limits<S::Scalar>,
) -> bool
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    let JetsMemory { start, end, series, unit, orders, .. } = memory;
    let span = end.t - start.t;
    let theta = span / *unit;
    let relative = larger(limits.relative, S::Scalar::from_f64(64.0) * S::Scalar::epsilon());
    let accelerations = system.accelerations_at(constants, end.t, &end.q, &end.v, &control.0);
    (0..N).all(|i| {
        let mut slope: S::Scalar = num_traits::Zero::zero();
        for (k, row) in series.v.iter().enumerate().take(*orders).rev() {
            slope = slope * theta + S::Scalar::from_f64((k + 1) as f64) * row[i];
        }
        let (expected, found) = (slope / *unit * span, accelerations[i] * span);
        let size = larger(larger(expected.abs(), found.abs()), larger(start.v[i].abs(), end.v[i].abs()));
        (found - expected).abs() <= relative * size + step_size::smallest()
    })
}
