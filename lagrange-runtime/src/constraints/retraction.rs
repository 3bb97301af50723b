//! The retraction onto the constraints: Newton's method in the metric of the mass matrix, first for the
//! coordinates, then for the velocities.
//!
//! A correction is the shortest one that satisfies the linearised constraints. Near the constraints one
//! factorisation serves all corrections. Far from them (a rough start) each correction has its own, and is
//! halved until it helps.
//!
//! **When a state is on the constraints.** Newton's method in floating-point arithmetic converges until the
//! rounding errors of the residual stop it (Tisseur, "Newton's method in floating point arithmetic and
//! iterative refinement of generalized eigenvalue problems", SIAM J. Matrix Anal. 22, 2001). So a state is
//! accepted where
//!
//! 1. residuals are rounding errors of their own summands, or
//! 2. the next correction would be below an ulp of the state (it is smaller than the last one by the ratio of
//!    the residuals after and before that), or
//! 3. corrections no longer help, and the residual is below √ε of the summands and of the state: it is then
//!    the rounding error of inner operations, which the summands do not show.
//!
//! Everything else is an error. The second rule accounts for the condition of the constraints: where the
//! smallest singular value of the scaled gradients is σ, an ulp of f corresponds to a correction of ε/σ.
//!
//! Corrections satisfy the independent rows only. A demand of dependent rows that contradicts them shows in
//! no correction. So where rows are dependent, the state must also satisfy the bound for starts, and a larger
//! residual is a contradiction.

mod blurred;
mod project;

use super::residuals::Level;
use super::solution::regular_at;
use super::start::SHARE;
use super::{Factors, Residuals, Surface, moved};
use crate::linear::{Gradients, Independence, SaddlePoint, determined};
use crate::number::elements::Each;
use crate::number::real::Real;
use crate::system::error::Cause;
use crate::system::metric::Metric;
use crate::system::state::State;
pub use project::project;
pub(super) use project::slopes;

/// Corrections before a state near the constraints is given up. Each leaves a tenth at most, or the factors
/// are made anew.
const NEAR: usize = 16;

/// Corrections of a rough start. Where they are cut short, each leaves three quarters of the distance, and a
/// hundred of them lead to rounding errors.
const ROUGH: usize = 200;

/// How many shares of a correction of a rough start are tried, each half of the one before.
const HALVINGS: usize = 12;

/// The longest correction of a rough start, in units of its distance from the constraints. Where constraints
/// nearly depend on each other, Newton's corrections lead far away.
const REACH: f64 = 4.0;

/// With a contraction worse than this the factors are made anew.
const CONTRACTION: f64 = 0.1;

/// Where a retraction starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum From {
    /// Beside the constraints, where a step has ended.
    Near,
    /// Anywhere.
    Far,
}

/// A corrected state, its residuals, and the share of the correction that was made.
type Corrected<R, const N: usize, const C: usize> = (State<R, N>, Residuals<R, C>, R);

/// A state on its way, with the factors of M and A at or near it.
pub(crate) struct Retraction<S: Surface<N, K, C>, const N: usize, const K: usize, const C: usize> {
    pub(crate) state: State<S::Scalar, N>,
    pub(crate) saddle: S::Saddle,
    pub(super) residuals: Residuals<S::Scalar, C>,
    gradients: <S::Saddle as SaddlePoint<S::Scalar, N, C>>::Gradients,
    pub(super) metric: Metric<S::Scalar, N>,
    /// How fast constraints change, in its units.
    pub(super) slopes: [S::Scalar; C],
    /// Whether the factors are those of the state itself.
    is_fresh: bool,
    /// Whether corrections make nothing better any more.
    is_stuck: bool,
}

impl<S, const N: usize, const K: usize, const C: usize> Retraction<S, N, K, C>
where
    S: Surface<N, K, C>,
{
    /// With factors made here. One copy serves all callers: it is a tenth of a small program.
    #[inline(never)]
    pub(crate) fn new(system: &S, state: &State<S::Scalar, N>, residuals: Residuals<S::Scalar, C>) -> Self {
        Self::with(state, residuals, system.saddle_at(state.t, &state.q, &state.v))
    }

    /// With factors that have been made for this state.
    pub(super) fn with(
        state: &State<S::Scalar, N>,
        residuals: Residuals<S::Scalar, C>,
        (saddle, gradients): Factors<S, N, K, C>,
    ) -> Self {
        let metric = Metric::of(&saddle);
        let slopes = metric.slopes(&gradients);
        Self { state: *state, saddle, residuals, gradients, metric, slopes, is_fresh: true, is_stuck: false }
    }

    /// With factors that have been made for another state, on the constraints.
    pub(super) fn from_elsewhere(
        system: &S,
        state: &State<S::Scalar, N>,
        factors: Factors<S, N, K, C>,
    ) -> Self {
        let residuals = system.residuals_at(state.t, &state.q, &state.v);
        Self { is_fresh: false, ..Self::with(state, residuals, factors) }
    }

    /// Checks the factors.
    ///
    /// # Errors
    /// What is wrong with the masses or the constraints.
    pub(super) fn regular(&self, system: &S) -> Result<(), Cause> {
        regular_at(system, &self.state, (&self.saddle, &self.gradients))
    }

    /// Replaces the factors. They may or may not be those of the state itself.
    #[inline]
    fn take(&mut self, Self { saddle, gradients, metric, slopes, .. }: Self, is_fresh: bool) {
        (self.saddle, self.gradients, self.is_fresh) = (saddle, gradients, is_fresh);
        (self.metric, self.slopes) = (metric, slopes);
    }

    /// Newton's corrections of one level.
    ///
    /// # Errors
    /// The constraint that stays violated or contradicts others, [`Cause::Undetermined`],
    /// [`Cause::NotFinite`]; at a rough start also the defect of the factors.
    #[inline]
    pub(crate) fn level(&mut self, system: &S, level: Level, from: From) -> Result<(), Cause> {
        match from {
            From::Near => self.corrections::<false>(system, level),
            From::Far => self.corrections::<true>(system, level),
        }
    }

    /// The same; with `FAR` from anywhere. Two functions, so that a program without rough starts does not
    /// hold what they need.
    fn corrections<const FAR: bool>(&mut self, system: &S, level: Level) -> Result<(), Cause> {
        let begun = self.sizes(level);
        self.is_stuck = false;
        let mut has_moved = false;
        // One row depends on no other.
        if C > 1 && !FAR && !self.nearness().is_clear() {
            self.settle(system, level);
            if level == Level::Velocities && self.saddle.is_independent() && self.is_blurred(system) {
                return Ok(());
            }
        }
        for _ in 0..(if FAR { ROUGH } else { NEAR }) {
            if self.residuals.level_is_roundings(level) {
                return Ok(());
            }
            if FAR {
                self.refresh(system);
                let regular = self.regular(system);
                regular
                    .map_err(|cause| if has_moved { self.residuals.unmet(level, cause) } else { cause })?;
            }
            let lack = self.residuals.values(level).each(|value| -value);
            let none = [num_traits::Zero::zero(); N];
            let (change, _) = self.saddle.solve(&none, &lack);
            if !change.iter().all(|x| x.is_finite()) {
                return Err(Cause::NotFinite);
            }
            let (slopes, metric) = (self.slopes, self.metric);
            let before = self.residuals.distance(level, &slopes);
            let share = if FAR && level == Level::Positions {
                self.reach(&change, before)
            } else {
                num_traits::One::one()
            };
            let Some((next, there, share)) = self.corrected::<FAR>(system, level, &change, share) else {
                self.is_stuck = true;
                break;
            };
            let after = there.distance(level, &slopes);
            let steps = metric.sizes(&change).each(|step| (step * share).largest());
            let helped = after < before;
            if helped {
                (self.state, self.residuals, self.is_fresh) = (next, there, false);
                has_moved = true;
                let ulp = S::Scalar::epsilon().largest();
                let ulps = self.sizes_since(level, begun).each(|size| ulp * size.largest());
                let is_below = |which: usize| steps[which] * (after / before) <= ulps[which];
                // Beside the constraints the metric tells, and a firmware has no room for more.
                if is_below(0) && (!FAR || is_below(1)) && self.agrees(level, begun) {
                    return Ok(());
                }
            }
            if after > <S::Scalar as Real>::Lane::from_f64(CONTRACTION) * before {
                if !helped && self.is_fresh {
                    self.is_stuck = true;
                    break;
                }
                self.refresh(system);
            }
        }
        // A rough start whose corrections still help is not on the constraints, however near it is.
        if (self.is_stuck || !FAR) && self.is_rounding(level, begun) && self.agrees(level, begun) {
            return Ok(());
        }
        Err(self.failure(system, level).named(&S::NAMES))
    }

    /// Why constraints stay violated. Where no correction reduces the residual of dependent rows, there are
    /// two cases: if the rows depend on each other beside that state as well, they contradict each other;
    /// otherwise the configuration is singular.
    #[cold]
    #[inline(never)]
    fn failure(&mut self, system: &S, level: Level) -> Cause {
        self.refresh(system);
        let violated = self.residuals.cause(level, &self.slopes);
        let (Cause::PositionViolated { constraint, name, .. }
        | Cause::VelocityViolated { constraint, name, .. }) = violated
        else {
            return violated;
        };
        // One row contradicts no other.
        if C == 1 || self.saddle.is_independent() || self.corrects(level) {
            return violated;
        }
        let depend_beside = [false, true].into_iter().all(|alternate| {
            let State { t, q, v } = self.beside(alternate);
            !system.saddle_at(t, &q, &v).0.is_independent()
        });
        if depend_beside {
            Cause::Contradictory { constraint, name }
        } else {
            Cause::Undetermined { constraint: self.saddle.independence().weakest, name }
        }
    }

    /// Whether the next correction would reduce the residual, according to the gradients.
    fn corrects(&self, level: Level) -> bool {
        let lack = self.residuals.values(level).each(|value| -value);
        let (change, _) = self.saddle.solve(&[num_traits::Zero::zero(); N], &lack);
        let mut rest = self.residuals;
        let left = match level {
            Level::Positions => &mut rest.positions,
            Level::Velocities => &mut rest.rates,
        };
        for (left, rate) in left.iter_mut().zip(self.gradients.rates(&change)) {
            *left += rate;
        }
        let enough = <S::Scalar as Real>::Lane::from_f64(1.0 - CONTRACTION);
        rest.distance(level, &self.slopes) <= enough * self.residuals.distance(level, &self.slopes)
    }

    /// A state of which each coordinate has been moved by ∜ε of the largest.
    fn beside(&self, alternate: bool) -> State<S::Scalar, N> {
        let change = self.metric.ulps(self.extent(Level::Positions) * determined() / S::Scalar::epsilon());
        let mut beside = self.state;
        for (i, (number, change)) in beside.q.iter_mut().zip(change).enumerate() {
            *number += if alternate && i % 2 == 1 { -change } else { change };
        }
        beside
    }

    /// Whether dependent rows leave no more than a start may violate.
    fn agrees(&self, level: Level, begun: [S::Scalar; 2]) -> bool {
        let part = S::Scalar::from_f64(SHARE) * S::Scalar::epsilon().sqrt();
        self.saddle.is_independent() || self.is_within(level, begun, part)
    }

    /// Takes factors that belong to the constraints, where rows depend on each other on the constraints but
    /// not beside them. The factors of a state beside them would make such rows demand more than any motion
    /// can do.
    #[cold]
    fn settle(&mut self, system: &S, level: Level) {
        if level == Level::Velocities {
            return self.refresh(system);
        }
        if !self.is_fresh {
            return;
        }
        let none = [num_traits::Zero::zero(); N];
        let (change, _) = self.saddle.solve(&none, &self.residuals.positions.each(|value| -value));
        let near = moved(&self.state, &change, &none, num_traits::One::one());
        let (saddle, gradients) = system.saddle_at(near.t, &near.q, &near.v);
        if saddle.rank() < self.saddle.rank() && saddle.defect().is_none() {
            self.take(Self::with(&self.state, self.residuals, (saddle, gradients)), false);
        }
    }

    /// A corrected state, its residuals and the share of the correction that was taken. For a rough start the
    /// share is halved until the state is closer to the constraints; `None` if it never is.
    fn corrected<const FAR: bool>(
        &self,
        system: &S,
        level: Level,
        change: &[S::Scalar; N],
        mut share: S::Scalar,
    ) -> Option<Corrected<S::Scalar, N, C>> {
        let none = [num_traits::Zero::zero(); N];
        let (q, v) = if level == Level::Positions { (change, &none) } else { (&none, change) };
        for _ in 0..(if FAR { HALVINGS } else { 1 }) {
            let next = moved(&self.state, q, v, share);
            let there = system.residuals_at(next.t, &next.q, &next.v);
            let is_better =
                || there.distance(level, &self.slopes) < self.residuals.distance(level, &self.slopes);
            if next.is_finite() && (!FAR || is_better()) {
                return Some((next, there, share));
            }
            share *= S::Scalar::from_f64(0.5);
        }
        None
    }

    /// The part of a correction that is not too long for its distance from the constraints. One that changes
    /// the state by less than ∜ε leads nowhere else.
    fn reach(&self, change: &[S::Scalar; N], distance: <S::Scalar as Real>::Lane) -> S::Scalar {
        let far = S::Scalar::from_f64(REACH) * S::Scalar::splat(distance);
        let near = S::Scalar::splat(determined()) * self.extent(Level::Positions);
        let one: S::Scalar = num_traits::One::one();
        one.min(far.max(near) / self.metric.extent(change))
    }

    /// Whether the residual is the rounding error of inner operations or of the state.
    fn is_rounding(&self, level: Level, begun: [S::Scalar; 2]) -> bool {
        self.is_within(level, begun, S::Scalar::epsilon().sqrt())
    }

    /// Whether the residual is below a share of the summands and of the state.
    #[cold]
    #[inline(never)]
    fn is_within(&self, level: Level, begun: [S::Scalar; 2], part: S::Scalar) -> bool {
        let by_state = self.metric.changes(&self.gradients, self.sizes_since(level, begun));
        self.residuals.is_within_apart(level, part, &by_state)
    }

    /// How close the gradients are to depending on each other, as the factors know, or to vanishing: what the
    /// coordinates make of a constraint, as a part of its summands. Rows that vanish together stay far apart.
    pub(super) fn nearness(&self) -> Independence<S::Scalar> {
        let mut independence = self.saddle.independence();
        let extent = self.extent(Level::Positions);
        for (c, (&slope, &summands)) in self.slopes.iter().zip(&self.residuals.position_sizes).enumerate() {
            if summands.is_positive() {
                independence.take(c, slope * extent / summands);
            }
        }
        independence
    }

    /// The largest coordinate, or velocity, in the kinetic metric.
    pub(super) fn extent(&self, level: Level) -> S::Scalar {
        self.sizes(level)[0]
    }

    /// The largest coordinate, or velocity, in the kinetic metric and as a number.
    fn sizes(&self, level: Level) -> [S::Scalar; 2] {
        self.metric.sizes(if level == Level::Positions { &self.state.q } else { &self.state.v })
    }

    /// The same, now or earlier.
    fn sizes_since(&self, level: Level, earlier: [S::Scalar; 2]) -> [S::Scalar; 2] {
        let [metric, number] = self.sizes(level);
        [metric.max(earlier[0]), number.max(earlier[1])]
    }

    #[cold]
    #[inline(never)]
    pub(super) fn refresh(&mut self, system: &S) {
        if !self.is_fresh {
            self.take(Self::new(system, &self.state, self.residuals), true);
        }
    }
}
