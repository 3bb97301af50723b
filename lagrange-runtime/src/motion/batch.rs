//! [`Batch`]: several motions of one kind at once, one in each lane of a SIMD vector.
//!
//! The scalar of the system is a vector (`Lanes<f64x8>`, feature `wide`), so states and parameters differ
//! from lane to lane and the same generated code serves all of them. All lanes expand together to the same
//! order; each takes the step that its own series allows.

mod landing;
mod lane;
pub mod relay;

use crate::integrator::jets::fall::{predicted, steepest};
use crate::integrator::jets::probe::{self, Probe};
use crate::integrator::jets::{NEAR, last_term, orders};
use crate::integrator::step_size;
use crate::number::elements::{Each, array};
use crate::number::real::{Real, any};
use crate::series::HIGHEST;
use crate::system::attitude;
use crate::system::error::{Cause, MotionError};
use crate::system::smooth::{Series, Smooth};
use crate::system::state::State;

/// Orders of the series for each natural digit of the tolerance. There are fewer than for a single motion,
/// because the work of a step grows with the square of the order once the lanes fill the vectors.
const ORDERS_PER_DIGIT: f64 = 0.7;

/// exp(−1 / `ORDERS_PER_DIGIT`).
const DECAY: f64 = 0.24;

/// Motions of `system` in the lanes of its scalar, by Taylor series.
#[derive(Clone, Copy, Debug)]
pub struct Batch<'a, S: Smooth<N, K>, const N: usize, const K: usize = 0> {
    system: &'a S,
    constants: S::JetConstants,
    tables: S::Tables<HIGHEST>,
    series: Series<S::Scalar, N, HIGHEST>,
    inputs: [S::Scalar; K],
    tolerance: <S::Scalar as Real>::Lane,
    attempts: u64,
    /// Unit of time of the coefficients \[s], without direction; zero if not known.
    unit: S::Scalar,
    state: State<S::Scalar, N>,
    /// The residue of rounding of the state.
    residue: State<S::Scalar, N>,
    expansions: u64,
    /// Lengths of the last steps \[s], without direction; zero before the first.
    last: S::Scalar,
    /// The largest accelerations that probed steps have met.
    strongest: [S::Scalar; N],
    /// How independent constraints are at the states; zero before the first step.
    least: S::Scalar,
    /// The largest ratio of successive terms at the tolerance of the last call.
    steepest: <S::Scalar as Real>::Lane,
}

impl<'a, S: Smooth<N, K>, const N: usize, const K: usize> Batch<'a, S, N, K> {
    /// Motions from the lanes of `start`, with inputs at zero. The times of the lanes may differ.
    #[inline]
    pub fn new(system: &'a S, start: State<S::Scalar, N>) -> Self {
        let zero: S::Scalar = num_traits::Zero::zero();
        Self {
            system,
            constants: system.jet_constants(),
            tables: S::Tables::default(),
            series: Series::default(),
            inputs: [zero; K],
            tolerance: Real::max(
                <S::Scalar as Real>::Lane::from_f64(1e-10),
                <S::Scalar as Real>::Lane::from_f64(100.0) * <S::Scalar as Real>::Lane::epsilon(),
            ),
            attempts: 10_000_000,
            unit: zero,
            state: start,
            residue: State { t: zero, q: [zero; N], v: [zero; N] },
            expansions: 0,
            last: zero,
            strongest: [zero; N],
            least: zero,
            steepest: num_traits::One::one(),
        }
    }

    /// Tolerated local error, relative to the size of each coordinate and velocity. Default 1e-10, for `f32`
    /// 100 ε.
    #[inline]
    #[must_use]
    pub fn with_tolerance(mut self, tolerance: <S::Scalar as Real>::Lane) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// Expansions that one call of `advance_to` may make. Default 10 million.
    #[inline]
    #[must_use]
    pub fn with_max_steps(mut self, steps: u64) -> Self {
        self.attempts = steps;
        self
    }

    /// Holds these inputs from here on.
    #[inline]
    pub fn set_inputs(&mut self, inputs: [S::Scalar; K]) {
        self.inputs = inputs;
    }

    /// The states, lane by lane.
    #[inline]
    pub fn state(&self) -> &State<S::Scalar, N> {
        &self.state
    }

    /// Expansions so far, each of all lanes.
    #[inline]
    pub fn expansions(&self) -> u64 {
        self.expansions
    }

    /// Moves all lanes to exactly time `t` \[s], forward or backward.
    ///
    /// # Errors
    /// [`Cause::InvalidTime`], `InvalidTolerance` for bad arguments; [`Cause::PositionViolated`] or
    /// `VelocityViolated` for a start off the constraints in some lane; [`Cause::NotFinite`] or
    /// `SingularMassMatrix` where some lane cannot go on, [`Cause::StepTooSmall`] where its steps vanish, and
    /// what is wrong with the constraints themselves, with the times of all lanes; [`Cause::TooManySteps`].
    /// The state is then the last good one.
    pub fn advance_to(
        &mut self,
        t: <S::Scalar as Real>::Lane,
    ) -> Result<&State<S::Scalar, N>, MotionError<S::Scalar>> {
        self.advance(t).map_err(|cause| MotionError { cause, t: self.state.t })?;
        Ok(&self.state)
    }

    fn advance(&mut self, t: <S::Scalar as Real>::Lane) -> Result<(), Cause> {
        let number = S::Scalar::from_f64;
        let zero: <S::Scalar as Real>::Lane = num_traits::Zero::zero();
        if !t.is_finite() {
            return Err(Cause::InvalidTime);
        }
        if !(self.tolerance.is_finite() && self.tolerance >= zero) {
            return Err(Cause::InvalidTolerance);
        }
        if !self.state.is_finite() {
            return Err(Cause::NotFinite);
        }
        if S::CONSTRAINED && self.expansions == 0 {
            let (constants, mut start) = (self.system.constants(), self.state);
            self.system.begin_at(&constants, &mut start)?;
            self.state = start;
        }
        let target = S::Scalar::splat(t);
        let orders = orders(self.tolerance, ORDERS_PER_DIGIT);
        self.steepest = steepest(self.tolerance, orders);
        let resolution = number(4.0) * S::Scalar::epsilon() * target.abs().max(self.state.t.abs());
        let mut attempts = self.attempts;
        loop {
            let left = (target - self.state.t) - self.residue.t;
            let missing = left.abs() - resolution;
            if missing.largest() <= zero {
                (self.state.t, self.residue.t) = (target, num_traits::Zero::zero());
                return Ok(());
            }
            if attempts == 0 {
                return Err(Cause::TooManySteps);
            }
            attempts -= 1;
            let direction = left.signum();
            if !self.unit.is_positive() {
                self.unit = S::Scalar::splat(left.abs().largest());
            }
            self.expand(orders, direction)?;
            let one: S::Scalar = num_traits::One::one();
            let mut tolerated = self.tolerated(orders, one);
            if any(number(0.5) - tolerated) {
                // In a unit much longer than the step the first terms are no measure of the size.
                tolerated = self.tolerated(orders, tolerated.min(one));
            }
            if !(tolerated.is_finite() && self.series_is_finite(orders)) {
                // Some lane is out of the range of the arithmetic, or of the domain of the equations.
                self.unit *= number(1e-3);
                if (resolution - self.unit).largest() >= zero {
                    return Err(Cause::NotFinite);
                }
                continue;
            }
            let near = number(NEAR);
            let (too_small, too_large) =
                (near.recip() - tolerated, (tolerated - near).min(left.abs() - self.unit));
            let is_far = too_small.max(too_large).min(missing);
            if any(is_far) {
                // Units far from the steps: coefficients near the ends of the arithmetic. Other lanes keep
                // theirs; that of a polynomial in time, or of one that has arrived, would grow without end.
                self.unit *= tolerated.max(number(1e-6)).min(number(1e6)).where_positive(is_far, one);
                if (resolution - self.unit).largest() >= zero {
                    return Err(Cause::StepTooSmall);
                }
                continue;
            }
            let mut natural = (tolerated.min(near) * self.unit).where_positive(missing, self.unit);
            if S::STEEP {
                natural = probe::restrained(natural, self.last, left.abs()).where_positive(missing, natural);
            }
            let mut length = natural.min(left.abs());
            if S::STEEP || S::ROOTED && self.comes_near_roots(length, direction, orders) {
                length = self.probed(length, orders, direction, left.abs(), [missing, resolution])?;
            }
            if any(missing.min(resolution - length)) {
                return Err(Cause::StepTooSmall);
            }
            if S::CONSTRAINED {
                length = self.land(length, orders, direction, [missing, resolution])?;
            } else {
                (self.state, self.residue) = self.reached(direction * length, length / self.unit, orders)?;
            }
            if let Some(settled) = attitude::settle(S::ORIENTATIONS, &self.state) {
                let zero = [num_traits::Zero::zero(); N];
                (self.state, self.residue) = (settled, State { t: self.residue.t, q: zero, v: zero });
            }
            self.last = length.max(number(1e-3) * self.last).where_positive(missing, self.last);
            self.unit = natural;
        }
    }

    /// The series of all lanes, forward or backward.
    #[inline]
    fn expand(&mut self, orders: usize, direction: S::Scalar) -> Result<(), Cause> {
        let Self { system, constants, tables, series, inputs, state, .. } = self;
        self.expansions += 1;
        let unit = direction * self.unit;
        if system.jet_at(constants, state.t, &state.q, &state.v, inputs, unit, orders, tables, series) {
            return Ok(());
        }
        let constants = system.constants();
        let found = system.check_at(&constants, state.t, &state.q, &state.v);
        Err(found.err().unwrap_or(Cause::NotFinite).named(&S::NAMES))
    }

    #[inline]
    fn tolerated(&self, orders: usize, span: S::Scalar) -> S::Scalar {
        let [last_term, steepest] = [last_term(self.tolerance), self.steepest].each(S::Scalar::splat);
        let bounds = [last_term, num_traits::Zero::zero()];
        tolerated::<S, N, K>(&self.state, &self.series, bounds, steepest, orders, span)
    }

    /// A length at which every lane obeys the equations of motion. `missing` is positive in lanes that have
    /// not arrived; the others have steps of no length.
    #[cold]
    fn probed(
        &mut self,
        mut length: S::Scalar,
        orders: usize,
        direction: S::Scalar,
        left: S::Scalar,
        [missing, resolution]: [S::Scalar; 2],
    ) -> Result<S::Scalar, Cause> {
        let constants = self.system.constants();
        let mut strongest = self.strongest;
        // Where all lanes reach as far as a series of zeros does, their motions are polynomials in time.
        let endless = (-S::Scalar::epsilon().powi(4).ln() / S::Scalar::from_f64(orders as f64)).exp();
        let free = endless * S::Scalar::from_f64(0.99) - self.tolerated(orders, num_traits::One::one());
        let is_free = free.largest() <= num_traits::Zero::zero();
        let probe = Probe {
            system: self.system,
            constants: &constants,
            inputs: &self.inputs,
            start: &self.state,
            series: &self.series,
            orders,
            unit: direction * self.unit,
            tolerances: [S::Scalar::splat(self.tolerance), S::Scalar::epsilon().powi(4)],
        };
        if is_free && !self.last.is_positive() {
            probe.look_ahead(left / self.unit, &mut strongest);
        }
        if !S::STEEP {
            probe.level(&mut strongest);
        }
        let mut is_measured = false;
        loop {
            let faults = probe.faults(length / self.unit, &mut strongest);
            if !any(faults) {
                break;
            }
            if !core::mem::replace(&mut is_measured, true) {
                probe.measure(&mut strongest);
                continue;
            }
            length = (length * S::Scalar::from_f64(0.5)).where_positive(faults, length);
            if any(missing.min(resolution - length)) {
                return Err(Cause::StepTooSmall);
            }
        }
        if S::STEEP {
            self.strongest = strongest;
        }
        Ok(length)
    }

    #[inline]
    fn series_is_finite(&self, orders: usize) -> bool {
        let row = |rows: &[[S::Scalar; N]; HIGHEST]| {
            rows.get(orders - 1).is_some_and(|row| row.iter().all(|x| x.is_finite()))
        };
        row(&self.series.q) && row(&self.series.v)
    }
}

/// The lengths at which the terms of the highest orders fall to `bounds`, relative to the size of a component
/// and absolute, in units. The size of a component is that of its first terms over `span`. As in a single
/// motion, earlier terms shorten them where the last two are small by chance: see
/// [`fall`](crate::integrator::jets::fall). `steepest` is the ratio of successive terms in its first rule.
#[inline]
fn tolerated<S: Smooth<N, K>, const N: usize, const K: usize>(
    state: &State<S::Scalar, N>,
    series: &Series<S::Scalar, N, HIGHEST>,
    [relative, absolute]: [S::Scalar; 2],
    steepest: S::Scalar,
    orders: usize,
    span: S::Scalar,
) -> S::Scalar {
    let number = S::Scalar::from_f64;
    let [zero, one]: [S::Scalar; 2] = [num_traits::Zero::zero(), num_traits::One::one()];
    let decline = steepest.recip();
    let part_of =
        |row: Option<&[S::Scalar; N]>, part| row.map_or([zero; N], |row| row.each(|x| x.part(part)));
    let sizes = |x: &[S::Scalar; N], rows: &[[S::Scalar; N]; HIGHEST], part: usize, least: S::Scalar| {
        let (first, second) = (part_of(rows.first(), part), part_of(rows.get(1), part));
        let mut sizes: [S::Scalar; N] =
            array(|i| x[i].part(part).abs().max(first[i].abs() * span).max(second[i].abs() * span * span));
        for &first in S::ORIENTATIONS {
            attitude::share(&mut sizes, first, least);
        }
        sizes
    };
    let least = S::Scalar::splat(step_size::least());
    // The reciprocals of the bounds of a last term, of coordinates and of velocities.
    let weights = |part: usize| {
        // The size of the parameters of any orientation is 1 rad.
        let rad = if part == 0 { one } else { zero };
        let sizes = [sizes(&state.q, &series.q, part, rad), sizes(&state.v, &series.v, part, zero)];
        let largest = sizes.iter().flatten().fold(zero, |largest, &size| largest.max(size));
        let absolute = absolute + S::Scalar::epsilon().powi(4) * largest;
        sizes.each(|sizes| sizes.each(|size| (relative * size + absolute).max(least).recip()))
    };
    let (mut last, mut early) = (S::Scalar::epsilon().powi(4), zero);
    let mut weigh = |weights: [S::Scalar; N], rows: &[[S::Scalar; N]; HIGHEST], part: usize| {
        let row = |k: usize| part_of(rows.get(k), part);
        let mut terms = [zero; N];
        for order in orders / 2..orders.saturating_sub(2) {
            let term = row(order);
            for i in 0..N {
                terms[i] = (terms[i] * decline).max(term[i].abs());
            }
        }
        let (before_last, at_last) = (row(orders - 2), row(orders - 1));
        for i in 0..N {
            last = last.max(at_last[i].abs().max(number(DECAY) * before_last[i].abs()) * weights[i]);
            early = early.max(terms[i] * (decline * decline) * weights[i]);
        }
    };
    for part in 0..S::Scalar::PARTS {
        let [of_q, of_v] = weights(part);
        weigh(of_q, &series.q, part);
        weigh(of_v, &series.v, part);
    }
    let mut worst = last.max(early);
    if any(early - last) {
        let mut by_fall = zero;
        for part in 0..S::Scalar::PARTS {
            let weights = weights(part);
            let term = |order: usize| {
                let rows = [&series.q, &series.v].map(|rows| part_of(rows.get(order - 1), part));
                let sizes = |k: usize| (0..N).map(move |i| rows[k][i].abs() * weights[k][i]);
                sizes(0).chain(sizes(1)).fold(zero, S::Scalar::max)
            };
            by_fall = by_fall.max(predicted(orders, term));
        }
        worst = last.max(early.min(by_fall));
    }
    (-worst.ln() / number(orders as f64)).exp()
}
