//! The values of guards at a time.

use super::super::Functions;
use super::Guard;
use crate::number::real::Real;

/// The parts of guards, without reactions.
pub(in crate::switching) struct Parts<T, const C: usize, const W: usize> {
    pub(in crate::switching) functions: Functions<T, C, W>,
    /// Coefficients of the friction that sticks, where slips would go backward.
    pub(in crate::switching) backward: [T; C],
}

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

    pub fn set_row(&mut self, row: usize, (value, size): (R, R)) {
        if let (Some(own), Some(own_size)) = (self.rows.get_mut(row), self.row_sizes.get_mut(row)) {
            (*own, *own_size) = (value, size);
        }
    }

    pub fn set_kink(&mut self, kink: usize, (value, size): (R, R)) {
        if let (Some(own), Some(own_size)) = (self.kinks.get_mut(kink), self.kink_sizes.get_mut(kink)) {
            (*own, *own_size) = (value, size);
        }
    }

    pub fn get(&self, guard: Guard) -> (R, R) {
        let (value, size) = match guard {
            Guard::Row(row) => (self.rows.get(row), self.row_sizes.get(row)),
            Guard::Kink(kink) => (self.kinks.get(kink), self.kink_sizes.get(kink)),
        };
        (value.copied().unwrap_or(R::one()), size.copied().unwrap_or(R::zero()))
    }
}
