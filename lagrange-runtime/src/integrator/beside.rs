//! States beside one, which show what a change of its numbers does to accelerations.

use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::state::State;

/// The states in which the numbers of one have moved `by` these amounts: all up, all down, and neighbours
/// against each other in both ways.
pub(crate) fn beside<R: Real, const N: usize>(state: &State<R, N>, by: &State<R, N>) -> [State<R, N>; 4] {
    array(|pattern| {
        let moved = |index: usize, x: R, by: R| {
            if (pattern + index * (pattern / 2)).is_multiple_of(2) { x + by } else { x - by }
        };
        State {
            t: moved(0, state.t, by.t),
            q: array(|i| moved(i, state.q[i], by.q[i])),
            v: array(|i| moved(i + 1, state.v[i], by.v[i])),
        }
    })
}
