//! The end of a step in lanes with constraints: on the constraints, and right by every criterion for a single
//! motion. A lane that fails one is left to a motion of its own.

use num_traits::Zero;

use super::super::landing::lost;
use super::super::lane::{get, set};
use super::{Relay, Standing};
use crate::integrator::landing::{MARGIN, NOISE};
use crate::integrator::step_size;
use crate::number::elements::{Each, array};
use crate::number::real::{Real, Vector};
use crate::system::footing::Apart;
use crate::system::smooth::Smooth;
use crate::system::state::{State, difference};

/// States and their residues of rounding.
type Reached<R, const N: usize> = (State<R, N>, State<R, N>);

/// The end of a step.
pub(super) struct Landed<R, const N: usize> {
    pub(super) at: Reached<R, N>,
    /// Measures that are at most zero in lanes in which the end is right.
    excess: [R; 7],
}

impl<R: Vector, const N: usize> Landed<R, N> {
    /// Whether a lane may go on from there.
    pub(super) fn is_right(&self, lane: usize) -> bool {
        // NaN is not right.
        self.excess.iter().all(|excess| excess.lane(lane) <= Zero::zero())
    }
}

impl<S: Smooth<N, K>, const N: usize, const K: usize> Relay<S, N, K>
where
    S::Scalar: Vector,
{
    /// Looks at the constraints of lanes that have begun. False where lanes would have to decide together.
    pub(super) fn begins(&mut self) -> bool {
        if S::CONSTRAINED && self.fresh.iter().take(S::Scalar::COUNT).any(|&fresh| fresh) {
            let constants = self.system.constants();
            let none = [Zero::zero(); K];
            let Some(here) = self.system.land_apart_at(&constants, &mut self.state.clone(), &none) else {
                return false;
            };
            for (lane, fresh) in self.fresh.iter_mut().enumerate().take(S::Scalar::COUNT) {
                let is_apart = here.close.lane(lane) <= Zero::zero();
                if let (true, false, Some(standing)) = (*fresh, is_apart, self.standing.get_mut(lane)) {
                    *standing = Standing::Stopped;
                }
                *fresh = false;
            }
        }
        true
    }

    /// The end of a step of `theta` units on the constraints. `None` where lanes would have to decide
    /// together.
    pub(super) fn landed(&self, at: Reached<S::Scalar, N>, theta: S::Scalar) -> Option<Landed<S::Scalar, N>> {
        let below = -<S::Scalar as num_traits::One>::one();
        if !S::CONSTRAINED {
            return Some(Landed { at, excess: [below; 7] });
        }
        let constants = self.system.constants();
        let (reached, mut residue) = at;
        let mut end = reached;
        let Apart { accelerations, metric, left, close } =
            self.system.land_apart_at(&constants, &mut end, &[Zero::zero(); K])?;
        for i in 0..N {
            // A residue belongs to the number that was rounded.
            let changed = |a: S::Scalar, b: S::Scalar| (a - b).abs();
            residue.q[i] = S::Scalar::zero().where_positive(changed(end.q[i], reached.q[i]), residue.q[i]);
            residue.v[i] = S::Scalar::zero().where_positive(changed(end.v[i], reached.v[i]), residue.v[i]);
        }
        let from = &self.state;
        let span = (end.t - from.t).abs();
        let speed = metric.extent(&end.v).max(metric.extent(&from.v));
        let size = metric.extent(&end.q).max(metric.extent(&from.q)).max(speed * span);
        let relative =
            S::Scalar::splat(self.limits.relative).max(S::Scalar::from_f64(NOISE) * S::Scalar::epsilon());
        let absolute = self.limits.absolute.unwrap_or_else(Zero::zero) + step_size::smallest();
        let absolute = metric.extent(&[S::Scalar::splat(absolute); N]);
        let bound = |size: S::Scalar| S::Scalar::from_f64(MARGIN) * (relative * size + absolute);
        let slopes = self.series.slopes(theta, self.orders).each(|slope| slope / self.unit);
        let strongest: [S::Scalar; N] = array(|i| slopes[i].abs().max(accelerations[i].abs()));
        let defect = metric.extent(&difference(&accelerations, &slopes)) * span;
        let excess = [
            left,
            close,
            metric.extent(&difference(&end.q, &reached.q)) - bound(size),
            metric.extent(&difference(&end.v, &reached.v)) - bound(speed),
            defect - bound(speed.max(metric.extent(&strongest) * span)),
            lost(&self.system, &constants, [from, &end], &metric, self.limits.relative),
            // 0 · ∞ and 0 · NaN are NaN, which the largest of some numbers might not be.
            accelerations.iter().chain(&slopes).map(|&x| x * S::Scalar::zero()).sum(),
        ];
        Some(Landed { at: (end, residue), excess })
    }

    /// States of some lanes at times within their last steps, by their series. In other lanes the numbers
    /// mean nothing. A lane whose constraints need another look stops. `alone` as in
    /// [`stop_unsolvable`](Self::stop_unsolvable).
    pub fn within(
        &mut self,
        times: S::Scalar,
        lanes: &[usize],
        alone: impl Fn(usize) -> S,
    ) -> State<S::Scalar, N> {
        let (state, residue, unit) = &self.before;
        let theta = ((times - state.t) - residue.t) / *unit;
        let (gain_q, gain_v) = self.series.gain(theta, self.orders);
        let reached = State {
            t: times,
            q: array(|i| state.q[i] + (residue.q[i] + gain_q[i])),
            v: array(|i| state.v[i] + (residue.v[i] + gain_v[i])),
        };
        if !S::CONSTRAINED {
            return reached;
        }
        let mut states = reached;
        let none = [Zero::zero(); K];
        let together = self.system.land_apart_at(&self.system.constants(), &mut states, &none);
        for &lane in lanes {
            let found = together.or_else(|| {
                let system = alone(lane);
                let mut beside = reached;
                (0..S::Scalar::COUNT).for_each(|other| set(&mut beside, other, &get(&reached, lane)));
                let found = system.land_apart_at(&system.constants(), &mut beside, &none);
                set(&mut states, lane, &get(&beside, lane));
                found
            });
            let is_right = found.is_some_and(|found| {
                [found.left, found.close].iter().all(|excess| excess.lane(lane) <= Zero::zero())
            });
            if let (false, Some(standing)) = (is_right, self.standing.get_mut(lane)) {
                *standing = Standing::Stopped;
            }
        }
        states
    }
}
