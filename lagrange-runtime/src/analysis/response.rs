//! How accelerations and multipliers respond to a change of the state.
//!
//! M δa − Aᵀδλ = ∂r/∂x δx and A δa = −∂(A a − γ)/∂x δx: one factorisation, and a solution for each x.

use nalgebra::{SMatrix, SVector};

use super::{Place, Tangent, Variation};
use crate::constraints::{Balance, is_singular};
use crate::linear::stored::Stored;
use crate::linear::{Saddle, SaddlePoint};
use crate::number::elements::{Each, array};
use crate::number::real::Real;
use crate::system::error::MotionError;
use crate::system::state::State;
use crate::system::{check_masses, diagnose};

/// Derivatives of accelerations a and multipliers λ; rows are accelerations or multipliers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response<R, const N: usize, const K: usize, const C: usize> {
    /// ∂a/∂q.
    pub by_q: SMatrix<R, N, N>,
    /// ∂a/∂v.
    pub by_v: SMatrix<R, N, N>,
    /// ∂a/∂t.
    pub by_t: SVector<R, N>,
    /// ∂a/∂u.
    pub by_u: SMatrix<R, N, K>,
    /// ∂λ/∂q.
    pub multipliers_by_q: SMatrix<R, C, N>,
    /// ∂λ/∂v.
    pub multipliers_by_v: SMatrix<R, C, N>,
    /// ∂λ/∂t.
    pub multipliers_by_t: SVector<R, C>,
    /// ∂λ/∂u.
    pub multipliers_by_u: SMatrix<R, C, K>,
}

/// A state with its accelerations and multipliers, the derivatives there, and the factors of M and A.
pub(super) struct Factored<R, const N: usize, const K: usize, const C: usize> {
    pub balance: Balance<R, N, C>,
    pub variation: Variation<R, N, K, C>,
    pub saddle: Stored<Saddle<R, N, C>>,
}

/// Evaluates and factors at a state. It is not inlined, so that the stack of the factorisation is free again
/// afterwards.
#[inline(never)]
pub(super) fn factored<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Result<Factored<S::Scalar, N, K, C>, MotionError<S::Scalar>>
where
    S: Tangent<N, K, C>,
{
    let State { t, q, v } = state;
    let failed = || MotionError { cause: diagnose(system, constants, *t, q, v), t: *t };
    check_masses(system, constants, state)?;
    let balance = system.balanced_at(constants, *t, q, v, u);
    if !balance.accelerations.iter().chain(&balance.multipliers).all(|x| x.is_finite()) {
        return Err(failed());
    }
    let place = Place { t: *t, q, v, a: &balance.accelerations, multipliers: &balance.multipliers, u };
    let variation = system.variation_at(constants, &place);
    let saddle = Stored::new(Saddle::factor_indefinite(&variation.mass, &variation.gradients));
    if is_singular(&*saddle) {
        return Err(failed());
    }
    Ok(Factored { balance, variation, saddle })
}

/// The derivatives of a and λ by some variables, given by the columns of ∂r/∂x and ∂(A a − γ)/∂x.
pub(super) fn columns<R: Real, const N: usize, const C: usize, const D: usize>(
    saddle: &Saddle<R, N, C>,
    forces: &[[R; D]; N],
    conditions: &[[R; D]; C],
) -> (SMatrix<R, N, D>, SMatrix<R, C, D>) {
    let columns: [([R; N], [R; C]); D] = array(|j| {
        let force = array(|i| forces[i][j]);
        saddle.solve(&force, &array(|c| -conditions[c][j]))
    });
    (SMatrix::from_fn(|i, j| columns[j].0[i]), SMatrix::from_fn(|c, j| columns[j].1[c]))
}

pub(super) fn response<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Result<Response<S::Scalar, N, K, C>, MotionError<S::Scalar>>
where
    S: Tangent<N, K, C>,
{
    let constants = system.constants();
    let Factored { variation, saddle, .. } = factored(system, &constants, state, u)?;
    let (by_q, multipliers_by_q) = columns(&saddle, &variation.by_q, &variation.conditions_by_q);
    let (by_v, multipliers_by_v) = columns(&saddle, &variation.by_v, &variation.conditions_by_v);
    let nothing = [[num_traits::Zero::zero(); K]; C];
    let (by_u, multipliers_by_u) = columns(&saddle, &variation.by_u, &nothing);
    let (forces, conditions) = (variation.by_t.each(|x| [x]), variation.conditions_by_t.each(|x| [x]));
    let (by_t, multipliers_by_t) = columns(&saddle, &forces, &conditions);
    let response = Response {
        by_q,
        by_v,
        by_t,
        by_u,
        multipliers_by_q,
        multipliers_by_v,
        multipliers_by_t,
        multipliers_by_u,
    };
    let accelerations = by_q.iter().chain(&by_v).chain(&by_t).chain(&by_u);
    let multipliers = multipliers_by_q.iter().chain(&multipliers_by_v).chain(&multipliers_by_t);
    if accelerations.chain(multipliers).chain(&multipliers_by_u).all(|x| x.is_finite()) {
        return Ok(response);
    }
    let State { t, q, v } = state;
    Err(MotionError { cause: diagnose(system, &constants, *t, q, v), t: *t })
}
