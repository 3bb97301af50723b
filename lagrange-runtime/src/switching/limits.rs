//! Frictions at their limits.

use num_traits::Zero;

use super::choice::Choice;
use super::scene::{Scene, Status, above, entry, put, rounding};
use super::trials::{Options, Part, changes, combine, parts_at, regime};
use super::turning::has_pairs;
use super::{Along, Coefficients, Regime, Row, Switching};
use crate::number::elements::array;
use crate::number::real::Real;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// The largest force of a friction that sticks, in the direction of its force.
    pub(super) fn limit(&self, row: usize, normal: Option<usize>, multipliers: &[S::Scalar; C]) -> S::Scalar {
        let coefficient = entry(&self.against(-entry(multipliers, row)).fixed, row);
        normal.map_or(coefficient, |normal| coefficient * entry(multipliers, normal).abs())
    }

    /// Whether a friction has a limit of zero in both directions that does not change in the regime. It can
    /// hold nothing, so that its slip decides about nothing.
    pub(super) fn is_frictionless(&self, row: usize) -> bool {
        let Some(Row::Friction { pair, .. }) = S::ROWS.get(row) else { return false };
        let first = pair.map_or(row, |other| row.min(other));
        let lasts = |along: &[Along; C]| along.get(first) == Some(&Along::Constant);
        // A limit of zero with derivatives counts as friction, since its derivatives are asked for.
        let is_zero = |number: S::Scalar| (0..S::Scalar::PARTS).all(|part| number.part(part).is_zero());
        lasts(&S::ALONG.fixed)
            && lasts(&S::BACKWARD)
            && self.coefficients.iter().all(|coefficients| is_zero(entry(&coefficients.fixed, first)))
    }

    /// Whether each friction that begins to slip in a regime, and that holds more at rest than it gives when it
    /// slips, would have to hold more than it can if it stuck. If not, nothing has made it let go, though
    /// it goes on to slip once it does. The friction that has `fired` has reached its limit.
    pub(super) fn is_forced(&self, choice: &Choice<S::Scalar, N, C, W>, fired: Option<usize>) -> bool {
        let zero: S::Scalar = num_traits::Zero::zero();
        S::ROWS.iter().enumerate().all(|(row, kind)| {
            let Row::Friction { normal, pair } = *kind else { return true };
            let slip = entry(&choice.regime.slip, row);
            if slip == zero || fired == Some(row) || self.status.get(row) != Some(&Status::Rests) {
                return true;
            }
            let Coefficients { kinetic, fixed } = self.against(slip);
            if entry(kinetic, row) == entry(fixed, row) {
                return true;
            }
            let mut stuck = choice.regime;
            put(&mut stuck.slip, row, zero);
            put(&mut stuck.active, row, true);
            if let Some(other) = pair {
                put(&mut stuck.active, other, true);
            }
            let Some(stuck) = self.trial(stuck) else { return true };
            let across = pair.map_or(zero, |other| entry(&stuck.multipliers, other));
            above(entry(&stuck.multipliers, row).hypot(across), self.limit(row, normal, &stuck.multipliers))
        })
    }

    /// A regime among these options that agrees with its consequences, in which no friction lets go that
    /// nothing has made let go, and that differs from the chosen one in friction alone; `None` if there is
    /// none. Where loads grow, such a regime comes first.
    #[cold]
    pub(super) fn forced(
        &self,
        chosen: &Choice<S::Scalar, N, C, W>,
        options: &[Options; C],
        part: S::Scalar,
        decided: Option<usize>,
        fired: Option<usize>,
    ) -> Option<Choice<S::Scalar, N, C, W>> {
        let mut found = None;
        combine(options, &changes(&S::ROWS), |parts| {
            found = regime(&S::ROWS, parts, options, &[false; C], self.kinks)
                .filter(|regime| parts_at(&S::ROWS, &chosen.regime, regime).is_none())
                .and_then(|regime| self.trial(regime))
                .filter(|trial| self.judge(parts, trial, part, decided).is_ok())
                .filter(|trial| self.is_forced(trial, fired));
            found.is_some()
        });
        found
    }

    /// The regime in which a friction slips whose force has reached its limit in the present one. Both have
    /// the same accelerations and reactions here, so that the other rows need not be asked: what tells them
    /// apart is the rounding error of the time at which the limit is reached. `None` where they differ
    /// because the friction holds more than it gives when it slips, and for a row that is no friction in one
    /// direction, does not stick, or is not at its limit.
    pub(super) fn slipping(
        &self,
        present: &Regime<S::Scalar, C, W>,
        row: usize,
    ) -> Option<Choice<S::Scalar, N, C, W>> {
        let Some(Row::Friction { normal, pair: None }) = S::ROWS.get(row) else { return None };
        if present.active.get(row) != Some(&true) {
            return None;
        }
        let stuck = self.trial(*present)?;
        let parts = array(|row| S::ROWS.get(row).map_or(Part::Off, |&kind| Part::of(row, kind, present)));
        self.judge(&parts, &stuck, rounding(), None).ok()?;
        let against = -entry(&stuck.multipliers, row);
        let limit = self.limit(row, *normal, &stuck.multipliers);
        if above(limit - against.abs(), S::Scalar::epsilon().sqrt() * limit) {
            return None;
        }
        let Coefficients { kinetic, fixed } = self.against(against);
        if entry(kinetic, row) != entry(fixed, row) {
            return None;
        }
        let one: S::Scalar = num_traits::One::one();
        let mut regime = *present;
        put(&mut regime.active, row, false);
        put(&mut regime.slip, row, if against.is_positive() { one } else { -one });
        self.trial(regime)
    }

    /// The present regime where the load of a friction that sticks in two directions is shared with others:
    /// at the limit of all shares nothing accelerates, and how the load goes on decides what slips. `None`
    /// where the motion determines all reactions, and for other rows.
    pub(super) fn sharing(
        &self,
        present: &Regime<S::Scalar, C, W>,
        row: usize,
    ) -> Option<Choice<S::Scalar, N, C, W>> {
        let Some(Row::Friction { pair: Some(_), .. }) = S::ROWS.get(row) else { return None };
        if const { !has_pairs(&S::ROWS) } || present.active.get(row) != Some(&true) {
            return None;
        }
        let independence = self.balance(present, &self.state.v)?.0.independence;
        if independence.rank < independence.rows { self.trial(*present) } else { None }
    }
}
