//! One step of order 8 by stages, without an estimate of its error: what takes the place of a series that
//! does not converge.
//!
//! The method is that of [`Dop853`](super::Dop853). A table and a loop, for it is small and rarely run.

use super::slopes::Slope;
use super::tableau::dop853::{A, B, C, STAGES};
use crate::number::real::Real;
use crate::system::System;
use crate::system::state::State;

/// The state after a step of `h` \[s] under held inputs.
#[cold]
#[inline(never)]
pub(super) fn step<S: System<N, K>, const N: usize, const K: usize>(
    system: &S,
    constants: &S::Constants,
    from: &State<S::Scalar, N>,
    h: S::Scalar,
    u: &[S::Scalar; K],
) -> State<S::Scalar, N> {
    let zero = [num_traits::Zero::zero(); N];
    let mut slopes = [Slope { q: zero, v: zero }; STAGES];
    let reached = |weights: &[f64], slopes: &[Slope<S::Scalar, N>], node: f64| {
        let mut state = from.at_time(from.t + S::Scalar::from_f64(node) * h);
        for (&weight, slope) in weights.iter().zip(slopes) {
            let part = S::Scalar::from_f64(weight) * h;
            for i in 0..N {
                state.q[i] += part * slope.q[i];
                state.v[i] += part * slope.v[i];
            }
        }
        state
    };
    for (stage, (weights, node)) in A.iter().zip(C).take(STAGES).enumerate() {
        let State { t, q, v } = reached(weights, &slopes, node);
        if let Some(slope) = slopes.get_mut(stage) {
            *slope = Slope { q: v, v: system.accelerations_at(constants, t, &q, &v, u) };
        }
    }
    reached(&B, &slopes, 1.0)
}
