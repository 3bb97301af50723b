//! The values of guards at a time.

use super::Guard;
use crate::number::real::Real;

/// Values of all guards and their sizes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Values<R, const C: usize, const W: usize> {
    pub rows: [R; C],
    pub row_sizes: [R; C],
    pub kinks: [R; W],
    pub kink_sizes: [R; W],
}

impl<R: Real, const C: usize, const W: usize> Values<R, C, W> {
    pub const fn of(zero: R) -> Self {
        Self { rows: [zero; C], row_sizes: [zero; C], kinks: [zero; W], kink_sizes: [zero; W] }
    }

    pub fn get(&self, guard: Guard) -> (R, R) {
        let (value, size) = match guard {
            Guard::Row(row) => (self.rows.get(row), self.row_sizes.get(row)),
            Guard::Kink(kink) => (self.kinks.get(kink), self.kink_sizes.get(kink)),
        };
        (value.copied().unwrap_or(R::one()), size.copied().unwrap_or(R::zero()))
    }
}
