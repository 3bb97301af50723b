//! The guards that are watched.

use super::super::{Row, Switching, Wanted};
use super::{Guard, Guards};
use crate::number::real::{Ordered, Real};

/// The guards that are watched in a regime.
#[derive(Clone, Copy, Debug)]
pub(in crate::switching) struct Watch<R, const C: usize, const W: usize> {
    /// Rows that have a guard.
    pub(super) rows: [bool; C],
    /// Slip velocities in two directions where the step starts. A slip that has a part in the same direction
    /// has not turned back.
    pub(super) directions: [R; C],
    /// Kinks that are watched.
    pub(super) kinks: [bool; W],
    /// Kinks that the motion has crossed where the step starts. Their guards are zero there: another kink may
    /// be crossed at the same time, so that roundings are all that is left of them.
    crossed: [bool; W],
    /// The frictions in one direction whose slips begin where the step starts, and the contacts that open
    /// there.
    begins: [bool; C],
    /// Rows and kinks whose guards are sampled, without a series that converges on the step.
    sampled: ([bool; C], [bool; W]),
}

impl<R: Real, const C: usize, const W: usize> Watch<R, C, W> {
    /// All kinks are watched and no row yet, by samples or not.
    pub(super) fn new(by_samples: bool) -> Self {
        let sampled = ([by_samples; C], [by_samples; W]);
        Self {
            rows: [false; C],
            directions: [R::zero(); C],
            kinks: [true; W],
            crossed: [false; W],
            begins: [false; C],
            sampled,
        }
    }

    /// Whether a guard is sampled.
    pub(super) fn is_sampled(&self, guard: Guard) -> bool {
        let sampled = match guard {
            Guard::Row(row) => self.sampled.0.get(row),
            Guard::Kink(kink) => self.sampled.1.get(kink),
        };
        sampled == Some(&true)
    }

    /// Whether a guard is watched.
    pub(super) fn has(&self, guard: Guard) -> bool {
        let watched = match guard {
            Guard::Row(row) => self.rows.get(row),
            Guard::Kink(kink) => self.kinks.get(kink),
        };
        watched == Some(&true)
    }

    /// The same, to be changed.
    fn of(&mut self, guard: Guard) -> Option<&mut bool> {
        match guard {
            Guard::Row(row) => self.rows.get_mut(row),
            Guard::Kink(kink) => self.kinks.get_mut(kink),
        }
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Guards<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// Whether a guard is the gap of an open contact.
    pub(in crate::switching) fn is_gap(&self, guard: Guard) -> bool {
        matches!(guard, Guard::Row(row)
            if S::ROWS.get(row) == Some(&Row::Unilateral) && self.regime.active.get(row) == Some(&false))
    }

    /// Whether a guard is watched.
    pub(in crate::switching) fn has(&self, guard: Guard) -> bool {
        self.watch.has(guard)
    }

    /// Notes the kinks that the motion has crossed where the step starts. `flips` is how often.
    pub(in crate::switching) fn cross(&mut self, flips: &[usize; W]) {
        self.watch.crossed = flips.map(|flips| flips > 0);
    }

    /// Notes the frictions in one direction whose slips begin where the step starts, and the contacts that
    /// open there.
    pub(in crate::switching) fn begins(&mut self, rows: &[bool; C]) {
        self.watch.begins = *rows;
    }

    /// Whether a guard is that of such a friction or contact.
    pub(in crate::switching) fn has_begun(&self, guard: Guard) -> bool {
        matches!(guard, Guard::Row(row) if self.watch.begins.get(row) == Some(&true))
    }

    /// Whether a guard is that of a kink that the motion has crossed where the step starts.
    pub(in crate::switching) fn has_crossed(&self, guard: Guard) -> bool {
        matches!(guard, Guard::Kink(kink) if self.watch.crossed.get(kink) == Some(&true))
    }

    /// Stops watching a guard.
    pub(in crate::switching) fn pass(&mut self, guard: Guard) {
        if let Some(is_watched) = self.watch.of(guard) {
            *is_watched = false;
        }
    }

    /// Samples a guard from now on.
    pub(in crate::switching) fn sample(&mut self, guard: Guard) {
        let sampled = match guard {
            Guard::Row(row) => self.watch.sampled.0.get_mut(row),
            Guard::Kink(kink) => self.watch.sampled.1.get_mut(kink),
        };
        if let Some(sampled) = sampled {
            *sampled = true;
        }
    }

    /// The slip velocities in two directions where the step starts.
    pub(in crate::switching) fn directions(&self) -> &[S::Scalar; C] {
        &self.watch.directions
    }

    /// The same with one of its guards alone.
    pub(in crate::switching) fn only(&self, guard: Guard) -> Self {
        let mut watch = Watch { rows: [false; C], kinks: [false; W], ..self.watch };
        if let Some(is_watched) = watch.of(guard) {
            *is_watched = true;
        }
        Self { watch, ..*self }
    }

    /// The functions that the watched guards are made of.
    pub(super) fn wanted(&self) -> Wanted<C, W> {
        let mut wanted = Wanted { rows: [false; C], fixed: [false; C], kinks: self.watch.kinks };
        for row in (0..C).filter(|&row| self.watch.rows[row]) {
            match S::ROWS[row] {
                Row::Bilateral | Row::Load => {}
                Row::Friction { .. } if self.regime.active[row] => wanted.fixed[row] = true,
                Row::Unilateral if self.regime.active[row] => {}
                Row::Unilateral | Row::Friction { pair: None, .. } => wanted.rows[row] = true,
                Row::Friction { pair: Some(other), .. } => {
                    (wanted.rows[row], wanted.rows[other]) = (true, true);
                }
            }
        }
        wanted
    }
}
