//! Where contacts that are closed, or frictions that stick, depend on each other, some of them let go.
//!
//! A regime is chosen by the accelerations of one state. There two rods in a straight line between two feet
//! that stick carry any load, and a friction at rest can hold. Beside it, the feet cannot both stick: the
//! constraints of the regime depend on each other in this state alone, and no motion in this regime leads on.

use super::known::Known;
use super::limits::is_friction;
use super::run::Run;
use super::scene::put;
use super::trials::FEW;
use super::{Regime, Switching};
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
    /// The regime and the state that follow a state, as [`Run::settle_once`] finds them. Frictions let go
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
        if !is_dependence(&cause) {
            return Err(cause);
        }
        *state = begun;
        self.let_go(state, (present, known, late), |_| true).ok_or(cause)
    }

    /// Chooses the regime anew where a step has failed because constraints depend on each other. Contacts
    /// that bear only because the motion has landed here are opened, unless the motion needs them. Without
    /// such contacts, some of the frictions that stick let go. Returns false, and leaves the regime, if the
    /// step has failed for another `cause`, or if no friction can let go.
    #[cold]
    pub(super) fn lets_go(&mut self, cause: &Cause) -> Result<bool, Cause> {
        let landed = core::mem::replace(&mut self.memory.landed, [false; C]);
        if !is_dependence(cause) {
            return Ok(false);
        }
        let (mut state, mut present) = (self.memory.end, self.memory.regime);
        let (sticks, known) = (present.active, Known::new(present.active));
        let zero = num_traits::Zero::zero();
        let is_first = self.memory.start.t == state.t;
        let regime = if is_first && landed.contains(&true) {
            present.active = array(|row| sticks[row] && !landed[row]);
            self.settle(&mut state, present, known, zero)?
        } else {
            let may = |row: usize| has(&sticks, row);
            let Some(regime) = self.let_go(&mut state, (present, known, zero), may) else { return Ok(false) };
            regime
        };
        self.go_on(regime, state);
        Ok(true)
    }

    /// The regime and the state that follow where the next set of these frictions slips. `None`, and the
    /// state as it was, if one of each set has to stick, or nothing follows. Until time passes, frictions
    /// that have let go slip wherever they can.
    ///
    /// Accelerations do not tell which ones have to let go: where two of three that stick share a slip, one
    /// of these two alone seems to slip, but goes nowhere. So a set that has not helped is followed by
    /// another, in the order of binary numbers whose digits are the frictions.
    #[cold]
    #[allow(clippy::type_complexity)]
    fn let_go(
        &mut self,
        state: &mut State<S::Scalar, N>,
        (present, known, late): (Regime<S::Scalar, C, W>, Known<C>, S::Scalar),
        may: impl Fn(usize) -> bool,
    ) -> Option<Regime<S::Scalar, C, W>> {
        let begun = *state;
        let before = self.memory.opened;
        let frictions = (0..C).filter(|&row| is_friction(S::ROWS.get(row), row));
        let mut set = before;
        for _ in 0..FEW {
            next(&mut set, frictions.clone().filter(|&row| may(row) || has(&before, row)))?;
            self.memory.opened = set;
            match self.settle_once(state, present, Known { opened: set, ..known }, late) {
                Ok(regime) if frictions.clone().all(|row| !(has(&set, row) && has(&regime.active, row))) => {
                    return Some(regime);
                }
                _ => (*state, self.memory.opened) = (begun, before),
            }
        }
        None
    }
}

/// The next set of these rows, in the order of binary numbers whose first digit is the first row. `None`
/// after the last one.
fn next<const C: usize>(set: &mut [bool; C], rows: impl Iterator<Item = usize>) -> Option<()> {
    for row in rows {
        let was_in = has(set, row);
        put(set, row, !was_in);
        if !was_in {
            return Some(());
        }
    }
    None
}

fn has<const C: usize>(set: &[bool; C], row: usize) -> bool {
    set.get(row) == Some(&true)
}

/// Whether constraints that depend on each other are the cause of an error.
fn is_dependence(cause: &Cause) -> bool {
    matches!(cause, Cause::Undetermined { .. } | Cause::Contradictory { .. })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_set_comes_once() {
        let mut set = [false; 4];
        let mut seen = [[false; 4]; 7];
        for seen in &mut seen {
            next(&mut set, [0, 2, 3].into_iter()).unwrap();
            *seen = set;
        }
        assert_eq!(next(&mut set, [0, 2, 3].into_iter()), None);
        assert_eq!(seen[0], [true, false, false, false]);
        assert_eq!(seen[2], [true, false, true, false]);
        assert!(seen.iter().enumerate().all(|(i, set)| !set[1] && !seen[..i].contains(set)));
    }
}
