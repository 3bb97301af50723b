//! How well the numbers of a state determine its stiffness, on hosts with a standard library.
//!
//! Far from the origin the last digits of coordinates are large beside a distance between bodies. Forces that
//! balance there are as large as what these digits change, and so is the stiffness along a symmetry, which
//! would be zero. Neighbouring states show how large that is.

use nalgebra::DMatrix;

use super::linear_model::linearize;
use super::modes::double;
use super::{LinearModel, Tangent};
use crate::integrator::beside::{beside, ulps};
use crate::linear::stored::Stored;
use crate::number::real::{Ordered, Real, larger};
use crate::system::state::State;

/// The largest changes of each entry of the stiffness by an ulp of the numbers of a state. What its
/// neighbours do not have counts as none.
pub(super) fn blur<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
    model: &LinearModel<S::Scalar, N, K>,
) -> DMatrix<f64>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    let mut most = Stored::<[[S::Scalar; N]; N]>::zeros();
    for there in beside(state, &ulps(state)) {
        let Ok(there) = linearize(system, &there, u, false) else { continue };
        for (i, row) in most.iter_mut().enumerate() {
            for (j, most) in row.iter_mut().enumerate() {
                *most = larger((there.stiffness[(i, j)] - model.stiffness[(i, j)]).abs(), *most);
            }
        }
    }
    DMatrix::from_fn(N, N, |i, j| double(most[i][j]))
}
