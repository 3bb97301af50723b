//! The numbers of one lane of a state.

use crate::number::elements::Each;
use crate::number::real::{Real, Vector};
use crate::system::state::State;

/// The state of zeros.
pub(super) fn zeros<R: Real, const N: usize>() -> State<R, N> {
    State { t: R::zero(), q: [R::zero(); N], v: [R::zero(); N] }
}

/// The numbers of a lane.
pub fn get<R: Vector, const N: usize>(state: &State<R, N>, lane: usize) -> State<R::Lane, N> {
    State { t: state.t.lane(lane), q: state.q.each(|x| x.lane(lane)), v: state.v.each(|x| x.lane(lane)) }
}

/// Replaces the numbers of a lane.
pub fn set<R: Vector, const N: usize>(state: &mut State<R, N>, lane: usize, numbers: &State<R::Lane, N>) {
    state.t.set_lane(lane, numbers.t);
    for i in 0..N {
        state.q[i].set_lane(lane, numbers.q[i]);
        state.v[i].set_lane(lane, numbers.v[i]);
    }
}
