//! The check of every step of a constrained motion, and where a step may end.
//!
//! Two things tell whether a step went wrong, whatever the reason. The **correction** that brings its end back onto the
//! constraints is a part of its error. The **defect**, the difference between the accelerations of its polynomial and those of
//! the equations, is another part (Enright, "A new error-control for initial value solvers", Appl. Math. Comput. 31, 1989). Both
//! are held against the tolerance.
//!
//! A step does not end where the constraints do not determine the state well, beside a configuration in which they depend on
//! each other: there, roundings of the constraints are large changes of the state. What was determined in the motion so far
//! is the measure, so constraints that are redundant everywhere do no harm.

use super::step_size::{self, Limits};
use crate::constraints::{Footing, Uncertainty};
use crate::error::Cause;
use crate::linear::{Independence, determined};
use crate::real::{Ordered, Real, larger, smaller};
use crate::state::State;
use crate::system::System;

/// Lengths that are tried for a step, in parts of what error control allows: where the first fails a little shorter or longer
/// ones first, so that the cost is small. The error at the longest is that at the tolerance times 1.05 to the power of the
/// order, which [`Landing`] checks.
pub(crate) const LENGTHS: [f64; 8] = [0.9, 1.05, 0.8, 0.7, 0.6, 0.5, 0.35, 0.25];

/// Shorter steps are tried where none of these lengths will do.
pub(crate) const SHORTER: f64 = 0.25;

/// Corrections and defects are at most so many times the tolerance: the derivative of the last terms of a series is the order
/// times larger than they are, a fifth of the tolerance.
const MARGIN: f64 = 16.0;

/// Accelerations are known to so many ulps of the largest term, and no error is held against a tolerance below that.
const NOISE: f64 = 256.0;

/// What constraints have determined in a motion so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Determined<R> {
    rank: usize,
    least: R,
}

impl<R: Ordered> Determined<R> {
    /// What a start determines.
    pub(crate) fn at_start(here: &Independence<R>) -> Self {
        // Rows that are closer than that from the beginning may come a little closer.
        Self { rank: here.rank, least: smaller(determined(), R::from_f64(0.25) * here.least) }
    }

    /// Whether no less is determined.
    pub(crate) fn accepts(&self, here: &Independence<R>) -> bool {
        here.rank >= self.rank && here.least >= self.least
    }

    /// Takes in a state that was accepted.
    pub(crate) fn learn(&mut self, here: &Independence<R>) {
        if here.rank > self.rank {
            *self = Self::at_start(here);
        }
        if here.least > determined() {
            self.least = determined();
        }
    }
}

/// The end of a step, on the constraints.
pub(crate) struct Landing<R, const N: usize> {
    pub(crate) end: State<R, N>,
    pub(crate) footing: Footing<R, N>,
    /// Whether corrections and defect are within the tolerance, or roundings of the constraints.
    pub(crate) is_right: bool,
}

/// What a step is checked against.
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
    /// Brings the state that a step has `reached` onto the constraints and checks it. `slopes` are the accelerations of its
    /// polynomial there, if it has one.
    ///
    /// # Errors
    /// Why it cannot be brought back.
    pub(crate) fn land(
        &self,
        reached: &State<S::Scalar, N>,
        slopes: Option<&[S::Scalar; N]>,
    ) -> Result<Landing<S::Scalar, N>, Cause> {
        let mut end = *reached;
        let footing = self.system.land_at(self.constants, &mut end)?;
        let found = slopes.map(|_| self.accelerations(&end));
        let mut is_right = self.is_near(reached, &end, &footing, None);
        if let (Some(slopes), Some(found)) = (slopes, &found) {
            is_right &= self.defect_is_small(&end, slopes, found, &footing, None);
        }
        if !is_right {
            is_right = self.is_noise(reached, &end, slopes, found.as_ref(), &footing);
        }
        Ok(Landing { end, footing, is_right })
    }

    /// Whether the polynomial of a step obeys the equations at a state on the way to its landing.
    pub(crate) fn agrees(
        &self,
        state: &State<S::Scalar, N>,
        slopes: &[S::Scalar; N],
        landing: &Landing<S::Scalar, N>,
    ) -> bool {
        let found = self.accelerations(state);
        self.defect_is_small(&landing.end, slopes, &found, &landing.footing, None)
    }

    /// Whether two states differ by errors within the tolerance. Constraints couple the coordinates, so differences and sizes
    /// are those of whole states in the kinetic metric: a coordinate that is zero but for roundings has none of its own.
    pub(crate) fn is_near(
        &self,
        reached: &State<S::Scalar, N>,
        end: &State<S::Scalar, N>,
        footing: &Footing<S::Scalar, N>,
        noise: Option<&Uncertainty<S::Scalar, N>>,
    ) -> bool {
        let span = (end.t - self.from.t).abs();
        let extent = |x: &[S::Scalar; N]| footing.extent(x);
        let apart = |a: &[S::Scalar; N], b: &[S::Scalar; N]| extent(&core::array::from_fn(|i| a[i] - b[i]));
        let speed = larger(extent(&end.v), extent(&self.from.v));
        let size = larger(larger(extent(&end.q), extent(&self.from.q)), speed * span);
        let (q, v) = noise.map_or((S::Scalar::from_f64(0.0), S::Scalar::from_f64(0.0)), |noise| {
            (extent(&noise.q), extent(&noise.v))
        });
        apart(&reached.q, &end.q) <= self.bound(size, footing) + q
            && apart(&reached.v, &end.v) <= self.bound(speed, footing) + v
    }

    /// Whether the polynomial obeys the equations at its end, within the tolerance and the roundings of forces.
    fn defect_is_small(
        &self,
        end: &State<S::Scalar, N>,
        slopes: &[S::Scalar; N],
        found: &[S::Scalar; N],
        footing: &Footing<S::Scalar, N>,
        noise: Option<S::Scalar>,
    ) -> bool {
        let span = (end.t - self.from.t).abs();
        let extent = |x: &[S::Scalar; N]| footing.extent(x);
        let strongest = larger(extent(found), extent(slopes)) * span;
        let size = larger(larger(extent(&end.v), extent(&self.from.v)), strongest);
        let defect = extent(&core::array::from_fn(|i| found[i] - slopes[i])) * span;
        defect <= self.bound(size, footing) + noise.unwrap_or_else(num_traits::Zero::zero)
    }

    /// Whether what is beyond the tolerance are roundings of the constraints, and these leave half of all digits.
    #[cold]
    #[inline(never)]
    fn is_noise(
        &self,
        reached: &State<S::Scalar, N>,
        end: &State<S::Scalar, N>,
        slopes: Option<&[S::Scalar; N]>,
        found: Option<&[S::Scalar; N]>,
        footing: &Footing<S::Scalar, N>,
    ) -> bool {
        let span = (end.t - self.from.t).abs();
        let noise = self.system.uncertainty_at(end);
        let extent = |x: &[S::Scalar; N]| footing.extent(x);
        let half = S::Scalar::epsilon().sqrt();
        let speed = larger(extent(&end.v), extent(&self.from.v));
        if extent(&noise.q) > half * larger(extent(&end.q), speed * span)
            || extent(&noise.v) > half * speed
            || !self.is_near(reached, end, footing, Some(&noise))
        {
            return false;
        }
        let (Some(slopes), Some(found)) = (slopes, found) else { return true };
        let other = self.accelerations(&noise.other);
        // The curvature of the difference is not seen from one side.
        let difference =
            S::Scalar::from_f64(2.0) * extent(&core::array::from_fn(|i| other[i] - found[i])) * span;
        difference <= half * larger(speed, extent(found) * span)
            && self.defect_is_small(end, slopes, found, footing, Some(difference))
    }

    fn accelerations(&self, state: &State<S::Scalar, N>) -> [S::Scalar; N] {
        self.system.accelerations_at(self.constants, state.t, &state.q, &state.v, self.inputs)
    }

    /// What an error may be in a state of this size.
    fn bound(&self, size: S::Scalar, footing: &Footing<S::Scalar, N>) -> S::Scalar {
        let relative = larger(self.limits.relative, S::Scalar::from_f64(NOISE) * S::Scalar::epsilon());
        let absolute = self.limits.absolute.unwrap_or_else(num_traits::Zero::zero) + step_size::smallest();
        S::Scalar::from_f64(MARGIN) * (relative * size + footing.extent(&[absolute; N]))
    }
}
