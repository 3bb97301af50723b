//! Regimes that differ by more than a tie: several motions from one state are a paradox only where all
//! numbers that tell them apart are certain.

use super::choice::Choice;
use super::scene::{Scene, Status, above, entry, product, put};
use super::trials::parts_at;
use super::{Regime, Row, Switching};
use crate::number::elements::Each;
use crate::number::real::Real;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// The first contact or constraint that reacts otherwise in one regime than in the other. `None` if the
    /// motions do not differ, or if one of the regimes is uncertain there.
    pub(super) fn differs(
        &self,
        a: &Choice<S::Scalar, N, C, W>,
        b: &Choice<S::Scalar, N, C, W>,
    ) -> Option<usize> {
        let row = parts_at(&S::ROWS, &a.regime, &b.regime)?;
        let part = S::Scalar::epsilon().sqrt();
        let sizes = [a, b].each(|choice| choice.sizes.levelled(&self.units).accelerations);
        let apart = (0..N).any(|i| {
            let difference = (a.accelerations[i] - b.accelerations[i]).abs();
            above(difference, part * (sizes[0][i] + sizes[1][i]))
        });
        (apart && self.are_certain(row, a) && self.are_certain(row, b)).then_some(row)
    }

    /// Whether one of two regimes has shorter reactions than the other, from which it differs in the sides of
    /// reactions alone.
    pub(super) fn is_shorter(a: &Choice<S::Scalar, N, C, W>, b: &Choice<S::Scalar, N, C, W>) -> bool {
        let length = |choice: &Choice<S::Scalar, N, C, W>| product(&choice.multipliers, &choice.multipliers);
        let part = S::Scalar::epsilon().sqrt();
        Regime { side: b.regime.side, ..a.regime } == b.regime
            && above(length(b), length(a) + part * length(a))
    }

    /// Whether a contact reacts or opens by more than the threshold of a tie, and slips that begin grow by
    /// more, too.
    fn are_certain(&self, row: usize, choice: &Choice<S::Scalar, N, C, W>) -> bool {
        let part = S::Scalar::epsilon().sqrt();
        let sizes = choice.sizes.levelled(&self.units);
        let grows = |row: usize| {
            let size = self.extent_of(row, &sizes.accelerations) + entry(&self.gamma, row).abs();
            above(self.rate(row, &choice.accelerations).abs(), part * size)
        };
        let is_tie = |(row, kind): (usize, &Row)| {
            let slips = entry(&choice.regime.slip, row) != num_traits::Zero::zero();
            let begins = slips && self.status.get(row) == Some(&Status::Rests);
            match kind {
                Row::Friction { pair, .. } => begins && !grows(row) && !pair.is_some_and(grows),
                _ => false,
            }
        };
        if S::ROWS.iter().enumerate().any(is_tie) {
            return false;
        }
        if choice.regime.active.get(row) != Some(&true) {
            return grows(row);
        }
        let reaction = entry(&choice.multipliers, row).abs();
        above(reaction, part * self.borne(row, &sizes.forces)) && self.is_independent(row, choice)
    }

    /// Whether the gradient of a closed contact is no combination of the others in a regime. If it is one,
    /// the equations give the sum of their reactions alone, and friction may be driven by any part of it.
    fn is_independent(&self, row: usize, choice: &Choice<S::Scalar, N, C, W>) -> bool {
        let rank = |regime: &Regime<S::Scalar, C, W>| {
            self.balance(regime, &choice.velocities).map(|(balance, _)| balance.independence.rank)
        };
        let mut without = choice.regime;
        put(&mut without.active, row, false);
        rank(&without) != rank(&choice.regime)
    }
}
