//! Contacts that touch and bear nothing, and bear again as the motion goes on.
//!
//! A foot of a table that slides may be relieved of its load by the others. Its gap stays zero, so that it
//! tells nothing. The loads of equal stiff springs tell when the foot has to bear again. No series follows
//! these, so the step is searched for that place.

use super::super::Switching;
use super::super::course::Course;
use super::super::guards::{Guard, Guards, PLACES};
use super::super::scene::Scene;
use super::shared::halved;
use super::{Fall, Row};
use crate::number::elements::array;
use crate::number::real::{Ordered, Real};
use crate::system::state::State;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Guards<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The contacts that touch where the step starts and that others relieve of their loads, where these
    /// decide how feet slide.
    pub(super) fn relieved(&self) -> [bool; C] {
        let zero: S::Scalar = num_traits::Zero::zero();
        let slides = Scene::<S, N, K, C, W>::slides(|row| self.regime.slip.get(row) != Some(&zero));
        // A gap that stays positive on the step is watched no more.
        let is_open = |row: usize| {
            S::ROWS[row] == Row::Unilateral && !self.regime.active[row] && self.has(Guard::Row(row))
        };
        if !slides || !(0..C).any(is_open) {
            return [false; C];
        }
        let scene = self.scene(self.start);
        let touches: [bool; C] = array(|row| is_open(row) && scene.is_closed[row]);
        // A contact that should bear here has been left open since no other regime was possible.
        array(|row| touches[row] && !self.bears(row, self.start))
    }

    /// Whether a contact that is open would bear at a state.
    fn bears(&self, row: usize, state: &State<S::Scalar, N>) -> bool {
        let scene = self.scene(state);
        let balance = scene.balance(self.regime, &state.v);
        balance.is_some_and(|(found, _)| scene.would_bear(row, &self.regime.active, &found.multipliers))
    }

    /// Where the first of these contacts bears again before a part of the step, as far as some places of it
    /// show.
    pub(super) fn bears_again(
        &self,
        relieved: &[bool; C],
        course: &Course<'_, S::Scalar, N>,
        until: S::Scalar,
    ) -> Option<(Fall<S::Scalar>, Guard)> {
        let rests = |row: usize, place: S::Scalar| !self.bears(row, &course.at(self.start, place)[0]);
        let mut low = num_traits::Zero::zero();
        for part in PLACES {
            let place = S::Scalar::from_f64(part) * until;
            let found = (0..C).filter(|&row| relieved[row] && !rests(row, place));
            let first = found.map(|row| (row, halved(low, place, |place| rests(row, place))));
            let first = first.reduce(|first, next| if next.1[0] < first.1[0] { next } else { first });
            if let Some((row, [place, fallen])) = first {
                return Some((Fall { place, fallen }, Guard::Row(row)));
            }
            low = place;
        }
        None
    }
}
