//! Constrained systems as ordinary differential equations: [`Linearized`](crate::Linearized) with the
//! multipliers solved for.
//!
//! With a(t, q, v, u) from the saddle-point system, r = a(t, q, v, u) − a has the derivatives of the
//! accelerations, and a unit matrix in the place of M. Reached through generated code only.

use super::Tangent;
use super::response::{Factored, columns, factored};
use crate::constraints::{Surface, settled_state};
use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::linearized::Linearization;
use crate::system::state::State;

/// a(t, q, v, u) − a.
pub fn reduced_residual<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    a: &[S::Scalar; N],
    u: &[S::Scalar; K],
) -> [S::Scalar; N]
where
    S: Tangent<N, K, C>,
{
    let found = system.accelerations_at(constants, state.t, &state.q, &state.v, u);
    array(|i| found[i] - a[i])
}

/// 1, ∂a/∂q and ∂a/∂v; NaN without accelerations. They are taken at the state to which `accelerations_at`
/// moves a stage beside the constraints. At the stage itself the derivatives have poles.
pub fn reduced<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Linearization<S::Scalar, N>
where
    S: Tangent<N, K, C> + Surface<N, K, C>,
{
    let state = &settled_state(system, constants, state, u);
    let number = S::Scalar::from_f64;
    let mut mass = [[number(0.0); N]; N];
    for (i, row) in mass.iter_mut().enumerate() {
        row[i] = number(1.0);
    }
    let Ok(Factored { variation, saddle, .. }) = factored(system, constants, state, u) else {
        let nan = [[number(f64::NAN); N]; N];
        return Linearization { mass, by_q: nan, by_v: nan };
    };
    let (by_q, _) = columns(&saddle, &variation.by_q, &variation.conditions_by_q);
    let (by_v, _) = columns(&saddle, &variation.by_v, &variation.conditions_by_v);
    let rows = |matrix: &nalgebra::SMatrix<S::Scalar, N, N>| array(|i| array(|j| matrix[(i, j)]));
    Linearization { mass, by_q: rows(&by_q), by_v: rows(&by_v) }
}

/// ∂a/∂u; NaN without accelerations.
pub fn reduced_by_inputs<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> [[S::Scalar; K]; N]
where
    S: Tangent<N, K, C> + Surface<N, K, C>,
{
    let state = &settled_state(system, constants, state, u);
    let Ok(Factored { variation, saddle, .. }) = factored(system, constants, state, u) else {
        return [[S::Scalar::from_f64(f64::NAN); K]; N];
    };
    let (by_u, _) = columns(&saddle, &variation.by_u, &[[num_traits::Zero::zero(); K]; C]);
    array(|i| array(|j| by_u[(i, j)]))
}
