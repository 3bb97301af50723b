//! The sizes of numbers in the course of a motion.

use super::Laws;
use crate::number::real::Real;

/// Values below this many rounding errors of their scale count as zero: gaps where contacts touch, slip
/// velocities of friction at rest, reactions and accelerations where one regime ends and another begins.
const ROUNDINGS: f64 = 256.0;

/// The part of a size that counts as zero.
pub(super) fn rounding<R: Real>() -> R {
    R::from_f64(ROUNDINGS) * R::epsilon()
}

/// Whether a > b.
pub(super) fn above<R: Real>(a: R, b: R) -> bool {
    (a - b).is_positive()
}

/// The larger of two.
pub(super) fn most<R: Real>(a: R, b: R) -> R {
    if above(a, b) { a } else { b }
}

/// The scales that a motion has shown so far, since a number that is zero has no scale of its own.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales<R, const C: usize> {
    /// The largest Σ |summands| of gaps.
    pub(super) gaps: [R; C],
    /// The largest Σ |summands| of rates and slip velocities.
    pub(super) speeds: [R; C],
    /// The largest speeds at which contacts have closed in impacts.
    pub(super) impacts: [R; C],
    /// The largest reactions where regimes began.
    pub(super) reactions: [R; C],
    /// The largest coefficients of friction, where they change.
    pub(super) coefficients: [R; C],
    /// The largest |t| \[s].
    pub(super) times: R,
    /// The tolerance of the motion.
    pub(super) relative: R,
}

impl<R: Real, const C: usize> Scales<R, C> {
    pub(super) fn new() -> Self {
        let none = [R::zero(); C];
        Self {
            gaps: none,
            speeds: none,
            impacts: none,
            reactions: none,
            coefficients: none,
            times: R::zero(),
            relative: R::zero(),
        }
    }

    /// The part of a speed below which a slip in two directions has no known direction: errors of its
    /// velocities have any direction.
    pub(super) fn lost(&self) -> R {
        most(self.relative, rounding())
    }

    /// Takes in an impact of the contacts that meet.
    pub(super) fn strike<const W: usize>(&mut self, meets: &[bool; C], laws: &Laws<R, C, W>) {
        let rows = self.impacts.iter_mut().zip(meets).zip(&laws.rows.rates);
        for ((seen, _), &rate) in rows.filter(|((_, meets), _)| **meets) {
            *seen = most(*seen, rate.abs());
        }
    }

    /// Takes in another state, by its time and its laws.
    pub(super) fn see<const W: usize>(&mut self, t: R, laws: &Laws<R, C, W>) {
        self.times = most(self.times, t.part(0).abs());
        let sizes = [(&mut self.gaps, &laws.rows.position_sizes), (&mut self.speeds, &laws.rows.rate_sizes)];
        for (seen, now) in sizes {
            // Beside a kink, the function of the other side may have no gradient.
            for (seen, &now) in seen.iter_mut().zip(now).filter(|(_, now)| now.is_finite()) {
                *seen = most(*seen, now);
            }
        }
    }
}
