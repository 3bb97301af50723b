//! The part of a change that the constraints leave open.

use super::Surface;
use crate::linear::{Gradients, SaddlePoint};
use crate::number::elements::array;
use crate::system::state::State;

/// The part of a change of coordinates or velocities along the constraints: the change less the smallest one,
/// in the metric of the mass matrix, that has the same product with the gradients.
#[cold]
pub fn tangential<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    change: &[S::Scalar; N],
) -> [S::Scalar; N]
where
    S: Surface<N, K, C>,
{
    let (saddle, gradients) = system.saddle_at(state.t, &state.q, &state.v);
    let (normal, _) = saddle.solve(&[num_traits::Zero::zero(); N], &gradients.rates(change));
    array(|i| change[i] - normal[i])
}
