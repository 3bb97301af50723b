//! Corners of what a kink stands in.

use super::Switching;
use super::run::Run;
use super::scene::above;
use crate::number::real::{Ordered, Real};
use crate::system::control::Held;
use crate::system::method::Adaptive;
use crate::system::state::State;

impl<S, M, const N: usize, const K: usize, const C: usize, const W: usize> Run<'_, S, M, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    /// Whether a momentum or the rate of a constraint jumps at a kink, so that velocities do not go through
    /// it as they are. At the kink itself a function may be no more than roundings: its size is that along
    /// the piece.
    pub(super) fn has_corner(&mut self, kink: usize, state: &State<S::Scalar, N>) -> bool {
        let part = S::Scalar::epsilon().sqrt();
        let mut middle = None;
        let mut place = 0;
        let mut found = false;
        let system = self.system;
        let memory = &mut *self.memory;
        let (inner, in_regime, constants) = (&mut memory.inner, &memory.in_regime, &memory.constants);
        let (control, limits, start) = (self.control, self.limits, memory.start);
        system.corners_at(state.t, &state.q, &state.v, &control.0, |own, gain, size| {
            place += 1;
            if own != kink || !above(gain.abs(), part * size) {
                return;
            }
            let half = S::Scalar::from_f64(0.5) * (start.t + state.t);
            let state = *middle.get_or_insert_with(|| {
                M::sample(inner, in_regime, constants, control, limits, half, &mut 0).unwrap_or(start)
            });
            let mut other = 0;
            system.corners_at(state.t, &state.q, &state.v, &control.0, |_, _, size| {
                other += 1;
                found = found || other == place && above(gain.abs(), part * size);
            });
        });
        found
    }
}
