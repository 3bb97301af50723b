//! Where contacts that are closed, or frictions that stick, depend on each other, one of them lets go.
//!
//! A regime is chosen by the accelerations of one state. There two rods in a straight line between two feet
//! that stick carry any load, and a friction at rest can hold. Beside it, the feet cannot both stick: the
//! constraints of the regime depend on each other in this state alone, and no motion in this regime leads on.

use super::known::Known;
use super::run::Run;
use super::scene::put;
use super::{Regime, Row, Switching};
use crate::number::elements::array;
use crate::number::real::Ordered;
use crate::system::control::Held;
use crate::system::error::Cause;
use crate::system::method::Adaptive;
use crate::system::state::State;

impl<S, M, const N: usize, const K: usize, const C: usize, const W: usize> Run<'_, S, M, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    /// The regime and the state that follow a state, as [`Run::settle_once`] finds them. A friction lets go
    /// where the state cannot be brought onto the constraints that are found.
    pub(super) fn settle(
        &mut self,
        state: &mut State<S::Scalar, N>,
        present: Regime<S::Scalar, C, W>,
        known: Known<C>,
        late: S::Scalar,
    ) -> Result<Regime<S::Scalar, C, W>, Cause> {
        let begun = *state;
        let found = self.settle_once(state, present, known, late);
        let Err(cause) = found else { return found };
        let Some(constraint) = dependent(&cause) else { return Err(cause) };
        *state = begun;
        self.let_go(constraint, state, (present, known, late), |_| true).ok_or(cause)
    }

    /// Chooses the regime anew where a step has failed because constraints depend on each other. Contacts that
    /// bear only because the motion has landed here are opened, unless the motion needs them; if there are
    /// none, a friction lets go that has stuck. Returns false, and leaves the regime, if the step has failed
    /// for another `cause`, or if nothing can let go.
    #[cold]
    pub(super) fn lets_go(&mut self, cause: &Cause) -> Result<bool, Cause> {
        let landed = core::mem::replace(&mut self.memory.landed, [false; C]);
        let Some(constraint) = dependent(cause) else { return Ok(false) };
        let (mut state, mut present) = (self.memory.end, self.memory.regime);
        let (sticks, known) = (present.active, Known::new(present.active));
        let zero = num_traits::Zero::zero();
        let is_first = self.memory.start.t == state.t;
        let regime = if is_first && landed.contains(&true) {
            present.active = array(|row| sticks[row] && !landed[row]);
            self.settle(&mut state, present, known, zero)?
        } else {
            let may = |row: usize| sticks.get(row) == Some(&true);
            let let_go = self.let_go(constraint, &mut state, (present, known, zero), may);
            let Some(regime) = let_go else { return Ok(false) };
            regime
        };
        self.go_on(regime, state);
        Ok(true)
    }

    /// The regime and the state that follow where one of these frictions slips, the `weakest` row first: it is
    /// one of those that depend on each other. `None`, and the state as it was, where each of them has to
    /// stick, or nothing follows. Until time passes a friction that has let go slips wherever it can.
    #[cold]
    #[allow(clippy::type_complexity)]
    fn let_go(
        &mut self,
        weakest: usize,
        state: &mut State<S::Scalar, N>,
        (present, known, late): (Regime<S::Scalar, C, W>, Known<C>, S::Scalar),
        may: impl Fn(usize) -> bool,
    ) -> Option<Regime<S::Scalar, C, W>> {
        let begun = *state;
        let rows = core::iter::once(weakest).chain((0..C).filter(|&row| row != weakest));
        for row in rows.filter(|&row| is_friction(S::ROWS.get(row), row) && may(row)) {
            let opened = self.memory.opened;
            put(&mut self.memory.opened, row, true);
            let known = Known { opened: self.memory.opened, ..known };
            match self.settle_once(state, present, known, late) {
                Ok(regime) if regime.active.get(row) == Some(&false) => return Some(regime),
                _ => (*state, self.memory.opened) = (begun, opened),
            }
        }
        None
    }
}

/// The constraint that depends on others, if this is the cause of an error.
fn dependent(cause: &Cause) -> Option<usize> {
    match *cause {
        Cause::Undetermined { constraint, .. } | Cause::Contradictory { constraint, .. } => Some(constraint),
        _ => None,
    }
}

/// Whether a row is a friction, the first of two that are one.
fn is_friction(kind: Option<&Row>, row: usize) -> bool {
    matches!(kind, Some(Row::Friction { pair, .. }) if pair.is_none_or(|other| row < other))
}
