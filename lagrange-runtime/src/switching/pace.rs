//! The limits of a step: its length, and the tolerance of a slow slip.

use super::run::Run;
use super::scene::{above, entry, most};
use super::sided::laws_on;
use super::turning::has_pairs;
use super::{Row, Switching};
use crate::number::real::{Ordered, Real, smaller};
use crate::system::control::Held;
use crate::system::limits::Limits;
use crate::system::method::Adaptive;

/// The longest step, as a multiple of the time that is asked for. Calls for short times share long steps.
const AHEAD: f64 = 1024.0;

/// The least tolerance, in ulps: that of the tightest motion.
const LEAST: f64 = 16.0;

impl<S, M, const N: usize, const K: usize, const C: usize, const W: usize> Run<'_, S, M, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    /// The limits of a step towards time `t`.
    pub(super) fn limits_towards(&self, t: S::Scalar) -> Limits<S::Scalar> {
        let mut limits = *self.limits;
        if const { C > 0 } {
            // A motion with constant accelerations has a series for all times, of which the end leaves the
            // beginning no digits: a slip that is about to end would not be seen to end.
            let asked = (t - self.memory.end.t).abs();
            limits.step = Some(limits.clip(S::Scalar::from_f64(AHEAD) * asked));
        }
        // The rounding errors of derivatives are beyond such a tolerance.
        if const { has_pairs(&S::ROWS) && S::Scalar::PARTS == 1 } {
            let least = S::Scalar::from_f64(LEAST) * S::Scalar::epsilon();
            let tight = limits.relative * self.slowness();
            limits.relative = smaller(limits.relative, most(tight, least));
        }
        limits
    }

    /// The least speed of a slip in two directions, as a part of the speeds that it is made of; one if none
    /// slips. Friction has the direction of the slip, so an error of velocities counts beside the slip.
    fn slowness(&self) -> S::Scalar {
        let mut least = num_traits::One::one();
        let slips = &self.memory.regime.slip;
        if slips.iter().all(|slip| *slip == num_traits::Zero::zero()) {
            return least;
        }
        let rows = laws_on(self.system, &self.memory.end, &self.control.0, &self.memory.regime.kinks).rows;
        for (row, kind) in S::ROWS.iter().enumerate() {
            if let Row::Friction { pair: Some(other), .. } = *kind
                && entry(slips, row) != num_traits::Zero::zero()
            {
                let speed = entry(&rows.rates, row).hypot(entry(&rows.rates, other)).part(0);
                let sizes = &self.memory.scales.speeds;
                let whole = most(entry(sizes, row), entry(sizes, other)).part(0);
                if above(whole * least, speed) {
                    least = speed / whole;
                }
            }
        }
        least
    }
}
