//! [`Taylor`]: a polynomial in the part of a step that has passed, with the bound of its error.
//!
//! With θ from 0 to 1 the sum of the magnitudes of all coefficients bounds a polynomial on the whole of its
//! interval.

use core::cell::Cell;

use super::HIGHEST;
use crate::number::real::{Ordered, Real};

/// The number of coefficients.
pub(crate) const TERMS: usize = HIGHEST + 1;

/// A polynomial Σ cₖ θᵏ on θ in \[0, 1].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Taylor<R> {
    pub(crate) coefficients: [R; TERMS],
    /// The order of the highest coefficient that is not known to be zero.
    pub(crate) degree: usize,
    /// The bound of the error on the interval. Sums, multiples and products leave it to the caller.
    pub(crate) error: R,
}

impl<R: Ordered> Taylor<R> {
    /// A number that does not change.
    #[inline]
    pub(crate) fn constant(value: R) -> Self {
        let mut coefficients = [R::zero(); TERMS];
        coefficients[0] = value;
        Self { coefficients, degree: 0, error: R::zero() }
    }

    /// With these terms, that of order zero first.
    #[inline]
    pub(crate) fn of(terms: impl Iterator<Item = R>) -> Self {
        let mut this = Self::constant(R::zero());
        for (to, term) in this.coefficients.iter_mut().zip(terms) {
            *to = term;
            this.degree += 1;
        }
        while this.degree > 0 && this.coefficients.get(this.degree).is_none_or(|term| term.is_zero()) {
            this.degree -= 1;
        }
        this
    }

    /// The coefficients up to the degree.
    #[inline]
    pub(crate) fn terms(&self) -> &[R] {
        self.coefficients.get(..=self.degree).unwrap_or_default()
    }

    /// A bound of the magnitude on the interval.
    #[inline]
    pub(crate) fn extent(&self) -> R {
        sum(self.terms(), Real::abs)
    }

    /// The value at the start.
    #[inline]
    pub(crate) fn start(&self) -> R {
        self.coefficients[0]
    }

    /// The value at the end.
    #[inline]
    pub(crate) fn end(&self) -> R {
        sum(self.terms(), |term| term)
    }

    /// A lower bound of the gain since the start.
    #[inline]
    pub(crate) fn down(&self) -> R {
        sum(self.terms().get(1..).unwrap_or_default(), |term| if term < R::zero() { term } else { R::zero() })
    }

    /// The polynomial on the part of the interval that begins at `from` and is `width` long.
    pub(crate) fn on(mut self, from: R, width: R) -> Self {
        if from.is_zero() && width == R::one() {
            return self;
        }
        shift(self.coefficients.get_mut(..=self.degree).unwrap_or_default(), from, width);
        self
    }

    /// The value where a part of the interval has passed.
    pub(crate) fn at(&self, place: R) -> R {
        self.terms().iter().rev().fold(R::zero(), |sum, &term| R::mul_add(sum, place, term))
    }

    /// The polynomial to a lower degree: the magnitudes of other terms are errors.
    #[inline]
    pub(crate) fn shortened(mut self, degree: usize) -> Self {
        if degree < self.degree {
            self.error += sum(self.terms().get(degree + 1..).unwrap_or_default(), Real::abs);
            self.degree = degree;
        }
        self
    }

    /// A multiple.
    #[inline]
    pub(crate) fn scaled(mut self, factor: R) -> Self {
        for term in self.coefficients.iter_mut().take(self.degree + 1) {
            *term *= factor;
        }
        self
    }

    /// The sum with a multiple of another one.
    #[inline]
    pub(crate) fn plus(mut self, factor: R, other: &Self) -> Self {
        for (to, &term) in self.coefficients.iter_mut().zip(other.terms()) {
            *to = R::mul_add(factor, term, *to);
        }
        self.degree = self.degree.max(other.degree);
        self
    }

    /// The product, with so many terms at most.
    pub(crate) fn times(&self, other: &Self, terms: usize) -> Self {
        let mut product = Self::constant(R::zero());
        product.degree = (self.degree + other.degree).min(terms.saturating_sub(1)).min(TERMS - 1);
        let known = product.coefficients.get_mut(..=product.degree).unwrap_or_default();
        for (i, &a) in self.terms().iter().enumerate() {
            let places = known.get_mut(i..).unwrap_or_default();
            for (to, &b) in places.iter_mut().zip(other.terms()) {
                *to = R::mul_add(a, b, *to);
            }
        }
        product
    }
}

/// The powers of a number, from that of order zero on: even and odd ones side by side, neither of which waits
/// for the other.
#[inline]
pub(crate) fn powers<R: Real>(base: R) -> impl Iterator<Item = R> {
    let (square, mut next) = (base * base, [R::one(), base]);
    core::iter::from_fn(move || {
        let power = next[0];
        next = [next[1], power * square];
        Some(power)
    })
}

/// A sum over terms, by four sums that do not wait for each other.
#[inline]
fn sum<R: Real>(terms: &[R], part: impl Fn(R) -> R) -> R {
    let (groups, rest) = terms.as_chunks::<4>();
    let mut sums = [R::zero(); 4];
    for group in groups {
        for (sum, &term) in sums.iter_mut().zip(group) {
            *sum += part(term);
        }
    }
    let rest = rest.iter().fold(R::zero(), |sum, &term| sum + part(term));
    let [a, b, c, d] = sums;
    (a + c) + (b + d) + rest
}

/// Turns coefficients of powers of the argument into those on the interval that begins at `from` and is
/// `width` long. Each pass of Horner's rule takes up one more power, and the sums of a pass do not wait for
/// each other.
pub(crate) fn shift<R: Real>(coefficients: &mut [R], from: R, width: R) {
    if !from.is_zero() {
        for first in (0..coefficients.len().saturating_sub(1)).rev() {
            // The known terms begin behind `first`; times the argument they begin there.
            let known = Cell::from_mut(coefficients.get_mut(first..).unwrap_or_default()).as_slice_of_cells();
            for (low, high) in known.iter().zip(known.iter().skip(1)) {
                low.set(R::mul_add(from, high.get(), low.get()));
            }
        }
    }
    let mut power = R::one();
    for term in coefficients {
        *term *= power;
        power *= width;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shifted_polynomial_is_the_same_one() {
        let x = Taylor::of((0..20).map(|order| 0.7_f64.powi(order) - 0.4));
        let part = x.on(0.25, 0.5);
        for theta in [0.0, 0.4, 1.0] {
            assert!((part.at(theta) - x.at(0.25 + 0.5 * theta)).abs() < 1e-15);
        }
    }

    #[test]
    fn a_product_has_the_values_of_the_product() {
        let [x, y] = [0.3, -0.8].map(|base: f64| Taylor::of((0..9).map(|order| base.powi(order))));
        let product = x.times(&y, TERMS);
        assert_eq!((product.degree, x.times(&y, 12).degree), (16, 11));
        for theta in [0.0, 0.4, 1.0] {
            assert!((product.at(theta) - x.at(theta) * y.at(theta)).abs() < 1e-15);
        }
    }
}
