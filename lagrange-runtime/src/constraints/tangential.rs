//! The part of a change that the constraints leave open.

use num_traits::Zero;

use super::Surface;
use crate::linear::{Gradients, SaddlePoint};
use crate::number::elements::array;
use crate::system::state::State;

/// The part of a change of coordinates and velocities along the constraints: the change less the smallest
/// one, in the metric of the mass matrix, that has the same product with the gradients. Nonholonomic
/// constraints leave all changes of coordinates open: no projection takes these back.
#[cold]
pub fn tangential<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    change: &State<S::Scalar, N>,
) -> State<S::Scalar, N>
where
    S: Surface<N, K, C>,
{
    let (saddle, gradients) = system.saddle_at(state.t, &state.q, &state.v);
    let none = S::Scalar::zero();
    let mut held = gradients.rates(&change.q);
    for (rate, _) in held.iter_mut().zip(S::HOLONOMIC).filter(|(_, is_holonomic)| !is_holonomic) {
        *rate = none;
    }
    let [q, v] = [(&change.q, held), (&change.v, gradients.rates(&change.v))].map(|(change, rates)| {
        let (normal, _) = saddle.solve(&[none; N], &rates);
        array(|i| change[i] - normal[i])
    });
    State { q, v, ..*change }
}
