//! The values of guards at a time.

use super::super::Functions;
use super::Guard;
use crate::number::elements::Each;
use crate::number::real::{Ordered, Real, larger, smaller};

/// The parts of guards, without reactions.
pub(in crate::switching) struct Parts<T, const C: usize, const W: usize> {
    pub(in crate::switching) functions: Functions<T, C, W>,
    /// Coefficients of the friction that sticks, where slips would go backward.
    pub(in crate::switching) backward: [T; C],
}

/// Values of all guards and their sizes: bounds of their rounding errors, in ε.
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

/// Parts of a step at which a guard without a polynomial is looked at after its start: multiples of the
/// golden ratio, where no oscillation repeats itself.
pub(in crate::switching) const PLACES: [f64; 8] =
    [0.090_17, 0.236_07, 0.381_97, 0.527_86, 0.618_03, 0.763_93, 0.854_1, 1.0];

/// Whether a guard is so far from zero on a part of the step that it would not come to zero in many such
/// parts: further than 64 times all that it changes.
#[cold]
pub(in crate::switching) fn is_clear<R: Ordered>(mut value: impl FnMut(R) -> R) -> bool {
    let first = value(R::zero());
    let values = PLACES.each(|place| value(R::from_f64(place)));
    let (least, most) = (values.into_iter().fold(first, smaller), values.into_iter().fold(first, larger));
    least > R::from_f64(64.0) * (most - least) && [first].iter().chain(&values).all(|value| value.is_finite())
}
