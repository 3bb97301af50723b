//! Impacts that follow each other within a time that rounding hides.
//!
//! A body between a wall and a heavier one that comes nearer bounces between both, ever faster. From some
//! flight on its bounces are shorter than rounding can tell. Impacts at the same time would then push it from
//! both sides, and its last bounce would carry the other body away. One after the other they lose what
//! restitution leaves them to lose, in infinitely many bounces if it is small.

use super::impact::Struck;
use super::known::Known;
use super::scales::Scales;
use super::scene::{Scene, Status, above, entry, most, rounding};
use super::{Row, Switching};
use crate::number::elements::array;
use crate::number::real::{Ordered, Real};
use crate::system::error::Cause;
use crate::system::state::State;

/// The most impacts in turn. What is left after them is taken as one plastic impact.
const BOUNCES: usize = 1024;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The velocities after the impact, and its impulses: in turn where one recoils. Where a motion begins,
    /// gaps of zero are zero, and all impacts are at once.
    ///
    /// # Errors
    /// Those of [`impact`](Self::impact), and over numbers with variations those that say that these have
    /// none.
    pub(super) fn collide(
        &self,
        present: &[bool; C],
        (fired, begins): (Option<usize>, bool),
        scales: &Scales<S::Scalar, C>,
        tolerance: S::Scalar,
    ) -> Result<Struck<S::Scalar, N, C>, Cause> {
        let struck = self.impact()?;
        let recoils = !begins && self.recoils(&struck.1, present);
        if S::Scalar::PARTS > 1 {
            if recoils {
                return Err(self.accumulation());
            }
            self.struck(fired, present, &struck.1, tolerance)?;
        }
        if recoils { self.in_turn(scales, tolerance) } else { Ok(struck) }
    }

    /// Whether an impact strikes a contact that has opened so shortly before that its gap is rounding errors.
    fn recoils(&self, impulses: &[S::Scalar; C], present: &[bool; C]) -> bool {
        let largest = impulses.iter().fold(num_traits::Zero::zero(), |largest, one| most(largest, one.abs()));
        (0..C).any(|row| {
            let is_closed = self.is_closed.get(row) == Some(&true) && present.get(row) == Some(&false);
            let has_opened = is_closed && self.status.get(row) == Some(&Status::Apart);
            S::ROWS.get(row) == Some(&Row::Unilateral)
                && has_opened
                && above(entry(impulses, row), rounding::<S::Scalar>() * largest)
        })
    }

    /// The velocities after impacts in turn, and the sums of their impulses. Contacts that close strike,
    /// those that open do not. Where closing velocities have fallen to a part `tolerance` of the first ones,
    /// a plastic impact takes the rest.
    ///
    /// # Errors
    /// Those of [`impact`](Self::impact).
    #[cold]
    fn in_turn(
        &self,
        scales: &Scales<S::Scalar, C>,
        tolerance: S::Scalar,
    ) -> Result<Struck<S::Scalar, N, C>, Cause> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let mut first = None;
        let (mut v, mut sums) = (self.state.v, [zero; C]);
        for _ in 0..BOUNCES {
            let state = State { v, ..self.state };
            let known = Known::new(self.is_closed);
            let mut scene = Scene::new(self.system, &state, self.inputs, self.kinks, scales, &known);
            let closing = (0..C).filter(|&row| scene.status.get(row) == Some(&Status::Meets));
            let closing =
                closing.fold(zero, |most_, row| most(most_, entry(&scene.laws.rows.rates, row).abs()));
            if !closing.is_positive() {
                return Ok((v, sums));
            }
            let is_over = !above(closing, tolerance * *first.get_or_insert(closing));
            let (after, impulses) = if is_over {
                scene.plastic()
            } else {
                for (is_closed, status) in scene.is_closed.iter_mut().zip(&scene.status) {
                    *is_closed = *is_closed && *status != Status::Apart;
                }
                scene.impact()
            }?;
            v = after;
            sums = array(|row| entry(&sums, row) + entry(&impulses, row));
            if is_over {
                return Ok((v, sums));
            }
        }
        let state = State { v, ..self.state };
        let known = Known::new(self.is_closed);
        let scene = Scene::new(self.system, &state, self.inputs, self.kinks, scales, &known);
        let (v, impulses) = scene.plastic()?;
        Ok((v, array(|row| entry(&sums, row) + entry(&impulses, row))))
    }
}
