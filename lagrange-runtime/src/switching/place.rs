//! The place where a piece of the motion ends before its step.

use super::guards::Guard;
use super::way::shift;
use crate::number::real::Real;
use crate::system::state::State;

/// How a guard ends a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum How {
    /// It falls through zero.
    Falls,
    /// It stands for all rows that have shared a load until there: its own function tells nothing.
    Shared,
    /// It comes so near to zero that the errors of the motion do not tell whether it falls. A motion has
    /// derivatives there only if nothing jumps.
    Touches,
}

/// The place where a piece ends before its step.
pub(super) struct Event<R, const N: usize, const W: usize> {
    pub(super) state: State<R, N>,
    /// The guard that has fired; `None` if the guards are known no further.
    pub(super) guard: Option<Guard>,
    pub(super) how: How,
    /// The delay of the time of the state after the zero of the guard, since times are rounded.
    pub(super) late: R,
    /// The accelerations at the state.
    pub(super) accelerations: [R; N],
    /// The state at the zero of the guard.
    pub(super) place: State<R, N>,
    /// The kinks that the motion crosses there, if the guard is that of a kink. They are crossed together:
    /// crossed one by one, friction could let go on the way and not stick again.
    pub(super) crossed: [bool; W],
}

impl<R: Real, const N: usize, const W: usize> Event<R, N, W> {
    /// The end of a piece at a state before which no guard has fired.
    pub(super) fn cut(state: State<R, N>) -> Self {
        let (zero, accelerations, crossed) = (R::zero(), [R::zero(); N], [false; W]);
        Self { state, guard: None, how: How::Falls, late: zero, accelerations, place: state, crossed }
    }

    /// Takes the place back by a delay.
    pub(super) fn go_back(&mut self, late: R) {
        shift(&mut self.place, &self.accelerations, -late);
    }
}
