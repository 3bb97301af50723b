//! Taylor series under error control: the method of smooth systems.
//!
//! Each step expands the motion to an order that follows from the tolerance and takes the length at which the
//! last two terms of the series fall to the tolerance (Jorba and Zou, *A software package for the numerical
//! integration of ODEs by means of high-order Taylor methods*, Experimental Mathematics 14, 2005). The
//! polynomial is the dense output, so nothing ever shortens a step to land on a time. State and time are
//! summed with compensation.
//!
//! The memory of a motion holds tables for the highest order: 7.5 kB for a double pendulum, 50 kB for a chain
//! of 20 links. Where that is too much, take fixed steps by [`Jet`](crate::Jet), whose tables end at its own
//! order.
//!
//! Coefficients are those of time in units of the last step, so none over- or underflows in any units of
//! mass, length and time.

mod expansion;
pub(crate) mod fall;
mod leap;
mod memory;
pub(crate) mod paced;
pub(crate) mod probe;
mod singular;
mod step;

use super::landing::Determined;
use crate::number::real::Ordered;
use crate::series::HIGHEST;
use crate::system::control::Held;
use crate::system::diagnose;
use crate::system::error::{Cause, MotionError};
use crate::system::limits::Limits;
use crate::system::method::Terms;
use crate::system::method::{Adaptive, Steps};
use crate::system::smooth::Smooth;
use crate::system::state::State;
pub use memory::JetsMemory;
use singular::Beyond;
use step::step;

/// Taylor series of the motion, order and step from the tolerance: the fastest and most accurate method for a
/// smooth system.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Jets;

/// Orders for each natural digit of the tolerance. One half is the optimum where the work of a step grows
/// with the square of the order (Jorba and Zou); here it grows more slowly. Measured on the systems of the
/// benchmarks.
const ORDERS_PER_DIGIT: f64 = 0.8;

/// The same where the tolerance means the accuracy of rounding. The terms of a long step are much larger than
/// their sum, and so are their rounding errors: those of an oscillation add up to exp(ωt), while the number
/// of steps falls with ωt alone. This order ends steps near ωt = 1. Shorter ones are more accurate yet, and
/// cost more.
const ORDERS_AT_ROUNDING: f64 = 0.43;

/// The same just above the accuracy of rounding, and the ulps of the tolerance from which on truncation
/// errors are so much larger than those of rounding that steps may be long. In between orders grow with the
/// logarithm of the tolerance. At nine ulps this takes 1.1 to 2 times as long as many orders do, and leaves
/// 0.2 to 0.9 of their error.
const ORDERS_NEAR_ROUNDING: f64 = 0.5;
const FAR_FROM_ROUNDING: f64 = 64.0;

/// exp(−1 / `ORDERS_PER_DIGIT`): the ratio of successive terms of a series at the tolerated length. At the
/// accuracy of rounding terms fall faster, which is on the safe side.
const DECAY: f64 = 0.29;

/// Safety factor: the last term of a series falls to this part of the tolerance. The sum of all terms after
/// it is then smaller still.
pub(crate) const SAFETY: f64 = 0.2;

/// Tolerances of at most this many ulps mean the accuracy of rounding.
const AT_ROUNDING: f64 = 8.0;

/// The last term of a series, in ulps, if the tolerance means the accuracy of rounding. Truncation errors add
/// up systematically and rounding errors as a random walk, so over millions of steps truncation must be the
/// smaller one by far. The compensated sums of the state carry the additional digits.
const FINEST: f64 = 1e-3;

/// Whether a tolerance means the accuracy of rounding.
#[inline]
pub(crate) fn is_at_rounding<R: Ordered>(tolerance: R) -> bool {
    tolerance <= R::from_f64(AT_ROUNDING) * R::epsilon()
}

/// The bound of the last term for a tolerance, both relative to the size of a component.
#[inline]
pub(crate) fn last_term<R: Ordered>(tolerance: R) -> R {
    if is_at_rounding(tolerance) {
        R::from_f64(FINEST) * R::epsilon()
    } else {
        R::from_f64(SAFETY) * tolerance
    }
}

/// The growth of a step below which the terms before the last two are not looked at again ([`fall`]). The
/// last term then grows by the power of its order at most: seven times at a tolerance of 1e-10, 21 times at
/// the highest order.
const GROWTH: f64 = 1.1;

/// The ratio of the unit of time to the step, or its inverse, up to which all coefficients stay far from the
/// ends of the range of numbers.
pub(crate) const NEAR: f64 = 64.0;

/// The orders for each natural digit of a tolerance, if they are so many where it is far from rounding.
#[inline]
fn per_digit_at<R: Ordered>(relative: R, far: R) -> R {
    if is_at_rounding(relative) {
        return R::from_f64(ORDERS_AT_ROUNDING);
    }
    let near = R::from_f64(ORDERS_NEAR_ROUNDING);
    let [ends, begins] = [AT_ROUNDING, FAR_FROM_ROUNDING].map(R::from_f64);
    let ulps = relative / R::epsilon();
    if ulps < begins { near + (far - near) * (ulps / ends).ln() / (begins / ends).ln() } else { far }
}

/// The order for a tolerance, with a given number of orders for each of its natural digits.
#[inline]
pub(crate) fn orders<R: Ordered>(relative: R, per_digit: f64) -> usize {
    let digits = -last_term(relative).ln();
    let per_digit = per_digit_at(relative, R::from_f64(per_digit));
    let mut orders = 4;
    // The smallest integer that is not below a number, for a generic scalar.
    while orders < HIGHEST && R::from_f64(orders as f64) < per_digit * digits + R::one() {
        orders += 1;
    }
    orders
}

/// The error of a step that failed. The memory forgets the unit of the next step.
#[cold]
fn failed<S, const N: usize, const K: usize>(
    memory: &mut <Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    system: &S,
    constants: &S::Constants,
    cause: Cause,
) -> MotionError<S::Scalar>
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    let at = memory.end;
    let cause = match cause {
        Cause::NotFinite => diagnose(system, constants, at.t, &at.q, &at.v),
        cause => cause,
    };
    memory.next = num_traits::Zero::zero();
    MotionError { cause, t: at.t }
}

impl<S, const N: usize, const K: usize> Adaptive<S, Held<S::Scalar, K>, N, K> for Jets
where
    S: Smooth<N, K>,
{
    type Memory = JetsMemory<S::JetConstants, S::Tables<HIGHEST>, S::Scalar, N>;
    const IS_BLIND: bool = S::STEEP;

    #[inline]
    fn begin(system: &S, start: State<S::Scalar, N>) -> Self::Memory
    where
        S::Scalar: Ordered,
    {
        JetsMemory::new(system.jet_constants(), start, S::ORIENTATIONS)
    }

    #[inline]
    fn restart(memory: &mut Self::Memory, state: State<S::Scalar, N>)
    where
        S::Scalar: Ordered,
    {
        memory.begin(state);
    }

    #[inline]
    fn start(memory: &Self::Memory) -> &State<S::Scalar, N> {
        &memory.start
    }

    #[inline]
    fn end(memory: &Self::Memory) -> &State<S::Scalar, N> {
        &memory.end
    }

    #[inline]
    fn step(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        control: &Held<S::Scalar, K>,
        limits: &Limits<S::Scalar>,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> Result<(), MotionError<S::Scalar>>
    where
        S::Scalar: Ordered,
    {
        memory.prepare(limits);
        step(memory, system, constants, control, limits, t, attempts)
            .map_err(|cause| failed(memory, system, constants, cause))
    }

    #[cold]
    fn pass(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        control: &Held<S::Scalar, K>,
        limits: &Limits<S::Scalar>,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> bool
    where
        S::Scalar: Ordered,
    {
        memory.prepare(limits);
        let across = (t - memory.start.t, Beyond::Better);
        singular::start(memory, system, constants, control, limits, across) == Ok(true)
            || step(memory, system, constants, control, limits, t, attempts).is_ok()
    }

    #[inline]
    fn counts(memory: &Self::Memory) -> Steps {
        memory.counts
    }

    #[inline]
    fn go_on(memory: &mut Self::Memory, system: &S, state: State<S::Scalar, N>)
    where
        S::Scalar: Ordered,
    {
        memory.constants = system.jet_constants();
        memory.begin(state);
        memory.counts = Steps::default();
    }

    #[inline]
    fn terms(memory: &Self::Memory) -> Option<Terms<'_, S::Scalar, N>>
    where
        S::Scalar: Ordered,
    {
        Some(memory.terms(S::followed))
    }

    #[inline]
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
        let mut state = memory.at_part(part);
        if S::CONSTRAINED && part != num_traits::One::one() {
            let failed = |cause| MotionError { cause, t: memory.end.t };
            system.project_at(constants, &mut state, None).map_err(failed)?;
        }
        Ok(state)
    }

    #[inline]
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

    #[inline]
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
            // A step that covers the time keeps the order that it was made with.
            memory.prepare(limits);
            if !memory.ahead(t) {
                (memory.end, memory.end_residue) = (memory.start, memory.residue);
            }
            if let Err(cause) = step(memory, system, constants, control, limits, t, attempts) {
                return Err(failed(memory, system, constants, cause));
            }
        }
        let mut state = memory.at(t);
        // Inside a step the polynomial obeys constraints to the tolerance, at its ends to rounding errors.
        if S::CONSTRAINED && t != memory.end.t {
            let failed = |cause| MotionError { cause, t: memory.end.t };
            system.project_at(constants, &mut state, None).map_err(failed)?;
        }
        Ok(state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_term_is_a_fifth_of_the_tolerance_and_near_rounding_a_thousandth_of_an_ulp() {
        let ulp = f64::EPSILON;
        for (tolerance, term) in
            [(1e-6, 2e-7), (9.0 * ulp, 1.8 * ulp), (7.0 * ulp, 1e-3 * ulp), (0.0, 1e-3 * ulp)]
        {
            let found: f64 = last_term(tolerance);
            assert!((found / term - 1.0).abs() < 1e-14, "{tolerance:e}: {found:e}");
        }
    }

    #[test]
    fn an_order_is_the_least_that_gives_each_digit_its_share() {
        // One more than 0.8 of −ln(2e-7) = 15.4, and so on; at least 4, at most what tables hold.
        for (tolerance, order) in [(1.0, 4), (1e-6, 14), (1e-10, 21)] {
            assert_eq!(orders(tolerance, 0.8), order, "{tolerance:e}");
        }
        assert_eq!(orders(1e-14, 10.0), HIGHEST);
        // Between both, where a natural logarithm of eight lies.
        let ulps = |ulps: f64| orders(ulps * f64::EPSILON, 0.8);
        assert_eq!([8.1, 22.6, 64.0].map(ulps), [19, 24, 28]);
        // One more than 0.43 of −ln(1e-3 ulps) = 43.0.
        assert_eq!(orders(1e-15, 0.8), 20);
    }
}
