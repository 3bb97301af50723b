//! Forces that a given motion needs.

use super::{Imbalance, Place, Tangent};
use crate::constraints::is_singular;
use crate::linear::{Saddle, SaddlePoint};
use crate::number::elements::Each;
use crate::number::real::Real;
use crate::system::diagnose;
use crate::system::error::MotionError;
use crate::system::state::State;

/// Generalized forces that a motion needs beyond those of the description.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InverseDynamics<R, const N: usize, const C: usize> {
    /// M a − f = M a + b − (Q − ∂D/∂v), with the inputs in Q at zero.
    pub total: [R; N],
    /// The remainder once the constraints bear as much as they can: the part in M times the velocities that
    /// the constraints allow. The same as `total` without constraints.
    pub required: [R; N],
    /// The multipliers under `required`: `total` = `required` + Aᵀλ.
    pub multipliers: [R; C],
}

pub(super) fn inverse_dynamics<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    a: &[S::Scalar; N],
) -> Result<InverseDynamics<S::Scalar, N, C>, MotionError<S::Scalar>>
where
    S: Tangent<N, K, C>,
{
    let zero = num_traits::Zero::zero();
    let constants = system.constants();
    let State { t, q, v } = state;
    let (multipliers, u) = ([zero; C], [zero; K]);
    let place = Place { t: *t, q, v, a, multipliers: &multipliers, u: &u };
    let Imbalance { forces, .. } = system.imbalance_at(&constants, &place);
    let total = forces.each(|r| -r);
    let failed = || MotionError { cause: diagnose(system, &constants, *t, q, v), t: *t };
    if !total.iter().all(|x| x.is_finite()) {
        return Err(failed());
    }
    if C == 0 {
        return Ok(InverseDynamics { total, required: total, multipliers });
    }
    let variation = system.variation_at(&constants, &place);
    let saddle = Saddle::factor_indefinite(&variation.mass, &variation.gradients);
    if is_singular(&saddle) {
        return Err(failed());
    }
    // M w = total + Aᵀκ with A w = 0.
    let (_, kappa) = saddle.solve(&total, &[zero; C]);
    let mut required = total;
    for (gradient, &kappa) in variation.gradients.iter().zip(&kappa) {
        for (force, &entry) in required.iter_mut().zip(gradient) {
            *force += entry * kappa;
        }
    }
    Ok(InverseDynamics { total, required, multipliers: kappa.each(|kappa| -kappa) })
}
