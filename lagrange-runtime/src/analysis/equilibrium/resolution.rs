//! Whether coordinates have digits enough to tell a place of rest.
//!
//! Forces that are left at a place count as roundings where a change of the coordinates by their last digits
//! makes forces of that size. That holds as long as forces are linear over such a change. An angle of 10¹⁷ has
//! no digits after the point: each turn of it, and so any force, lies between two numbers, and every guess would
//! pass for an equilibrium.

use super::EquilibriumError;
use super::statics::{Rest, Statics, dot, size_of};
use crate::analysis::Tangent;
use crate::number::real::{Ordered, Real, larger};
use crate::system::name::Name;

/// Places that a change is tried at, in units of it. By accident forces are linear at one of them, not at all.
const PLACES: [f64; 4] = [1.0, -1.0, 2.0, -2.0];

impl<S, const N: usize, const K: usize, const C: usize> Statics<'_, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    /// Refuses a place with a coordinate over whose last digits forces are not linear.
    ///
    /// Roundings of the forces themselves are no such change. They are larger than what the last digits make
    /// of a force where a coordinate is close to zero, so a change is tried at each scale from the last digit of
    /// the coordinate to the coordinate itself. Where forces are smooth they are linear at one of them.
    pub fn resolved(&self, rest: &Rest<S::Scalar, N, C>) -> Result<(), EquilibriumError> {
        let two = S::Scalar::from_f64(2.0);
        let by_q = self.variation(&rest.q, &rest.multipliers).by_q;
        for coordinate in 0..N {
            let far = rest.q[coordinate].abs();
            let mut change = S::Scalar::epsilon() * far;
            let mut is_linear = change == S::Scalar::from_f64(0.0);
            while !is_linear && change < far {
                is_linear = self.are_linear(rest, &by_q, coordinate, change);
                change = change * two * two;
            }
            if !is_linear {
                return Err(EquilibriumError::Unresolved { coordinate, name: Name::NONE });
            }
        }
        Ok(())
    }

    /// Whether forces along the motions are linear, as far as half of a change tells, where one coordinate
    /// changes.
    fn are_linear(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        by_q: &[[S::Scalar; N]; N],
        coordinate: usize,
        change: S::Scalar,
    ) -> bool {
        let half = S::Scalar::from_f64(0.5);
        let motions = || rest.motions.vectors.iter().take(rest.motions.count);
        let slopes = by_q.each_ref().map(|row| row[coordinate]);
        let stiffest =
            motions().fold(S::Scalar::from_f64(0.0), |most, vector| larger(size_of(vector, &slopes), most));
        // Of forces that do not depend on the coordinate there is nothing to tell.
        stiffest == S::Scalar::from_f64(0.0)
            || PLACES.into_iter().all(|place| {
                let mut q = rest.q;
                q[coordinate] += S::Scalar::from_f64(place) * change;
                let way = q[coordinate] - rest.q[coordinate];
                let there = self.imbalance(&q, &rest.multipliers);
                let bends = core::array::from_fn(|i| there[i] - rest.left[i] - slopes[i] * way);
                motions().all(|vector| dot(vector, &bends).abs() <= half * stiffest * way.abs())
            })
    }
}
