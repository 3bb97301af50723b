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
//! same way. What is found is examined like every other combination.

use super::choice::{Choice, is_limit};
use super::scene::{Scene, entry, put};
use super::trials::{COMBINATIONS, Options, Part, regime, thresholds};
use super::{Row, Switching};
use crate::number::elements::Each;
use crate::number::real::Real;

/// The turns without fewer faults after which single rows change, as Júdice and Pires have it.
const PATIENCE: usize = 10;

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
    ) -> Option<(Choice<S::Scalar, N, C, W>, S::Scalar)> {
        thresholds().into_iter().find_map(|part| Some((self.pivot(options, part, decided)?, part)))
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
            self.differs(chosen, &self.pivot(&other, part, decided)?)
        })
    }

    /// The same up to one part, from the first activity of each row.
    fn pivot(
        &self,
        options: &[Options; C],
        part: S::Scalar,
        decided: Option<usize>,
    ) -> Option<Choice<S::Scalar, N, C, W>> {
        let mut parts = options.each(|options| options.first());
        let (mut fewest, mut patience) = (usize::MAX, PATIENCE);
        let mut single = None;
        for turn in 0..COMBINATIONS {
            // Friction of an open contact begins anew where the contact closes.
            let is_open: [bool; C] = parts.each(|part| part == Part::Off);
            for (part, (kind, options)) in parts.iter_mut().zip(S::ROWS.iter().zip(options)) {
                if let Row::Friction { normal: Some(normal), .. } = kind
                    && is_open.get(*normal) == Some(&true)
                {
                    *part = options.first();
                }
            }
            let regime = regime(&S::ROWS, &parts, options, &[false; C], self.kinks)?;
            let trial = self.trial(regime)?;
            let faults = || self.faults(&parts, &trial, part, decided);
            let count = faults().count();
            if count == 0 {
                return Some(trial);
            }
            let mut next = parts;
            let mut change = |row: usize| {
                let turned = self.turned(row, entry_of(&parts, row), options, &trial.multipliers);
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
                let mut last = [None; C];
                for (last, row) in last.iter_mut().zip(faults()) {
                    *last = Some(row);
                }
                last.into_iter().rev().flatten().any(change)
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
fn entry_of<const C: usize>(parts: &[Part; C], row: usize) -> Part {
    parts.get(row).copied().unwrap_or(Part::Off)
}
