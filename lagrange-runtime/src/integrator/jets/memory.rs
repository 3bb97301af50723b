//! The series of a step, and the length to which it may be used.

use num_traits::{One, Zero};

use super::super::landing::{Determined, across};
use super::super::step_size;
use super::fall::{bounded, reach, steepest};
use super::{DECAY, GROWTH, ORDERS_PER_DIGIT, SAFETY, is_at_rounding, last_term, orders};
use crate::constraints::Footing;
use crate::linear::Independence;
use crate::number::compensated::add_product;
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real, larger, smaller};
use crate::series::HIGHEST;
use crate::system::attitude;
use crate::system::error::Cause;
use crate::system::limits::Limits;
use crate::system::method::{Steps, Terms};
use crate::system::smooth::Series;
use crate::system::state::State;

/// The fractional part of the golden ratio. The fractional parts of its multiples fill an interval evenly,
/// whatever the number of them. (L. Kuipers and H. Niederreiter, "Uniform Distribution of Sequences", Wiley
/// 1974, § 2.3.)
const GOLDEN: f64 = 0.618_033_988_749_895;

/// The most by which the unit of a step is longer than its length. All digits of the unit change by that, and
/// nothing else does.
const VARIED: f64 = 1.0 / 1024.0;

/// The memory of [`Jets`] and of `Paced` between steps, with series to order `P`.
#[derive(Clone, Copy, Debug)]
pub struct JetsMemory<C, T, R, const N: usize, const P: usize = HIGHEST> {
    pub(super) constants: C,
    /// The first of the three numbers of each orientation.
    orientations: &'static [usize],
    pub(super) tables: T,
    pub(super) series: Series<R, N, P>,
    /// Whether `tables` belong to the series. Moving the series to another start ends that.
    pub(super) is_as_expanded: bool,
    pub(super) orders: usize,
    /// The tolerance from which the order follows.
    pub(super) tolerance: R,
    /// The largest ratio of successive terms at this order and tolerance.
    pub(super) steepest: R,
    /// The point of expansion, with its residue of compensated summation.
    pub(super) start: State<R, N>,
    pub(super) residue: State<R, N>,
    /// Unit of time of the coefficients \[s], with the direction of the motion.
    pub(super) unit: R,
    /// From 0 to 1: which unit of the next step is taken.
    phase: R,
    /// The unit of the next step, without direction; zero if not known.
    pub(super) next: R,
    /// Length of the last step \[s], without direction; zero before the first.
    pub(super) last: R,
    /// The largest accelerations found by probing steps.
    pub(super) strongest: [R; N],
    /// How independent constraints are at the start of the step; `None` before the first step.
    pub(super) independence: Option<Independence<R>>,
    /// How well the constraints have determined the motion so far; `None` before the first step.
    pub(super) determined: Option<Determined<R>>,
    /// The ulps of coordinates and velocities that constraints couple: none is known better than that.
    pub(super) ulps: [[R; N]; 2],
    pub(super) end: State<R, N>,
    pub(super) end_residue: State<R, N>,
    pub(super) counts: Steps,
}

impl<C: Copy, T: Copy + Default, R: Ordered, const N: usize, const P: usize> JetsMemory<C, T, R, N, P> {
    pub(super) fn new(constants: C, start: State<R, N>, orientations: &'static [usize]) -> Self {
        let zero = State { t: R::zero(), q: [R::zero(); N], v: [R::zero(); N] };
        Self {
            constants,
            orientations,
            tables: T::default(),
            series: Series::default(),
            is_as_expanded: false,
            orders: 0,
            tolerance: -R::one(),
            steepest: R::one(),
            start,
            residue: zero,
            unit: R::zero(),
            phase: R::zero(),
            next: R::zero(),
            last: R::zero(),
            strongest: [R::zero(); N],
            independence: None,
            determined: None,
            ulps: [[R::zero(); N]; 2],
            end: start,
            end_residue: zero,
            counts: Steps::default(),
        }
    }

    /// The unit of the next step, another one in every step. The coefficients of steps in one unit, or of the
    /// same steps again and again, would have the same rounding errors, and the energy would drift with the
    /// number of steps instead of its root.
    pub(super) fn varied(&mut self) -> R {
        let phase = self.phase + R::from_f64(GOLDEN);
        self.phase = if phase < R::one() { phase } else { phase - R::one() };
        self.next * R::mul_add(R::from_f64(VARIED), self.phase, R::one())
    }

    /// Derives the order from the tolerance, if that has changed.
    #[inline]
    pub(super) fn prepare(&mut self, limits: &Limits<R>) {
        if self.tolerance != limits.relative {
            self.derive_order(limits.relative);
        }
    }

    /// Derives the order from a tolerance. A function of its own: the compiler would move its logarithm out
    /// of loops over steps, in front of the comparison that makes it rare.
    #[cold]
    #[inline(never)]
    fn derive_order(&mut self, relative: R) {
        (self.tolerance, self.orders) = (relative, orders(relative, ORDERS_PER_DIGIT));
        self.steepest = steepest(relative, self.orders);
    }

    /// Whether `t` lies in the step, ends included.
    pub(super) fn covers(&self, t: R) -> bool {
        let (a, b) = (self.start.t, self.end.t);
        (a <= t && t <= b) || (b <= t && t <= a)
    }

    /// Whether `t` lies at or beyond the end of the step in its direction; true for a step of no length.
    pub(super) fn ahead(&self, t: R) -> bool {
        let (a, b) = (self.start.t, self.end.t);
        if a <= b { t >= b || a == b } else { t <= b }
    }

    /// The state at a time in the step.
    #[inline]
    pub(super) fn at(&self, t: R) -> State<R, N> {
        if t == self.end.t {
            return self.end;
        }
        let theta = ((t - self.start.t) - self.residue.t) / self.unit;
        self.moved(theta)[0].at_time(t)
    }

    /// Forgets the motion before a state, except the unit of the next step and the counts.
    pub(super) fn begin(&mut self, start: State<R, N>) {
        let zero = State { t: R::zero(), q: [R::zero(); N], v: [R::zero(); N] };
        (self.start, self.residue) = (start, zero);
        (self.end, self.end_residue) = (start, zero);
        (self.unit, self.last) = (R::zero(), R::zero());
        self.strongest = [R::zero(); N];
        (self.independence, self.determined) = (None, None);
        self.ulps = [[R::zero(); N]; 2];
    }

    /// The polynomial of the step, with reactions and functions that are read from the tables.
    pub(super) fn terms(&self, followed: impl FnOnce(&T) -> [&[R]; 2]) -> Terms<'_, R, N> {
        let [reactions, functions] = if self.is_as_expanded { followed(&self.tables) } else { [&[][..]; 2] };
        Terms {
            q: self.series.q.get(..self.orders).unwrap_or_default(),
            v: self.series.v.get(..self.orders).unwrap_or_default(),
            length: ((self.end.t - self.start.t) + (self.end_residue.t - self.residue.t)) / self.unit,
            unit: self.unit,
            residue: self.residue.t,
            reactions,
            functions,
            left: R::zero(),
        }
    }

    /// The state at a part of the step, from 0 to 1.
    pub(super) fn at_part(&self, part: R) -> State<R, N> {
        if part == R::one() {
            return self.end;
        }
        let length = (self.end.t - self.start.t) + (self.end_residue.t - self.residue.t);
        self.moved(part * length / self.unit)[0].at_time(self.start.t + part * length)
    }

    /// The state at `theta` units of the scaled time.
    pub(super) fn state_at(&self, theta: R) -> State<R, N> {
        self.moved(theta)[0].at_time(self.start.t + theta * self.unit)
    }

    /// The coordinates and velocities at `theta` units of the scaled time, with the time of the start, and
    /// their residues.
    #[inline]
    fn moved(&self, theta: R) -> [State<R, N>; 2] {
        let [(rates_q, lost_q), (rates_v, lost_v)] =
            self.series.rates(theta, self.orders, is_at_rounding(self.tolerance));
        let [mut state, mut residue] = [self.start, self.residue];
        let take = |x: &mut R, residue: &mut R, rate: R, lost: R| {
            (*x, *residue) = add_product(*x, R::mul_add(lost, theta, *residue), rate, theta);
        };
        for i in 0..N {
            take(&mut state.q[i], &mut residue.q[i], rates_q[i], lost_q[i]);
            take(&mut state.v[i], &mut residue.v[i], rates_v[i], lost_v[i]);
        }
        [state, residue]
    }

    /// Moves the end of the step to `length` units of the scaled time.
    #[inline]
    pub(super) fn reach(&mut self, length: R) {
        [self.end, self.end_residue] = self.moved(length);
        (self.end.t, self.end_residue.t) = add_product(self.start.t, self.residue.t, length, self.unit);
    }

    /// Makes time run in the other direction: the unit changes its sign, and so do the coefficients of odd
    /// orders, those of the coordinates and those of the velocities.
    pub(super) fn turn(&mut self) {
        self.unit = -self.unit;
        for rows in [&mut self.series.q, &mut self.series.v] {
            for row in rows.iter_mut().step_by(2) {
                *row = row.each(|x| -x);
            }
        }
    }

    /// Records how well the state is determined from which the next step starts.
    pub(super) fn stand(&mut self, footing: &Footing<R, N>) {
        self.ulps = [footing.ulps_q, footing.ulps_v];
        self.independence = Some(footing.independence);
    }

    /// Takes no step, for this cause: the motion stays where it was.
    #[cold]
    pub(super) fn stay(&mut self, cause: Cause) -> Cause {
        (self.end, self.end_residue) = (self.start, self.residue);
        cause
    }

    /// The shortest step that time resolves at the start \[s].
    #[inline]
    pub(super) fn resolution(&self) -> R {
        R::from_f64(4.0) * R::epsilon() * self.start.t.abs() + step_size::smallest()
    }

    /// Replaces the end of the step by a state beside it.
    pub(super) fn correct(&mut self, end: State<R, N>) {
        for i in 0..N {
            // A residue belongs to the number that was rounded, so a corrected one has none.
            if end.q[i] != self.end.q[i] {
                (self.end.q[i], self.end_residue.q[i]) = (end.q[i], R::zero());
            }
            if end.v[i] != self.end.v[i] {
                (self.end.v[i], self.end_residue.v[i]) = (end.v[i], R::zero());
            }
        }
    }

    /// Whether the coefficients of the highest order are finite. Those of lower orders mostly are then, too,
    /// but not where a force is infinite and does not change.
    #[inline]
    pub(super) fn is_finite(&self) -> bool {
        let row = |rows: &[[R; N]; P]| {
            rows.get(self.orders - 1).is_some_and(|row| row.iter().all(|x| x.is_finite()))
        };
        row(&self.series.q) && row(&self.series.v)
    }
}

impl<C: Copy, T: Copy + Default, R: Ordered, const N: usize> JetsMemory<C, T, R, N> {
    /// The length at which the last two terms fall to the tolerance, in units of the scaled time. It is
    /// infinite for a polynomial, and means nothing where a coefficient is not finite.
    ///
    /// Terms before the last two shorten it where these are small by chance: see [`super::fall`].
    ///
    /// The size of a component is that of its first terms over `span`, which should be about the length
    /// itself. With `steady` the unit is the length that error control gave the last step.
    ///
    /// Of numbers with derivatives each component of each derivative has its own size, as coordinates have.
    #[inline]
    pub(super) fn tolerated(&self, limits: &Limits<R>, span: R, steady: bool) -> R {
        let length = |part| self.tolerated_by(limits, span, steady, part);
        R::splat((1..R::PARTS).fold(length(0), |least, part| smaller(least, length(part))))
    }

    /// The same for the values or one of their derivatives.
    #[inline]
    fn tolerated_by(&self, limits: &Limits<R>, span: R, steady: bool, part: usize) -> R::Lane {
        let p = self.orders;
        let weights = self.weights(limits, span, part);
        let term = |order| self.term(&weights, order, part);
        // The ratio of successive terms at the tolerated length.
        let decay = R::Lane::from_f64(DECAY);
        let length = reach(larger(term(p), decay * term(p - 1)), p);
        if steady && length <= R::Lane::from_f64(GROWTH) {
            return length;
        }
        bounded(p, self.steepest.largest(), length, term)
    }

    /// Weights of coordinates and of velocities, or of one of their derivatives: the reciprocals of the
    /// bounds of a last term.
    #[inline]
    fn weights(&self, limits: &Limits<R>, span: R, part: usize) -> [[R::Lane; N]; 2] {
        let (number, zero) = (R::Lane::from_f64, R::Lane::zero());
        let [relative, absolute, span] =
            [last_term(limits.relative), limits.absolute.unwrap_or_else(R::zero), span].each(Real::largest);
        let series = &self.series;
        let of = |x: R| x.part(part).largest();
        let sizes = |x: &[R; N], rows: &[[R; N]; HIGHEST]| {
            array::<_, N>(|i| {
                larger(
                    of(x[i]).abs(),
                    larger((of(rows[0][i]) * span).abs(), (of(rows[1][i]) * span * span).abs()),
                )
            })
        };
        let mut sizes = [sizes(&self.start.q, &series.q), sizes(&self.start.v, &series.v)];
        for &first in self.orientations {
            // An orientation has the size 1 rad everywhere: the identity is one like others.
            let least = if part == 0 { R::Lane::one() } else { zero };
            attitude::share(&mut sizes[0], first, least);
            attitude::share(&mut sizes[1], first, zero);
        }
        let largest = sizes.iter().flatten().fold(zero, |largest, &size| larger(largest, size));
        // The equations of derivatives are linear and have no scale: an absolute error of a derivative is one
        // beside the whole of its column.
        let whole = if part == 0 { R::Lane::one() } else { largest };
        // A component that begins with many zero derivatives has a size that its first terms do not show.
        let absolute = number(SAFETY) * absolute * whole + step_size::smallest::<R::Lane>() * largest;
        let least = step_size::least::<R::Lane>();
        // A tolerance below rounding applies to the coupled coordinates as well.
        let ulps = smaller(relative / R::Lane::epsilon(), R::Lane::one());
        array(|k| {
            let known = if part == 0 { self.ulps[k].each(|ulp| ulps * of(ulp)) } else { [zero; N] };
            array(|i| larger(larger(known[i], relative * sizes[k][i] + absolute), least).recip())
        })
    }

    /// The largest weighted coefficient of an order.
    #[inline(always)]
    fn term(&self, weights: &[[R::Lane; N]; 2], order: usize, part: usize) -> R::Lane {
        let zero = R::Lane::zero();
        let (q, v) = (self.series.q.get(order - 1), self.series.v.get(order - 1));
        let (Some(q), Some(v)) = (q, v) else { return zero };
        let of = |x: R| x.part(part).largest();
        (0..N).fold(zero, |most, i| {
            larger(most, larger(of(q[i]).abs() * weights[0][i], of(v[i]).abs() * weights[1][i]))
        })
    }

    /// The last two terms of the series at `theta` units of the scaled time, as measures of the terms that
    /// follow: the last one, and the one before it reduced by the decay of an order.
    pub(super) fn last_terms(&self, theta: R) -> [State<R, N>; 2] {
        let zero = [R::zero(); N];
        [(self.orders, R::one()), (self.orders - 1, R::from_f64(DECAY))].each(|(order, share)| {
            let factor = share * theta.powi(order as i32);
            let of =
                |rows: &[[R; N]; HIGHEST]| rows.get(order - 1).map_or(zero, |row| row.each(|x| factor * x));
            State { t: self.end.t, q: of(&self.series.q), v: of(&self.series.v) }
        })
    }

    /// The length, in units of the scaled time, at which the last terms are what errors across constraints
    /// may be, where such errors and no others keep the series to the length `theta`.
    ///
    /// Beside a configuration in which constraints depend on each other roundings of a state grow along the
    /// series, and its last terms hardly decay at the tolerated length. Those of the motion itself have
    /// decayed to nothing long before.
    #[cold]
    #[inline(never)]
    pub(super) fn reach_across(&self, limits: &Limits<R>, theta: R) -> Option<R> {
        let (number, p) = (R::Lane::from_f64, self.orders);
        let weights = self.weights(limits, theta, 0);
        let at = theta.largest();
        // Both of two orders are taken, halfway, since symmetry makes every other term vanish.
        let term = |order: usize| self.term(&weights, order, 0) * at.powi(order as i32);
        let halfway = larger(term(p / 2), term(p / 2 - 1));
        if halfway.ln() > -number(DECAY).ln() * number(0.25) * number(p as f64) {
            return None;
        }
        // Constraints couple coordinates, so these errors are parts of the whole state in the kinetic metric.
        let share = across(last_term(limits.relative), &self.independence?).largest() / R::Lane::epsilon();
        let weights = self.ulps.each(|ulps| ulps.each(|ulp| (share * ulp.largest()).recip()));
        let term = |order: usize| self.term(&weights, order, 0);
        let longer = R::splat(reach(larger(term(p), number(DECAY) * term(p - 1)), p));
        (longer > theta && longer.is_finite()).then_some(longer)
    }
}

#[cfg(test)]
mod tests;
