//! Frictions that have stuck and shared a load, and let go.
//!
//! At the limit of all possible shares nothing accelerates yet, and no force tells which of the frictions
//! slip then. How the load goes on does.

use super::choice::{Choice, is_limit};
use super::growing::{Grown, TRIES};
use super::known::Known;
use super::scales::Scales;
use super::scene::{Scene, Status, above, entry};
use super::trials::{Options, Part, combine, regime};
use super::{Regime, Row, Switching};
use crate::linear::SaddlePoint;
use crate::number::elements::array;
use crate::number::real::{Ordered, Real};
use crate::system::error::Cause;
use crate::system::state::State;

/// A choice, and the motion that follows it for a short time if slips in two directions begin.
type Next<R, const N: usize, const C: usize, const W: usize> =
    (Choice<R, N, C, W>, Option<Grown<R, N, C, W>>);

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The regime that follows the present one, in which a guard may have fired.
    ///
    /// # Errors
    /// Those of [`choose`](Self::choose).
    pub(super) fn follow(
        &self,
        present: &Regime<S::Scalar, C, W>,
        fired: Option<usize>,
        scales: &Scales<S::Scalar, C>,
    ) -> Result<Next<S::Scalar, N, C, W>, Cause> {
        if let Some(stuck) = fired.and_then(|row| self.sharing(present, row)) {
            if let Some(turned) = self.with_other_sides(&stuck) {
                return Ok((turned, None));
            }
            if let Some(grown) = self.loosened(&stuck, scales) {
                return Ok((stuck, Some(grown)));
            }
            if let Some(choice) = self.let_loose(&stuck, scales) {
                return Ok((choice, None));
            }
        }
        Ok((self.choose(present, fired)?, None))
    }

    /// The present regime where the load of a friction that sticks, or of a contact that bears, is shared
    /// with others. `None` where the motion determines its force, and for other rows.
    fn sharing(&self, present: &Regime<S::Scalar, C, W>, row: usize) -> Option<Choice<S::Scalar, N, C, W>> {
        if !may_share(&S::ROWS, row) || present.active.get(row) != Some(&true) {
            return None;
        }
        let State { t, q, v } = &self.state;
        let equations = S::equations_in(&self.system.in_regime(present), *t, q, v, self.inputs)?;
        let is_shared = !equations.saddle.is_independent() && self.shared(present).get(row) == Some(&true);
        if is_shared { self.trial(*present) } else { None }
    }

    /// The rows whose reaction the motion does not determine, or what limits it: other reactions give the
    /// same forces, with those of the frictions that they drive. Feet that slip in different directions share
    /// no load: other reactions would give another motion.
    #[cold]
    pub(super) fn shared(&self, regime: &Regime<S::Scalar, C, W>) -> [bool; C] {
        let (zero, one): (S::Scalar, S::Scalar) = (num_traits::Zero::zero(), num_traits::One::one());
        let spread = self.spread(regime, &self.drags(regime, &self.state.v));
        let is_own = |row: usize| {
            let unit = array(|other| if other == row { one } else { zero });
            above((one - entry(&spread.shortest(&unit), row)).abs(), S::Scalar::epsilon().sqrt())
        };
        array(|row| {
            let (pair, normal) = match S::ROWS[row] {
                Row::Friction { pair, normal } => (pair, normal),
                _ => (None, None),
            };
            is_own(row) || pair.is_some_and(is_own) || normal.is_some_and(is_own)
        })
    }

    /// The same with reactions from other sides of constraints that limit frictions, if these share the load
    /// with some margin. The shares of each choice of sides are a convex set, and its last ones need not be
    /// the last of all.
    #[cold]
    fn with_other_sides(&self, stuck: &Choice<S::Scalar, N, C, W>) -> Option<Choice<S::Scalar, N, C, W>> {
        let own = Part::all(&S::ROWS, &stuck.regime);
        let has_sides = |row: usize| S::ROWS[row] == Row::Bilateral && is_limit(&S::ROWS, row);
        let options = array(|row| match (has_sides(row), own[row]) {
            (true, Part::On) => Options::new(&[Part::On, Part::Against]),
            (true, Part::Against) => Options::new(&[Part::Against, Part::On]),
            (_, part) => Options::new(&[part]),
        });
        let mut found = None;
        combine(&options, &[1; C], |parts| {
            let turned = regime(&S::ROWS, parts, &options, &[false; C], self.kinks);
            let turned =
                turned.filter(|turned| *turned != stuck.regime).and_then(|turned| self.trial(turned));
            found = turned.filter(|turned| {
                let drags = self.drags(&turned.regime, &self.state.v);
                self.can_share(&turned.regime, &drags, &turned.multipliers)
            });
            found.is_some()
        });
        found
    }

    /// The regime in which frictions slip, or contacts open, that have shared a load until now: that of the
    /// first later time at which it drives all of them, if it is the same at half of that time.
    #[cold]
    fn let_loose(
        &self,
        stuck: &Choice<S::Scalar, N, C, W>,
        scales: &Scales<S::Scalar, C>,
    ) -> Option<Choice<S::Scalar, N, C, W>> {
        let half = S::Scalar::from_f64(0.5);
        let changed = S::Scalar::epsilon().sqrt();
        // A load that has changed by no more than a rounding error in all of the motion changes by √ε in this
        // time, which is unknown where a motion begins at time zero.
        let longest = scales.times / changed;
        let mut later = self.instant();
        for _ in 0..TRIES {
            // At half of the time it may still be hidden by the rounding errors of the time of the event, and
            // at the limit several regimes pass for possible that nothing drives.
            let driven = |later: S::Scalar| {
                let (regime, part) = self.loose_at(stuck, scales, later)?;
                above(part, changed).then_some(regime)
            };
            if let Some(regime) = driven(later)
                && let Some(before) = driven(half * later)
            {
                return if before == regime { self.trial(regime) } else { None };
            }
            later *= S::Scalar::from_f64(4.0);
            if longest.is_positive() && above(later, longest) {
                break;
            }
        }
        None
    }

    /// The regime at a later time \[s] until which all goes on, and the least acceleration of a slip that
    /// begins then, or of a gap that opens, as a part of what forces could give it. `None` where none does.
    fn loose_at(
        &self,
        stuck: &Choice<S::Scalar, N, C, W>,
        scales: &Scales<S::Scalar, C>,
        later: S::Scalar,
    ) -> Option<(Regime<S::Scalar, C, W>, S::Scalar)> {
        let in_regime = self.system.in_regime(&stuck.regime);
        let state = self.moved(&in_regime, &stuck.accelerations, later)?;
        let is_active = |regime: &Regime<S::Scalar, C, W>, row: usize| regime.active.get(row) == Some(&true);
        let rested = array(|row| match self.status.get(row) {
            Some(Status::Touches) => is_active(&stuck.regime, row),
            status => status == Some(&Status::Rests),
        });
        let known = Known { rested, ..Known::settled(self.is_closed) };
        let scene = Scene::new(self.system, &state, self.inputs, self.kinks, scales, &known);
        let there = scene.choose(&stuck.regime, None).ok()?;
        let begins = |row: &usize| match S::ROWS.get(*row) {
            Some(Row::Friction { .. }) => {
                let slips = entry(&there.regime.slip, *row) != num_traits::Zero::zero();
                slips && scene.status.get(*row) == Some(&Status::Rests)
            }
            Some(Row::Unilateral) => is_active(&stuck.regime, *row) && !is_active(&there.regime, *row),
            _ => false,
        };
        let parts = (0..C).filter(begins).map(|row| {
            let strength = scene.extent_of(row, &there.sizes.accelerations);
            (scene.rate(row, &there.accelerations).abs() / strength).part(0)
        });
        let least = parts.reduce(|least, part| if above(least, part) { part } else { least })?;
        Some((there.regime, least))
    }
}

/// Whether a row may share a load.
pub(super) fn may_share<const C: usize>(rows: &[Row; C], row: usize) -> bool {
    matches!(rows.get(row), Some(Row::Friction { .. } | Row::Unilateral))
}
