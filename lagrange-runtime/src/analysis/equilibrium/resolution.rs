//! Whether coordinates have enough digits to tell an equilibrium.
//!
//! Remaining forces count as rounding errors if a change of the coordinates by their last digits makes forces
//! of that size. That holds as long as forces are linear over such a change. An angle of 10¹⁷ has no digits
//! after the point: a whole turn, and so any force, lies between two numbers, and every guess would pass for
//! an equilibrium.

use num_traits::Zero;

use super::EquilibriumError;
use super::newton::Search;
use super::statics::{Rest, Statics, dot, size_of};
use crate::analysis::Tangent;
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real, larger};
use crate::system::name::Name;

/// The points at which a change is tried, in units of it. By accident forces may look linear at one of these,
/// but not at all four.
const PLACES: [f64; 4] = [1.0, -1.0, 2.0, -2.0];

/// The longest part of Newton's step that forces are to follow. Rounding errors may follow longer ones by
/// accident.
const LONGEST: f64 = 1.0 / 16.0;

/// The parts that are tried, each a quarter of the one before.
const PARTS: usize = 32;

impl<S, const N: usize, const K: usize, const C: usize> Statics<'_, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    /// Refuses a position with a coordinate over whose last digits forces are not linear.
    ///
    /// If the last digits of a coordinate explain less than half of the digits of the remaining forces, these
    /// come from elsewhere: from rounding errors of the forces themselves, or from a position beside a flat
    /// minimum. Otherwise a change is tried at each scale from the last digit of the coordinate to the
    /// coordinate itself, because rounding errors may hide a small one. Smooth forces are linear at one of
    /// these scales.
    pub fn resolved(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        search: &Search<S::Scalar, N>,
    ) -> Result<(), EquilibriumError> {
        let least = S::Scalar::epsilon().sqrt() * search.met;
        let by_q = self.variation(&rest.q, &rest.multipliers).by_q;
        for coordinate in 0..N {
            let slopes = by_q.each_ref().each(|row| row[coordinate]);
            let motions = rest.motions.vectors.iter().take(rest.motions.count);
            let stiffest =
                motions.fold(S::Scalar::zero(), |most, vector| larger(size_of(vector, &slopes), most));
            let far = rest.q[coordinate].abs();
            let mut change = S::Scalar::epsilon() * far;
            let mut is_linear = stiffest * change <= S::Scalar::epsilon().sqrt() * rest.norm;
            while !is_linear && change < far {
                is_linear = self.are_linear(rest, &slopes, [stiffest, least], coordinate, change);
                change *= S::Scalar::from_f64(4.0);
            }
            if !is_linear {
                return Err(EquilibriumError::Unresolved { coordinate, name: Name::NONE });
            }
        }
        Ok(())
    }

    /// Whether forces along the motions are linear in a change of one coordinate, as far as half of the
    /// change tells. Forces below half of the digits of the largest ones count as zero, as they do where a
    /// search ends.
    fn are_linear(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        slopes: &[S::Scalar; N],
        [stiffest, least]: [S::Scalar; 2],
        coordinate: usize,
        change: S::Scalar,
    ) -> bool {
        PLACES.into_iter().all(|place| {
            let mut q = rest.q;
            q[coordinate] += S::Scalar::from_f64(place) * change;
            let way = q[coordinate] - rest.q[coordinate];
            let there = self.imbalance(&q, &rest.multipliers);
            let bends = array(|i| there[i] - rest.left[i] - slopes[i] * way);
            let most = S::Scalar::from_f64(0.5) * stiffest * way.abs();
            let mut motions = rest.motions.vectors.iter().take(rest.motions.count);
            motions.all(|vector| dot(vector, &bends).abs() <= most || dot(vector, &there).abs() <= least)
        })
    }

    /// Whether the forces that Newton's step would remove are rounding errors: they do not follow any part of
    /// that step, however short, and the stiffness at its end is that at its beginning. Beside a point of
    /// inflection the step is so long that all parts of it lie where rounding hides them or where other
    /// forces act.
    ///
    /// A position near zero has no size that would tell this. Springs that pull to all sides leave the
    /// rounding errors of what each of them pulls, and these do not change with the last digits of a
    /// coordinate.
    pub fn are_errors(&self, rest: &Rest<S::Scalar, N, C>, step: &[S::Scalar; N]) -> bool {
        let by_q = self.variation(&rest.q, &rest.multipliers).by_q;
        let slopes = by_q.each_ref().each(|row| dot(row, step));
        let most = |forces: &[S::Scalar; N]| {
            let vectors = rest.motions.vectors.iter().take(rest.motions.count);
            vectors.fold(S::Scalar::zero(), |most, vector| larger(dot(vector, forces).abs(), most))
        };
        let (stiffest, mut part) = (most(&slopes), S::Scalar::from_f64(LONGEST));
        let there = self.variation(&array(|i| rest.q[i] + step[i]), &rest.multipliers).by_q;
        let changed = array(|i| dot(&there[i], step) - slopes[i]);
        let is_kept = most(&changed) <= S::Scalar::from_f64(0.5) * stiffest;
        if !is_kept {
            return false;
        }
        for _ in 0..PARTS {
            let is_linear = PLACES.into_iter().all(|place| {
                let way = S::Scalar::from_f64(place) * part;
                let q = array(|i| S::Scalar::mul_add(way, step[i], rest.q[i]));
                let there = self.imbalance(&q, &rest.multipliers);
                let bends = most(&array(|i| there[i] - rest.left[i] - slopes[i] * way));
                bends <= (S::Scalar::from_f64(0.5) * stiffest * way).abs()
            });
            if is_linear {
                return false;
            }
            part *= S::Scalar::from_f64(0.25);
        }
        true
    }
}
