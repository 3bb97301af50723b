//! The series at a state, in a unit of time near the length that it allows.

use super::super::step_size;
use super::{Jets, JetsMemory, NEAR};
use crate::number::real::{Ordered, Real, larger, smaller};
use crate::system::control::Held;
use crate::system::error::Cause;
use crate::system::limits::Limits;
use crate::system::method::Adaptive;
use crate::system::smooth::Smooth;
use crate::system::state::State;

/// Computes the coefficients at a state in the unit of the memory. False if the equations have no solution.
#[inline(always)]
fn at<S, const N: usize, const K: usize>(
    memory: &mut <Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    system: &S,
    control: &Held<S::Scalar, K>,
    from: &State<S::Scalar, N>,
) -> bool
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    memory.counts.evaluations += 1;
    memory.is_as_expanded = true;
    let JetsMemory { constants, tables, series, orders, unit, .. } = memory;
    system.jet_at(constants, from.t, &from.q, &from.v, &control.0, *unit, *orders, tables, series)
}

/// The same as a function of its own.
#[inline(never)]
pub(super) fn outlined<S, const N: usize, const K: usize>(
    memory: &mut <Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    system: &S,
    control: &Held<S::Scalar, K>,
    from: &State<S::Scalar, N>,
) -> bool
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    at(memory, system, control, from)
}

/// Why a step falls below the resolution of time. An infinite force that does not change leaves the highest
/// coefficients finite.
#[cold]
pub(super) fn too_small<T: Copy, M: Copy + Default, R: Ordered, const N: usize>(
    memory: &JetsMemory<T, M, R, N>,
) -> Cause {
    let [q, v] = [&memory.series.q, &memory.series.v].map(|rows| rows.iter().take(memory.orders));
    if q.chain(v).all(|row| row.iter().all(|x| x.is_finite())) {
        Cause::StepTooSmall
    } else {
        Cause::NotFinite
    }
}

/// Expands the motion about the start of the memory. `left` \[s] is the time to go: it gives the direction,
/// and the unit of time where none is known. Returns the length \[s] that the tolerance allows, without
/// direction, which may be longer than `left`; `None` for a polynomial in time, or if coefficients underflow.
#[inline(always)]
pub(super) fn expand<S, const N: usize, const K: usize>(
    memory: &mut <Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    system: &S,
    control: &Held<S::Scalar, K>,
    limits: &Limits<S::Scalar>,
    left: S::Scalar,
    attempts: &mut u64,
) -> Result<Option<S::Scalar>, Cause>
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    let number = S::Scalar::from_f64;
    let from = memory.start;
    let resolution = memory.resolution();
    let mut remembered = memory.next.is_positive();
    // Products with a power of two have no rounding errors, which is all the errors that a polynomial in time
    // has.
    let mut unit = if remembered { memory.varied() } else { left.abs().binade() };
    let (mut overflowed, mut rescaled, mut lengthened) = (false, false, false);
    loop {
        if *attempts == 0 {
            return Err(Cause::TooManySteps);
        }
        *attempts -= 1;
        memory.unit = left.signum() * unit;
        // The compiler optimises one copy of the code better than several, but that of a free motion best
        // where it is called.
        let solved = if S::CONSTRAINED {
            outlined(memory, system, control, &from)
        } else {
            at(memory, system, control, &from)
        };
        if !solved {
            return Err(Cause::NotFinite);
        }
        let steady = remembered && !rescaled;
        let mut tolerated = memory.tolerated(limits, num_traits::One::one(), steady);
        let mut span = number(1.0);
        // In a unit much longer than the step, the first terms do not measure the size of a component.
        while tolerated < number(0.5) * span && tolerated * number(NEAR * NEAR) > num_traits::One::one() {
            span = tolerated;
            tolerated = memory.tolerated(limits, span, steady);
        }
        let is_finite = memory.is_finite();
        if is_finite && tolerated == number(f64::INFINITY) {
            if !S::STEEP && remembered && unit < left.abs() {
                (unit, remembered) = (left.abs().binade(), false);
                memory.counts.rejected += 1;
                continue;
            }
            return Ok(None);
        }
        if is_finite
            && (tolerated < number(NEAR) || overflowed)
            && tolerated * number(NEAR) > num_traits::One::one()
        {
            // In a longer unit coefficients overflow, so the step is shorter than the tolerance allows.
            let natural = smaller(tolerated, number(NEAR)) * unit;
            return Ok(Some(natural));
        }
        // In a unit far from the step, coefficients are near the ends of the range of numbers, or beyond. A
        // length of zero is that of coefficients that overflow when they are divided by their tolerance.
        let is_known = is_finite && tolerated.is_positive();
        overflowed |= !is_known;
        let factor =
            if is_known { smaller(larger(tolerated, number(1e-9)), number(1e9)) } else { number(1e-3) };
        // Two units may each ask for the other, since a component that starts with many zero derivatives has
        // no size but in the unit. The shorter unit is safe.
        overflowed |= lengthened && factor < num_traits::One::one();
        lengthened |= factor > num_traits::One::one();
        unit = (unit * factor).binade();
        rescaled = true;
        memory.counts.rejected += 1;
        if step_size::is_below(unit, resolution) {
            return Err(too_small(memory));
        }
    }
}
