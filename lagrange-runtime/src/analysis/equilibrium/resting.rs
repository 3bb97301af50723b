//! Whether constraints let a system rest, and small deviations keep to one space.

use num_traits::Zero;

use super::EquilibriumError;
use super::newton::Search;
use super::statics::{Rest, Statics, size_of};
use crate::analysis::Tangent;
use crate::analysis::turning::{Frame, turning, worst};
use crate::constraints::{Level, Metric};
use crate::linear::stored::Stored;
use crate::linear::{Saddle, SaddlePoint};
use crate::number::elements::Each;
use crate::number::real::{Ordered, Real};
use crate::system::error::Cause;
use crate::system::name::Name;

impl<S, const N: usize, const K: usize, const C: usize> Statics<'_, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    /// Refuses constraints that do not let the system rest: by their velocities, or by their accelerations,
    /// as that of a table at the turning point of its motion.
    #[inline(never)]
    pub fn resting(
        &self,
        rest: &Rest<S::Scalar, N, C>,
        search: &Search<S::Scalar, N>,
    ) -> Result<(), EquilibriumError> {
        if C == 0 {
            return Ok(());
        }
        let (still, none) = ([S::Scalar::zero(); N], [S::Scalar::zero(); C]);
        let share = S::Scalar::epsilon().sqrt();
        let residuals = self.system.deviations_at(self.t, &rest.q, &still);
        let saddle = Stored::new(Saddle::factor(&self.metric, &rest.gradients));
        let slopes = Metric::of(&*saddle).slopes(&*rest.gradients);
        // A position is known to half of the digits of the search's reach, and with it how a constraint moves
        // there.
        let variation = self.variation(&rest.q, &none);
        let reach = self.reach(rest, search);
        let units = self.sizes.each(|size| if size.is_positive() { reach / size.sqrt() } else { reach });
        if !residuals.is_within(
            Level::Velocities,
            share,
            &variation.rates_by_q.each_ref().each(|row| size_of(row, &units)),
        ) {
            return Err(match residuals.cause(Level::Velocities, &slopes) {
                Cause::VelocityViolated { constraint, name, .. } => {
                    EquilibriumError::MovingConstraint { constraint, name }
                }
                cause => EquilibriumError::Constraints(cause),
            });
        }
        let place = self.place(&rest.q, &still, &none);
        let mut accelerations = self.system.imbalance_at(&self.constants, &place).conditions;
        for (acceleration, row) in accelerations.iter_mut().zip(variation.conditions_by_q.iter()) {
            if acceleration.abs() <= share * size_of(row, &units) {
                *acceleration = S::Scalar::zero();
            }
        }
        // The forces of these accelerations, beside those that are balanced.
        let needed = self.heaviest * self.length(&saddle.solve(&still, &accelerations).0);
        let balanced = self.force(&self.imbalance(&rest.q, &none)) + search.met;
        match worst(&accelerations, &slopes) {
            Some(constraint) if needed > share * balanced => {
                Err(EquilibriumError::MovingConstraint { constraint, name: Name::NONE })
            }
            _ => Ok(()),
        }
    }

    /// A constraint whose gradient turns, so that the linear equations have no constant coefficients.
    pub fn turning(&self, rest: &Rest<S::Scalar, N, C>) -> Option<usize> {
        if !S::TURNS.contains(&true) {
            return None;
        }
        let saddle = Stored::new(Saddle::factor(&self.metric, &rest.gradients));
        let (motions, places) = (&rest.motions, self.allowed(rest));
        let share = S::Scalar::from_f64(16.0 * N as f64) * S::Scalar::epsilon();
        let frame = Frame {
            saddle: &saddle,
            sizes: &self.sizes,
            displacements: places.vectors.get(..places.count)?,
            velocities: motions.vectors.get(..motions.count)?,
            least: share * rest.stiffness.size * (rest.unit / self.heaviest),
        };
        turning(self.system, &self.constants, (self.t, &rest.q, self.u), &frame)
    }
}
