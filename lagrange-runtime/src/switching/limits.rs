//! Frictions at their limits.

use num_traits::Zero;

use super::choice::{Choice, Fired};
use super::scene::{Scene, Status, above, entry, put, rounding};
use super::trials::Part;
use super::turning::has_pairs;
use super::{Along, Coefficients, Regime, Row, Switching};
use crate::number::real::Real;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// The largest force of a friction that sticks, in the direction of its force.
    pub(super) fn limit(&self, row: usize, normal: Option<usize>, multipliers: &[S::Scalar; C]) -> S::Scalar {
        self.limit_against(-entry(multipliers, row), row, normal, multipliers)
    }

    /// The largest force of a friction that sticks, against a slip in the direction of this sign.
    fn limit_against(
        &self,
        way: S::Scalar,
        row: usize,
        normal: Option<usize>,
        multipliers: &[S::Scalar; C],
    ) -> S::Scalar {
        let coefficient = entry(&self.against(way).fixed, row);
        normal.map_or(coefficient, |normal| coefficient * entry(multipliers, normal).abs())
    }

    /// The direction, 1 or −1, in which a friction that sticks is nearer to slipping: what presses it there
    /// comes nearer to its limit.
    pub(super) fn nearer(
        &self,
        row: usize,
        normal: Option<usize>,
        multipliers: &[S::Scalar; C],
    ) -> S::Scalar {
        let (one, force): (S::Scalar, _) = (num_traits::One::one(), entry(multipliers, row));
        let left = |way: S::Scalar| self.limit_against(way, row, normal, multipliers) + way * force;
        if above(left(-one), left(one)) { one } else { -one }
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

    /// Whether a friction begins to slip in a regime that holds more at rest than it gives when it slips.
    /// Then nothing may have made it let go, though the regime agrees with its consequences.
    fn may_hold(&self, regime: &Regime<S::Scalar, C, W>, fired: Option<Fired>) -> bool {
        self.resting_rows(fired).any(|row| {
            let slip = entry(&regime.slip, row);
            let Coefficients { kinetic, fixed } = self.against(slip);
            slip != S::Scalar::zero() && entry(kinetic, row) != entry(fixed, row)
        })
    }

    /// The regime to which loads lead that grow in proportion, where a friction begins to slip in the chosen
    /// one that might hold; `None` where it begins for a reason.
    pub(super) fn held_if_it_can(
        &self,
        chosen: &Choice<S::Scalar, N, C, W>,
        part: S::Scalar,
        decided: Option<usize>,
        fired: Option<Fired>,
    ) -> Option<Choice<S::Scalar, N, C, W>> {
        if fired.is_none()
            && let Some(resting) = self.idle(chosen).or_else(|| self.stuck(chosen, part, decided))
        {
            return Some(resting);
        }
        let may_hold = self.may_hold(&chosen.regime, fired);
        if may_hold { self.loaded(chosen, part, decided, fired) } else { None }
    }

    /// The regime in which slips in two directions stick that begin with nothing but rounding errors of their
    /// forces: these are at their limits and balance the load. Where several feet share it, the search for
    /// possible shares finds the only one with fewer digits. `None` where no such slip begins.
    fn idle(&self, chosen: &Choice<S::Scalar, N, C, W>) -> Option<Choice<S::Scalar, N, C, W>> {
        if const { !has_pairs(&S::ROWS) } {
            return None;
        }
        let begins = self.beginning(&chosen.regime);
        let is_rounding = |row: usize| {
            let size = self.extent_of(row, &chosen.sizes.accelerations);
            !above(self.rate(row, &chosen.accelerations).abs(), rounding::<S::Scalar>() * size)
        };
        let is_idle = begins.any() && (0..C).filter(|&row| begins.has(row)).all(is_rounding);
        if is_idle { self.trial(begins.held(&chosen.regime)) } else { None }
    }

    /// The same of slips in one direction that constraints limit, if the load has shares with which they
    /// stick. `None` where one of them begins for a reason. Contacts have no part in it: feet that stick
    /// where links lie flat are rows that depend on each other for a moment, on which no motion goes on.
    fn stuck(
        &self,
        chosen: &Choice<S::Scalar, N, C, W>,
        part: S::Scalar,
        decided: Option<usize>,
    ) -> Option<Choice<S::Scalar, N, C, W>> {
        let mut regime = chosen.regime;
        for row in self.resting_rows(None) {
            let Some(&Row::Friction { pair: None, normal: Some(normal) }) = S::ROWS.get(row) else {
                continue;
            };
            let is_of_constraint = S::ROWS.get(normal) == Some(&Row::Bilateral);
            if !is_of_constraint || entry(&regime.slip, row) == S::Scalar::zero() {
                continue;
            }
            let size = self.extent_of(row, &chosen.sizes.accelerations);
            if above(self.rate(row, &chosen.accelerations).abs(), rounding::<S::Scalar>() * size) {
                return None;
            }
            put(&mut regime.slip, row, S::Scalar::zero());
            put(&mut regime.active, row, true);
        }
        if regime == chosen.regime {
            return None;
        }
        let trial = self.trial(regime)?;
        self.judge(&Part::all(&S::ROWS, &regime), &trial, part, decided).is_ok().then_some(trial)
    }

    /// The regime to which loads lead that grow in proportion, with contacts as in the chosen one: one
    /// friction after the other lets go, that which is exceeded most. `None` if that regime does not agree
    /// with its consequences.
    #[cold]
    fn loaded(
        &self,
        chosen: &Choice<S::Scalar, N, C, W>,
        part: S::Scalar,
        decided: Option<usize>,
        fired: Option<Fired>,
    ) -> Option<Choice<S::Scalar, N, C, W>> {
        let (zero, one): (S::Scalar, S::Scalar) = (S::Scalar::zero(), num_traits::One::one());
        let across = |row: usize| match S::ROWS.get(row) {
            Some(&Row::Friction { pair, .. }) => pair,
            _ => None,
        };
        let mut regime = chosen.regime;
        let set = |regime: &mut Regime<S::Scalar, C, W>, row: usize, slip: S::Scalar| {
            put(&mut regime.slip, row, slip);
            for row in [Some(row), across(row)].into_iter().flatten() {
                put(&mut regime.active, row, slip == zero);
            }
        };
        let slips = |row: &usize| entry(&chosen.regime.slip, *row) != zero;
        for row in self.resting_rows(fired).filter(slips) {
            set(&mut regime, row, zero);
        }
        loop {
            let trial = self.trial(regime)?;
            let forces = &trial.multipliers;
            let exceeded = self.resting_rows(fired).filter_map(|row| {
                let Some(&Row::Friction { normal, .. }) = S::ROWS.get(row) else { return None };
                let force = entry(forces, row).hypot(across(row).map_or(zero, |row| entry(forces, row)));
                let limit = self.limit(row, normal, forces);
                let sticks = regime.active.get(row) == Some(&true);
                (sticks && above(force, limit * (one + part))).then(|| (row, force / limit))
            });
            let most = exceeded.reduce(|most, next| if above(next.1, most.1) { next } else { most });
            let Some((row, _)) = most else {
                let parts = Part::all(&S::ROWS, &regime);
                return self.judge(&parts, &trial, part, decided).is_ok().then_some(trial);
            };
            let is_backward = across(row).is_none() && entry(forces, row).is_positive();
            set(&mut regime, row, if is_backward { -one } else { one });
        }
    }

    /// The frictions at rest, the first row of each, without one that has reached its limit.
    fn resting_rows(&self, fired: Option<Fired>) -> impl Iterator<Item = usize> + '_ {
        (0..C).filter(move |&row| {
            is_friction(S::ROWS.get(row), row)
                && !fired.is_some_and(|fired| fired.held && fired.row == row)
                && self.status.get(row) == Some(&Status::Rests)
        })
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
        let parts = Part::all(&S::ROWS, present);
        self.judge(&parts, &stuck, rounding(), None).ok()?;
        let way = self.nearer(row, *normal, &stuck.multipliers);
        let Coefficients { kinetic, fixed } = self.against(way);
        let limit = self.limit_against(way, row, *normal, &stuck.multipliers);
        let pressing = -way * entry(&stuck.multipliers, row);
        if above(limit - pressing, S::Scalar::epsilon().sqrt() * limit)
            || entry(kinetic, row) != entry(fixed, row)
        {
            return None;
        }
        let mut regime = *present;
        put(&mut regime.active, row, false);
        put(&mut regime.slip, row, way);
        self.trial(regime)
    }
}

/// Whether a row is a friction, the first of two that are one.
pub(super) fn is_friction(kind: Option<&Row>, row: usize) -> bool {
    matches!(kind, Some(Row::Friction { pair, .. }) if pair.is_none_or(|other| row < other))
}
