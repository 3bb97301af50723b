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

/// The most evaluations of all guards that are kept: those of a polynomial of degree 16, and those that test
/// it.
const KEPT: usize = 24;

/// Values at the places of a part of the step that have been looked at.
pub(super) struct Seen<R, const C: usize, const W: usize> {
    kept: [(R, Values<R, C, W>); KEPT],
    count: usize,
}

impl<R: Real, const C: usize, const W: usize> Seen<R, C, W> {
    pub fn new() -> Self {
        Self { kept: [(R::zero(), Values::of(R::zero())); KEPT], count: 0 }
    }

    /// The values at a place. `look` computes them, where it has not been asked before.
    // One copy for all searches: they are many, and `look` is large.
    #[inline(never)]
    pub fn at(&mut self, place: R, look: &mut impl FnMut(R) -> Values<R, C, W>) -> Values<R, C, W> {
        if let Some((_, values)) = self.kept.iter().take(self.count).find(|(at, _)| *at == place) {
            return *values;
        }
        let values = look(place);
        if let Some(free) = self.kept.get_mut(self.count) {
            *free = (place, values);
            self.count += 1;
        }
        values
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
