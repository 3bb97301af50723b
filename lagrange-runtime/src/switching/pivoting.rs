//! The regime of many rows, by pivots instead of all combinations.
//!
//! Contacts without friction and frictions of given limits are a linear complementarity problem with a
//! positive semidefinite matrix, whose accelerations are unique. From a first combination, all rows that do
//! not agree with its consequences change at once; that is Newton's method. It may go round in circles. After
//! some turns without fewer such rows, only the last of them changes, until they become fewer: those single
//! changes end at the solution of every problem with a positive definite matrix (K. G. Murty, "Note on a
//! Bard-type scheme for solving the complementarity problem", Opsearch 11, 1974; J. J. Júdice, F. M. Pires,
//! "A block principal pivoting algorithm for large-scale strictly monotone linear complementarity problems",
//! Comput. Oper. Res. 21, 1994). Friction that reactions drive, and slips in two directions, change in the
//! same way, and end sooner from what sweeps over contacts have found. What is found is examined like every
//! other combination.

use super::choice::{Choice, is_limit};
use super::scene::{Scene, above, entry, put};
use super::trials::{COMBINATIONS, FEW, Options, Part, regime, thresholds};
use super::{Row, Switching};
use crate::number::elements::Each;
use crate::number::real::Real;

/// The turns without fewer faults after which single rows change, as Júdice and Pires have it.
const PATIENCE: usize = 10;

/// The consequences of a combination, the rows that do not agree with them, and reactions or impulses.
pub(super) type Examined<T, R, const C: usize> = (T, [bool; C], [R; C]);

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// A regime among these options that agrees with its consequences, and the part of sizes up to which it
    /// does. `None` where none is found.
    #[cold]
    pub(super) fn pivoted(
        &self,
        options: &[Options; C],
        decided: Option<usize>,
        is_coupled: bool,
    ) -> Option<(Choice<S::Scalar, N, C, W>, S::Scalar)> {
        let first = options.each(|options| options.first());
        let from = |parts: &[Part; C], turns: usize| {
            thresholds()
                .into_iter()
                .find_map(|part| Some((self.pivot(parts, options, (part, turns), decided)?, part)))
        };
        let by_sweeps = || from(&self.swept_by_forces(options)?, FEW);
        // Without coupled friction the turns end at the solution.
        from(&first, FEW)
            .or_else(by_sweeps)
            .or_else(|| if is_coupled { None } else { from(&first, COMBINATIONS) })
    }

    /// The first contact or constraint that reacts otherwise in another regime that agrees with its
    /// consequences as well. Each reaction that drives friction is tried the other way, while all other rows
    /// may change.
    #[cold]
    pub(super) fn another(
        &self,
        chosen: &Choice<S::Scalar, N, C, W>,
        options: &[Options; C],
        part: S::Scalar,
        decided: Option<usize>,
    ) -> Option<usize> {
        let (mut present, mut near) = ([Part::Off; C], *options);
        let rows = S::ROWS.iter().enumerate().zip(present.iter_mut().zip(&mut near));
        for ((row, &kind), (present, near)) in rows {
            *present = Part::of(row, kind, &chosen.regime);
            *near = near.with(*present, true);
        }
        (0..C).filter(|&row| is_limit(&S::ROWS, row)).find_map(|row| {
            let way = [Part::On, Part::Against, Part::Off].into_iter().find(|&way| {
                way != entry_of(&present, row) && options.get(row).is_some_and(|options| options.has(way))
            });
            let mut other = near;
            put(&mut other, row, Options::new(&[way?]));
            let first = other.each(|options| options.first());
            self.differs(chosen, &self.pivot(&first, &other, (part, FEW), decided)?)
        })
    }

    /// The regime that agrees up to a part, from these activities on, in so many turns at most.
    fn pivot(
        &self,
        parts: &[Part; C],
        options: &[Options; C],
        (part, turns): (S::Scalar, usize),
        decided: Option<usize>,
    ) -> Option<Choice<S::Scalar, N, C, W>> {
        self.turn_over(parts, options, turns, |parts| {
            let regime = regime(&S::ROWS, parts, options, &[false; C], self.kinks)?;
            let trial = self.trial(regime)?;
            let faults = marked(self.faults(parts, &trial, part, decided));
            Some((trial, faults, self.presses(&trial)))
        })
    }

    /// The multipliers of a trial. Where a friction in one direction sticks within its limit, but contradicts
    /// others that stick, its row tells which way it goes, and not its force.
    fn presses(&self, trial: &Choice<S::Scalar, N, C, W>) -> [S::Scalar; C] {
        let mut presses = trial.multipliers;
        for (row, (press, &kind)) in presses.iter_mut().zip(&S::ROWS).enumerate() {
            if let Row::Friction { normal, pair: None } = kind
                && trial.regime.active.get(row) == Some(&true)
                && !above(press.abs(), self.limit(row, normal, &trial.multipliers))
            {
                *press = -self.rate(row, &trial.accelerations);
            }
        }
        presses
    }

    /// What agrees with its consequences after rows that do not have changed in turn, from these activities
    /// on. `None` where `turns` are not enough, no row can change, or a combination has no consequences.
    #[cold]
    pub(super) fn turn_over<T>(
        &self,
        parts: &[Part; C],
        options: &[Options; C],
        turns: usize,
        examine: impl Fn(&[Part; C]) -> Option<Examined<T, S::Scalar, C>>,
    ) -> Option<T> {
        let mut parts = *parts;
        let (mut fewest, mut patience) = (usize::MAX, PATIENCE);
        let mut single = None;
        for turn in 0..turns {
            // Friction of an open contact begins anew where the contact closes.
            let is_open: [bool; C] = parts.each(|part| part == Part::Off);
            for (part, (kind, options)) in parts.iter_mut().zip(S::ROWS.iter().zip(options)) {
                if let Row::Friction { normal: Some(normal), .. } = kind
                    && is_open.get(*normal) == Some(&true)
                {
                    *part = options.first();
                }
            }
            let (found, faults, multipliers) = examine(&parts)?;
            let faults = || (0..C).filter(|&row| faults.get(row) == Some(&true));
            let count = faults().count();
            if count == 0 {
                return Some(found);
            }
            let mut next = parts;
            let mut change = |row: usize| {
                let turned = self.turned(row, entry_of(&parts, row), options, &multipliers);
                turned.map(|turned| put(&mut next, row, turned)).is_some()
            };
            let has_changed = if count < fewest || patience > 0 {
                patience = if count < fewest { PATIENCE } else { patience - 1 };
                (fewest, single) = (fewest.min(count), None);
                faults().filter(|&row| change(row)).count() > 0
            } else {
                // Single changes return to none of the combinations that they have left, except by roundings.
                if single == Some(parts) {
                    return None;
                }
                if turn.is_power_of_two() || single.is_none() {
                    single = Some(parts);
                }
                faults().rev().any(change)
            };
            if !has_changed {
                return None;
            }
            parts = next;
        }
        None
    }

    /// The activity that a row changes to where its own does not agree with these reactions. `None` where
    /// that is not among its options.
    fn turned(
        &self,
        row: usize,
        part: Part,
        options: &[Options; C],
        multipliers: &[S::Scalar; C],
    ) -> Option<Part> {
        let turned = match (S::ROWS.get(row)?, part) {
            (Row::Bilateral | Row::Load, Part::On) => Part::Against,
            (Row::Unilateral, Part::On) => Part::Off,
            (Row::Friction { pair, .. }, Part::On) => {
                if pair.is_none() && entry(multipliers, row).is_positive() {
                    Part::Backward
                } else {
                    Part::Forward
                }
            }
            _ => Part::On,
        };
        options.get(row)?.has(turned).then_some(turned)
    }
}

/// The activity of a row.
pub(super) fn entry_of<const C: usize>(parts: &[Part; C], row: usize) -> Part {
    parts.get(row).copied().unwrap_or(Part::Off)
}

/// Which rows are among these.
pub(super) fn marked<const C: usize>(rows: impl Iterator<Item = usize>) -> [bool; C] {
    let mut marked = [false; C];
    rows.for_each(|row| put(&mut marked, row, true));
    marked
}
