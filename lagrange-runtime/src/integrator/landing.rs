//! The check of every step of a constrained motion, and where a step may end.
//!
//! Three things tell whether a step went wrong, whatever the reason. The **correction** that brings its end
//! back onto the constraints is a part of its error. The **defect**, the difference between the accelerations
//! of its polynomial and those of the equations, is another part (Enright, "A new error-control for initial
//! value solvers", Appl. Math. Comput. 31, 1989). The change of the **energy** is one where the macro has
//! proved that there is none (`landing/energy.rs`). All are held against the tolerance.
//!
//! A step does not end where the constraints do not determine the state well, beside a configuration in which
//! they depend on each other: there, rounding errors of the constraints are large changes of the state. What
//! was determined in the motion so far is the measure, so constraints that are redundant everywhere do no
//! harm.

pub(crate) mod energy;

use super::beside::beside;
use super::step_size;
use crate::constraints::Footing;
use crate::linear::{Independence, determined};
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real, larger, smaller};
use crate::system::System;
use crate::system::error::Cause;
use crate::system::limits::Limits;
use crate::system::state::{State, difference};

/// Largest corrections and defects, in tolerances. The last terms of a series are a fifth of the tolerance,
/// and their derivative is larger by the order.
pub(crate) const MARGIN: f64 = 16.0;

/// Uncertainty of accelerations, in ulps of their largest term. No error is compared with a tolerance below
/// that.
pub(crate) const NOISE: f64 = 256.0;

/// How far [`Check::leaves`] looks ahead, in parts of the distance from a configuration in which constraints
/// depend on each other, and of the step.
const AHEAD: f64 = 1.0 / 64.0;

/// How well the constraints have determined the motion so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Determined<R> {
    rank: usize,
    least: R,
}

impl<R: Ordered> Determined<R> {
    /// How well a start determines the motion.
    pub(crate) fn at_start(here: &Independence<R>) -> Self {
        // Rows that are nearly dependent from the beginning may come a little closer.
        Self { rank: here.rank, least: smaller(determined(), R::from_f64(0.25) * here.least) }
    }

    /// Whether a state is determined at least as well.
    pub(crate) fn accepts(&self, here: &Independence<R>) -> bool {
        here.rank >= self.rank && here.least >= self.least
    }

    /// Records an accepted state.
    pub(crate) fn learn(&mut self, here: &Independence<R>) {
        if here.rank > self.rank {
            *self = Self::at_start(here);
        }
        if here.least > determined() {
            self.least = determined();
        }
    }
}

/// The relative tolerance, but not below rounding errors.
fn relative<R: Ordered>(limits: &Limits<R>) -> R {
    larger(limits.relative, R::from_f64(NOISE) * R::epsilon())
}

/// The bound of errors across the constraints, relative to a state, at a tolerance: its square over the
/// distance from a configuration in which constraints depend on each other is the tolerance.
pub(crate) fn across<R: Ordered>(relative: R, independence: &Independence<R>) -> R {
    (relative * independence.least).sqrt()
}

/// The difference between the accelerations of a polynomial and those of the equations.
struct Defect<R, const N: usize> {
    difference: [R; N],
    /// The larger of both.
    strongest: [R; N],
}

impl<R: Ordered, const N: usize> Defect<R, N> {
    fn between(slopes: &[R; N], found: &[R; N]) -> Self {
        let strongest = array(|i| larger(slopes[i].abs(), found[i].abs()));
        Self { difference: difference(found, slopes), strongest }
    }
}

/// The difference of two states at about the same time.
pub(crate) fn apart<R: Ordered, const N: usize>(a: &State<R, N>, b: &State<R, N>) -> State<R, N> {
    State { t: b.t, q: difference(&a.q, &b.q), v: difference(&a.v, &b.v) }
}

/// Whether a change of coordinates and velocities is within a bound for each.
fn is_within<R: Ordered, const N: usize>(
    change: &State<R, N>,
    footing: &Footing<R, N>,
    [size, speed]: [R; 2],
) -> bool {
    footing.metric.extent(&change.q) <= size && footing.metric.extent(&change.v) <= speed
}

/// The scale of errors of a step, in the kinetic metric.
#[derive(Clone, Copy)]
struct Sizes<R> {
    /// The scales of the coordinates and of the velocities.
    of: [R; 2],
    /// The absolute tolerance.
    absolute: R,
}

/// The end of a step, on the constraints.
pub(crate) struct Landing<R, const N: usize> {
    pub(crate) end: State<R, N>,
    pub(crate) footing: Footing<R, N>,
    sizes: Sizes<R>,
    /// Whether correction, defect and energy are within the tolerance, or beyond it without harm.
    pub(crate) is_right: bool,
}

/// The data that a step is checked with.
pub(crate) struct Check<'a, S: System<N, K>, const N: usize, const K: usize> {
    pub(crate) system: &'a S,
    pub(crate) constants: &'a S::Constants,
    pub(crate) inputs: &'a [S::Scalar; K],
    pub(crate) limits: &'a Limits<S::Scalar>,
    /// The state before the step.
    pub(crate) from: &'a State<S::Scalar, N>,
}

impl<S: System<N, K>, const N: usize, const K: usize> Check<'_, S, N, K>
where
    S::Scalar: Ordered,
{
    /// Brings the state that a step has `reached` onto the constraints and checks it. `slopes` are the
    /// accelerations of its polynomial there, if it has one.
    ///
    /// # Errors
    /// Why it cannot be brought back.
    pub(crate) fn land(
        &self,
        reached: &State<S::Scalar, N>,
        slopes: Option<&[S::Scalar; N]>,
    ) -> Result<Landing<S::Scalar, N>, Cause> {
        let mut end = *reached;
        let footing = self.system.land_at(self.constants, &mut end, slopes.map(|_| self.inputs))?;
        let sizes = self.sizes(&end, (end.t - self.from.t).abs(), &footing);
        let mut landing = Landing { end, footing, sizes, is_right: true };
        let defect = slopes.map(|slopes| {
            let found = footing.accelerations.unwrap_or_else(|| self.accelerations(&end));
            Defect::between(slopes, &found)
        });
        let is_near = self.is_near(reached, &landing);
        let obeys = defect.as_ref().is_none_or(|defect| self.obeys(defect, &landing));
        landing.is_right = (is_near && obeys || self.is_excused(reached, &landing, (is_near, defect)))
            && self.keeps_energy(&landing.end, &landing.footing);
        Ok(landing)
    }

    /// Whether the polynomial of a step obeys the equations at a state on the way to its landing.
    pub(crate) fn agrees(
        &self,
        state: &State<S::Scalar, N>,
        slopes: &[S::Scalar; N],
        landing: &Landing<S::Scalar, N>,
    ) -> bool {
        let defect = Defect::between(slopes, &self.accelerations(state));
        self.obeys(&defect, landing)
            || self.obeys_rounded(&defect, state, landing, self.roundings(state, &landing.footing))
    }

    /// Whether constraints become more independent beyond a landing.
    #[cold]
    pub(crate) fn leaves(&self, landing: &Landing<S::Scalar, N>) -> bool {
        let Landing { end, footing, .. } = landing;
        let mut ahead = *end;
        // Independence is a distance as a part of the coordinates.
        let near = footing.independence.least * footing.metric.extent(&end.q) / footing.metric.extent(&end.v);
        let step = end.t - self.from.t;
        let span = S::Scalar::from_f64(AHEAD) * step.signum() * smaller(near, step.abs());
        for i in 0..N {
            ahead.q[i] += span * ahead.v[i];
        }
        ahead.t += span;
        let there = self.system.land_at(self.constants, &mut ahead, None);
        there.is_ok_and(|there| there.independence.least > footing.independence.least)
    }

    /// Whether the correction is within the tolerance. Constraints couple the coordinates, so differences and
    /// sizes are those of whole states in the kinetic metric: a coordinate that is zero up to rounding has no
    /// scale of its own.
    fn is_near(&self, reached: &State<S::Scalar, N>, landing: &Landing<S::Scalar, N>) -> bool {
        let Landing { end, footing, sizes, .. } = landing;
        is_within(&apart(reached, end), footing, self.bounds(sizes))
    }

    /// Whether a change of the state before the step is an error within the tolerance, for a step of this
    /// `span` \[s].
    pub(crate) fn is_small(
        &self,
        change: &State<S::Scalar, N>,
        span: S::Scalar,
        footing: &Footing<S::Scalar, N>,
    ) -> bool {
        is_within(change, footing, self.bounds(&self.sizes(self.from, span.abs(), footing)))
    }

    /// Whether a change leaves half of all digits of the state before the step. The numbers of a start are
    /// rounded. Beside a configuration in which constraints depend on each other, roundings put it that far
    /// off the motion.
    pub(crate) fn is_half(
        &self,
        change: &State<S::Scalar, N>,
        span: S::Scalar,
        footing: &Footing<S::Scalar, N>,
    ) -> bool {
        let half = S::Scalar::epsilon().sqrt();
        is_within(change, footing, self.sizes(self.from, span.abs(), footing).of.each(|size| half * size))
    }

    /// The sizes of coordinates and velocities in a step.
    fn sizes(
        &self,
        end: &State<S::Scalar, N>,
        span: S::Scalar,
        footing: &Footing<S::Scalar, N>,
    ) -> Sizes<S::Scalar> {
        let absolute = self.limits.absolute.unwrap_or_else(num_traits::Zero::zero) + step_size::smallest();
        let speed = larger(footing.metric.extent(&end.v), footing.metric.extent(&self.from.v));
        let size = larger(footing.metric.extent(&end.q), footing.metric.extent(&self.from.q));
        Sizes { of: [larger(size, speed * span), speed], absolute: footing.metric.extent(&[absolute; N]) }
    }

    /// Whether the polynomial obeys the equations within the tolerance and the rounding errors of its
    /// accelerations.
    fn obeys(&self, defect: &Defect<S::Scalar, N>, landing: &Landing<S::Scalar, N>) -> bool {
        self.obeys_with(defect, landing, num_traits::Zero::zero())
    }

    /// The same with further rounding errors of the accelerations.
    fn obeys_with(
        &self,
        defect: &Defect<S::Scalar, N>,
        landing: &Landing<S::Scalar, N>,
        roundings: S::Scalar,
    ) -> bool {
        let Landing { end, footing, sizes, .. } = landing;
        let span = (end.t - self.from.t).abs();
        let size = larger(sizes.of[1], footing.metric.extent(&defect.strongest) * span);
        footing.metric.extent(&defect.difference) * span
            <= self.bound(size, sizes.absolute) + roundings * span
    }

    /// The same where forces balance each other: their sum has their roundings. Each acceleration has
    /// roundings of its own, those of the forces at its coordinate and of the forces that constraints pass on
    /// to it. So a small motion along a floor is not lost in the weight that the floor bears.
    #[cold]
    fn obeys_rounded(
        &self,
        defect: &Defect<S::Scalar, N>,
        state: &State<S::Scalar, N>,
        landing: &Landing<S::Scalar, N>,
        roundings: S::Scalar,
    ) -> bool {
        if self.obeys_with(defect, landing, roundings) {
            return true;
        }
        let none = State { t: num_traits::Zero::zero(), ..apart(state, state) };
        let by = State { v: landing.footing.ulps_a, ..none };
        // The second of two states is opposite to the first, and so is its part along the constraints.
        let known = beside(&none, &by).step_by(2).fold(by.v, |known, change| {
            let along = self.system.tangential_at(state, &change).v;
            array(|i| larger(known[i], along[i].abs()))
        });
        let difference = array(|i| {
            let x = defect.difference[i];
            if x.abs() <= S::Scalar::from_f64(MARGIN) * known[i] { num_traits::Zero::zero() } else { x }
        });
        self.obeys_with(&Defect { difference, ..*defect }, landing, roundings)
    }

    /// The change of the accelerations by rounding errors of the coordinates and of time. Where strong forces
    /// are in balance it exceeds the rounding errors of the accelerations.
    #[cold]
    fn roundings(&self, state: &State<S::Scalar, N>, footing: &Footing<S::Scalar, N>) -> S::Scalar {
        let here = self.accelerations(state);
        let by = State {
            t: S::Scalar::epsilon() * state.t.abs(),
            q: footing.ulps_q,
            v: [num_traits::Zero::zero(); N],
        };
        let largest = beside(state, &by).fold(num_traits::Zero::zero(), |largest, beside| {
            larger(largest, footing.metric.extent(&difference(&self.accelerations(&beside), &here)))
        });
        S::Scalar::from_f64(MARGIN) * largest
    }

    /// Whether a difference beyond the tolerance is harmless. Two kinds are:
    ///
    /// * Roundings of forces that keep a balance.
    /// * Errors across the constraints, beside a configuration in which these depend on each other: there,
    ///   rounding errors of a state grow on the way, and a retraction takes them back. What it leaves is
    ///   their square, times the curvature of the constraints, which is the reciprocal of the distance from
    ///   that configuration.
    #[cold]
    #[inline(never)]
    fn is_excused(
        &self,
        reached: &State<S::Scalar, N>,
        landing: &Landing<S::Scalar, N>,
        (is_near, defect): (bool, Option<Defect<S::Scalar, N>>),
    ) -> bool {
        let Landing { end, footing, sizes, .. } = landing;
        let span = (end.t - self.from.t).abs();
        let roundings = self.roundings(end, footing);
        // Roundings of the forces across the constraints are taken back.
        let known = S::Scalar::from_f64(MARGIN) * footing.metric.extent(&footing.ulps_a);
        let gained = larger(roundings, known) * span;
        let is_regular = footing.independence.are_far_apart();
        let is_across = || {
            let relative = relative(self.limits);
            let share = if is_regular { relative } else { across(relative, &footing.independence) };
            let [size, speed] = sizes.of.each(|size| share * size);
            is_within(&apart(reached, end), footing, [size + gained * span, speed + gained])
        };
        let obeys = |defect| self.obeys_rounded(&defect, end, landing, roundings);
        let along = |mut defect: Defect<S::Scalar, N>| {
            if !is_regular {
                let difference = State { v: defect.difference, ..apart(end, end) };
                defect.difference = self.system.tangential_at(end, &difference).v;
            }
            defect
        };
        (is_near || is_across()) && defect.is_none_or(|defect| obeys(along(defect)))
    }

    /// Whether an error of the end of a step is within the tolerance along the constraints.
    pub(crate) fn is_small_along(
        &self,
        error: &State<S::Scalar, N>,
        landing: &Landing<S::Scalar, N>,
    ) -> bool {
        let Landing { end, footing, sizes, .. } = landing;
        let error = self.system.tangential_at(end, error);
        let margin = S::Scalar::from_f64(1.0 / MARGIN);
        is_within(&error, footing, self.bounds(sizes).each(|bound| margin * bound))
    }

    fn accelerations(&self, state: &State<S::Scalar, N>) -> [S::Scalar; N] {
        self.system.accelerations_on_at(self.constants, state.t, &state.q, &state.v, self.inputs)
    }

    /// The bounds of errors of coordinates and velocities.
    fn bounds(&self, sizes: &Sizes<S::Scalar>) -> [S::Scalar; 2] {
        sizes.of.each(|size| self.bound(size, sizes.absolute))
    }

    /// The bound of an error of a quantity of this size.
    fn bound(&self, size: S::Scalar, absolute: S::Scalar) -> S::Scalar {
        S::Scalar::from_f64(MARGIN) * (relative(self.limits) * size + absolute)
    }
}

#[cfg(test)]
mod tests;
