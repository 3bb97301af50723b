//! Corrections that rounding errors of the constraint functions alone demand.

use super::Retraction;
use crate::constraints::residuals::{Level, ULPS};
use crate::constraints::{Surface, moved};
use crate::linear::SaddlePoint;
use crate::number::elements::{Each, array};
use crate::number::real::Real;

impl<S, const N: usize, const K: usize, const C: usize> Retraction<S, N, K, C>
where
    S: Surface<N, K, C>,
{
    /// Whether the correction that is left for the velocities is within the effect of rounding errors of the
    /// constraint functions. Then the velocities that a step has brought are the better ones. This effect is
    /// large beside a configuration in which constraints depend on each other. A correction of more than half
    /// of the digits is never left out, since it leads to another velocity.
    #[cold]
    #[inline(never)]
    pub(super) fn is_blurred(&self, system: &S) -> bool {
        let lack = self.residuals.rates.each(|value| -value);
        let (change, _) = self.saddle.solve(&[num_traits::Zero::zero(); N], &lack);
        let roundings = S::Scalar::from_f64(ULPS) * self.metric.extent(&self.turned(system));
        let half = S::Scalar::epsilon().sqrt() * self.extent(Level::Velocities);
        let excess = self.metric.extent(&change) - roundings.min(half);
        excess.is_finite() && excess.largest() <= num_traits::Zero::zero()
    }

    /// The change of the velocities where the coordinates move by what a rounding of each constraint function
    /// makes of them. The signs of the rounding errors are those to which the multipliers respond, as in an
    /// estimate of a condition number (Higham, "Accuracy and Stability of Numerical Algorithms", ch. 15).
    #[cold]
    #[inline(never)]
    pub(in crate::constraints) fn turned(&self, system: &S) -> [S::Scalar; N] {
        let (saddle, here) = (&self.saddle, &self.residuals);
        let none = [num_traits::Zero::zero(); N];
        let (_, response) = saddle.solve(&none, &here.position_sizes);
        let ulp = S::Scalar::epsilon();
        let roundings = array(|c| ulp * here.position_sizes[c] * response[c].signum());
        let (change, _) = saddle.solve(&none, &roundings);
        let there = moved(&self.state, &change, &none, num_traits::One::one());
        let rates = system.residuals_at(there.t, &there.q, &there.v).rates;
        saddle.solve(&none, &array(|c| rates[c] - here.rates[c])).0
    }
}
