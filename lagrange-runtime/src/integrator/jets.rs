//! Taylor series under error control: the method of smooth systems.
//!
//! Each step expands the motion to an order that follows from the tolerance and takes the length at which the last
//! two terms of the series fall to the tolerance (Jorba and Zou, *A software package for the numerical integration
//! of ODEs by means of high-order Taylor methods*, Experimental Mathematics 14, 2005). The polynomial is the dense
//! output, so nothing ever shortens a step to land on a time. State and time are summed with compensation.
//!
//! Coefficients are those of time in units of the last step, so none over- or underflows in any units of mass,
//! length and time.

use core::cmp::Ordering;

use super::adaptive::{Adaptive, Steps};
use super::diagnose;
use super::dop853::add;
use super::step_size::{self, Limits};
use crate::error::{Cause, MotionError};
use crate::real::{Ordered, Real, larger, smaller};
use crate::simulation::Held;
use crate::smooth::{Series, Smooth};
use crate::state::State;

/// Taylor series of the motion, order and step from the tolerance: the fastest and most accurate method for a smooth
/// system.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Jets;

/// The highest order.
pub(crate) const HIGHEST: usize = 32;

/// Orders for each natural digit of the tolerance. One half is the optimum where the work of a step grows with the
/// square of the order (Jorba and Zou); here it grows more slowly. Measured on the systems of the benchmarks.
const ORDERS_PER_DIGIT: f64 = 0.8;

/// exp(−1 / `ORDERS_PER_DIGIT`): how much the terms of a series fall from order to order at the tolerated length.
const DECAY: f64 = 0.29;

/// The last term of a series falls to this part of the tolerance: all terms after it together are then smaller still.
pub(crate) const SAFETY: f64 = 0.2;

/// The finest tolerance in units of rounding: the error of a series is systematic, that of rounding a random walk, so
/// over millions of steps the first must be smaller by far. Sums are compensated and carry the digits.
pub(crate) const FINEST: f64 = 1e-3;

/// Terms of a series decay by less than this from order to order, at a step that follows from the last two.
pub(crate) const STEEPEST: f64 = 6.0;

/// A step that grows by less than this needs no second look: its error would grow by a few times at most.
const GROWTH: f64 = 1.1;

/// A unit of time within this factor of the step keeps all coefficients far from the ends of the arithmetic.
pub(crate) const NEAR: f64 = 64.0;

/// What [`Jets`] remember between steps.
#[derive(Clone, Copy, Debug)]
pub struct JetsMemory<C, T, R, const N: usize> {
    constants: C,
    tables: T,
    series: Series<R, N, HIGHEST>,
    orders: usize,
    /// The tolerance that the order is for.
    tolerance: R,
    /// The point of expansion and what rounding took from it.
    start: State<R, N>,
    residue: State<R, N>,
    /// Unit of time of the coefficients \[s], with the direction of the motion.
    unit: R,
    /// The unit of the next step, without direction; zero if not known.
    next: R,
    end: State<R, N>,
    end_residue: State<R, N>,
    counts: Steps,
}

impl<C: Copy, T: Copy + Default, R: Ordered, const N: usize> JetsMemory<C, T, R, N> {
    fn new(constants: C, start: State<R, N>) -> Self {
        let zero = State { t: R::zero(), q: [R::zero(); N], v: [R::zero(); N] };
        Self {
            constants,
            tables: T::default(),
            series: Series::default(),
            orders: 0,
            tolerance: -R::one(),
            start,
            residue: zero,
            unit: R::zero(),
            next: R::zero(),
            end: start,
            end_residue: zero,
            counts: Steps::default(),
        }
    }

    /// Whether `t` lies in the step, ends included.
    fn covers(&self, t: R) -> bool {
        let (a, b) = (self.start.t, self.end.t);
        (a <= t && t <= b) || (b <= t && t <= a)
    }

    /// Whether `t` lies beyond the end of the step in its direction; true for a step of no length.
    fn ahead(&self, t: R) -> bool {
        let (a, b) = (self.start.t, self.end.t);
        if a <= b { t >= b || a == b } else { t <= b }
    }

    /// The state at a time in the step.
    #[inline]
    fn at(&self, t: R) -> State<R, N> {
        if t == self.end.t {
            return self.end;
        }
        let theta = ((t - self.start.t) - self.residue.t) / self.unit;
        let mut state = self.start.at_time(t);
        let (gain_q, gain_v) = self.series.gain(theta, self.orders);
        for i in 0..N {
            state.q[i] += gain_q[i] + self.residue.q[i];
            state.v[i] += gain_v[i] + self.residue.v[i];
        }
        state
    }

    /// Moves the end of the step to `length` units of the scaled time.
    #[inline]
    fn reach(&mut self, length: R) {
        let (gain_q, gain_v) = self.series.gain(length, self.orders);
        (self.end.t, self.end_residue.t) = add(self.start.t, self.residue.t, length * self.unit);
        for i in 0..N {
            (self.end.q[i], self.end_residue.q[i]) = add(self.start.q[i], self.residue.q[i], gain_q[i]);
            (self.end.v[i], self.end_residue.v[i]) = add(self.start.v[i], self.residue.v[i], gain_v[i]);
        }
    }

    /// Whether the coefficients of the highest order are finite, and with them all others.
    #[inline]
    fn is_finite(&self) -> bool {
        let row = |rows: &[[R; N]; HIGHEST]| {
            rows.get(self.orders - 1).is_some_and(|row| row.iter().all(|x| x.is_finite()))
        };
        row(&self.series.q) && row(&self.series.v)
    }

    /// The length at which the last two terms fall to the tolerance, in units of the scaled time; not finite where
    /// a coefficient is not, infinite for a polynomial.
    ///
    /// Symmetry makes coefficients vanish, at x = 0 of x″ = −x³ two of any four orders, or nearly vanish beside it.
    /// So the terms before the last two may not exceed the tolerance by more than [`STEEPEST`] for each order either.
    ///
    /// The size of a component is that of its first terms over `span`, which should be about the length itself. With
    /// `steady` the unit is the last step.
    #[inline]
    fn tolerated(&self, limits: &Limits<R>, span: R, steady: bool) -> R {
        let safety = R::from_f64(SAFETY);
        let relative = larger(safety * limits.relative, R::epsilon() * R::from_f64(FINEST));
        let absolute = safety * limits.absolute.unwrap_or_else(R::zero);
        let (mut last, mut before) = (R::zero(), R::zero());
        let tiny = step_size::smallest::<R>();
        let size =
            |x0: R, x1: R, x2: R| relative * larger(x0.abs(), larger(x1.abs(), x2.abs())) + absolute + tiny;
        let (series, p) = (&self.series, self.orders);
        let row = |rows: &[[R; N]; HIGHEST], k: usize| rows.get(k - 1).copied().unwrap_or([R::zero(); N]);
        let [q1, q2, qb, ql] = [1, 2, p - 1, p].map(|k| row(&series.q, k));
        let [v1, v2, vb, vl] = [1, 2, p - 1, p].map(|k| row(&series.v, k));
        let (mut weights_q, mut weights_v) = ([R::zero(); N], [R::zero(); N]);
        for i in 0..N {
            weights_q[i] = R::recip(size(self.start.q[i], q1[i] * span, q2[i] * span * span));
            weights_v[i] = R::recip(size(self.start.v[i], v1[i] * span, v2[i] * span * span));
            last = larger(larger(last, ql[i].abs() * weights_q[i]), vl[i].abs() * weights_v[i]);
            before = larger(larger(before, qb[i].abs() * weights_q[i]), vb[i].abs() * weights_v[i]);
        }
        // At the tolerated length one term is about this much smaller than the one before it.
        let decay = R::from_f64(DECAY);
        let length = reach(larger(last, decay * before), p);
        if steady && length <= R::from_f64(GROWTH) {
            return length;
        }
        self.bounded(length, &weights_q, &weights_v)
    }

    /// A length that the terms of lower orders bear as well.
    fn bounded(&self, mut length: R, weights_q: &[R; N], weights_v: &[R; N]) -> R {
        let row = |rows: &[[R; N]; HIGHEST], k: usize| rows.get(k - 1).copied().unwrap_or([R::zero(); N]);
        let mut allowed = R::from_f64(STEEPEST);
        for order in (self.orders / 2..self.orders - 1).rev() {
            allowed *= R::from_f64(STEEPEST);
            let (q, v) = (row(&self.series.q, order), row(&self.series.v, order));
            let mut term = R::zero();
            for i in 0..N {
                term = larger(larger(term, q[i].abs() * weights_q[i]), v[i].abs() * weights_v[i]);
            }
            let term = term / allowed;
            if term != R::zero() && term * length.powi(order as i32) > R::one() {
                length = reach(term, order);
            }
        }
        length
    }
}

/// The length at which a term of an order falls to one.
#[inline]
fn reach<R: Real>(term: R, order: usize) -> R {
    if term == R::zero() {
        return R::from_f64(f64::INFINITY);
    }
    (-term.ln() / R::from_f64(order as f64)).exp()
}

/// The order for a tolerance, with so many orders for each of its natural digits.
#[inline]
pub(crate) fn orders<R: Ordered>(relative: R, per_digit: f64) -> usize {
    let digits = -larger(relative, R::epsilon() * R::from_f64(FINEST)).ln();
    let mut orders = 4;
    // A cast of a generic scalar: the smallest integer above.
    while orders < HIGHEST && R::from_f64(orders as f64) < R::from_f64(per_digit) * digits + R::one() {
        orders += 1;
    }
    orders
}

impl<S, const N: usize, const K: usize> Adaptive<S, Held<S::Scalar, K>, N, K> for Jets
where
    S: Smooth<N, K>,
{
    type Memory = JetsMemory<S::JetConstants, S::Tables<HIGHEST>, S::Scalar, N>;

    #[inline]
    fn begin(system: &S, start: State<S::Scalar, N>) -> Self::Memory
    where
        S::Scalar: Ordered,
    {
        JetsMemory::new(system.jet_constants(), start)
    }

    #[inline]
    fn restart(memory: &mut Self::Memory, state: State<S::Scalar, N>)
    where
        S::Scalar: Ordered,
    {
        let fresh = JetsMemory::new(memory.constants, state);
        *memory = JetsMemory { next: memory.next, counts: memory.counts, ..fresh };
    }

    #[inline]
    fn end(memory: &Self::Memory) -> &State<S::Scalar, N> {
        &memory.end
    }

    #[inline]
    fn counts(memory: &Self::Memory) -> Steps {
        memory.counts
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
        if memory.tolerance != limits.relative {
            (memory.tolerance, memory.orders) = (limits.relative, orders(limits.relative, ORDERS_PER_DIGIT));
        }
        while !memory.covers(t) {
            if !memory.ahead(t) {
                (memory.end, memory.end_residue) = (memory.start, memory.residue);
            }
            if let Err(cause) = step(memory, system, control, limits, t, attempts) {
                let at = memory.end;
                let cause = match cause {
                    Cause::NotFinite => diagnose(system, constants, at.t, &at.q, &at.v),
                    cause => cause,
                };
                memory.next = num_traits::Zero::zero();
                return Err(MotionError { cause, t: at.t });
            }
        }
        Ok(memory.at(t))
    }
}

/// One step from the end of the last one towards `target`.
#[inline]
fn step<S, const N: usize, const K: usize>(
    memory: &mut <Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    system: &S,
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
        let JetsMemory { constants, tables, series, orders, unit: signed, .. } = memory;
        let solved =
            system.jet_at(constants, from.t, &from.q, &from.v, &control.0, *signed, *orders, tables, series);
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
        } else if is_finite
            && (tolerated < number(NEAR) || overflowed)
            && tolerated * number(NEAR) > num_traits::One::one()
        {
            // A shorter step than the tolerance allows where coefficients overflow in a longer unit.
            let length = limits.clip(smaller(tolerated, number(NEAR)) * unit);
            if length.partial_cmp(&resolution) != Some(Ordering::Greater) {
                return Err(Cause::StepTooSmall);
            }
            memory.reach(length / unit);
            memory.next = smaller(tolerated, number(NEAR)) * unit;
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
        memory.counts.accepted += 1;
        return Ok(());
    }
}
