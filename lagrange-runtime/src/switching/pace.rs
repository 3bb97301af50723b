//! The limits of a step: its length, and the tolerance of a slow slip.

use super::run::Run;
use super::scene::{above, entry, most};
use super::sided::laws_on;
use super::turning::has_pairs;
use super::{Row, Switching, Wanted};
use crate::number::real::{Ordered, Real, smaller};
use crate::system::System;
use crate::system::control::Held;
use crate::system::limits::Limits;
use crate::system::method::Adaptive;
use crate::system::state::State;

/// The longest step, as a multiple of the time that is asked for. Calls for short times share long steps.
const AHEAD: f64 = 1024.0;

/// The least tolerance, in ulps: that of the tightest motion.
const LEAST: f64 = 16.0;

/// The number of times at which kinks are looked for ahead of a motion at rest.
const LOOKS: usize = 64;

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

    /// The time, up to `t`, until which a motion that is at rest stays in its regime, as far as kinks that
    /// lie in time tell. The forces that a series at rest looks ahead to, for their rounding errors, are
    /// those of its own regime: a pulse exp((t − c)/w) up to t = c has any size beyond it.
    pub(super) fn alike_until(&self, t: S::Scalar) -> S::Scalar {
        let zero: S::Scalar = num_traits::Zero::zero();
        let State { t: now, q, v } = self.memory.end;
        if const { W == 0 } || !S::InRegime::STEEP || v.iter().any(|&v| v != zero) {
            return t;
        }
        let (memory, inputs) = (&*self.memory, &self.control.0);
        let wanted = Wanted { rows: [false; C], fixed: [false; C], kinks: [true; W] };
        let has_passed = |part: S::Scalar| {
            let there = now + part * (t - now);
            let kinks = S::functions_in(&memory.in_regime, |x| x, there, &q, &v, inputs, &wanted).kinks;
            kinks.iter().zip(&memory.regime.kinks).any(|(&kink, &side)| (-side * kink).is_positive())
        };
        let place = |index: usize| S::Scalar::from_f64(index as f64 / LOOKS as f64);
        // At the start itself a kink that has just been crossed is zero.
        let Some(first) = (1..=LOOKS).find(|&index| has_passed(place(index))) else { return t };
        let (mut before, mut behind) = (place(first - 1), place(first));
        // Behind the kink by so much that the step shows it.
        let near = S::Scalar::epsilon().sqrt();
        while behind - before > near {
            let middle = S::Scalar::from_f64(0.5) * (before + behind);
            *(if has_passed(middle) { &mut behind } else { &mut before }) = middle;
        }
        now + behind * (t - now)
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
