//! [`Taylor`]: numbers that are polynomials in the part of a step that has passed, with the bound of their
//! roundings.
//!
//! Along the polynomial of a step every smooth function of the state is one again, and the same code that
//! gives its value gives its coefficients. The recurrences are those of Knuth, *The Art of Computer
//! Programming* 2, 4.7, and Griewank and Walther, *Evaluating Derivatives*, 13.2.
//!
//! With θ from 0 to 1 the sum of the magnitudes of all coefficients bounds a polynomial on the whole of its
//! interval. In that norm roundings are followed from operation to operation, to first order (Higham,
//! *Accuracy and Stability of Numerical Algorithms*, 3.3); in products to second, since a factor may be
//! nothing but roundings.

mod functions;
mod state;

use core::cell::Cell;
use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

use super::HIGHEST;
use crate::number::real::{Ordered, Real};

/// The number of coefficients.
pub(crate) const TERMS: usize = HIGHEST + 1;

/// The number of coefficients of a first look. What it leaves out of a variable counts as roundings do; at
/// the end of a step it is small beside the rest, as a rule.
pub(crate) const FEW: usize = HIGHEST / 4 + 1;

/// The number of coefficients of the very first: what keeps far from zero needs no more.
pub(crate) const LEAST: usize = 3;

/// A number known by its value alone, and the bound of its roundings.
pub(crate) type Rounded<R> = Taylor<R, 1>;

/// A polynomial Σ cₖ θᵏ on θ in \[0, 1] with so many coefficients at most.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Taylor<R, const T: usize = TERMS> {
    pub(crate) coefficients: [R; T],
    /// The highest coefficient that is not known to be zero.
    pub(crate) degree: usize,
    /// The order to which functions are expanded.
    orders: usize,
    /// The bound of the roundings on the interval.
    pub(crate) error: R,
    /// Whether no term beyond these has been left away, but for what the error bounds.
    pub(crate) is_whole: bool,
}

impl<R: Ordered, const T: usize> Taylor<R, T> {
    /// Whether what is left away is bounded: of a first look. Others are taken where it is less than
    /// roundings.
    const IS_BOUND: bool = T > 1 && T < TERMS;

    /// A number that does not change.
    #[inline]
    pub(crate) fn constant(value: R) -> Self {
        let mut coefficients = [R::zero(); T];
        if let Some(first) = coefficients.first_mut() {
            *first = value;
        }
        Self { coefficients, degree: 0, orders: T.saturating_sub(1), error: R::zero(), is_whole: true }
    }

    /// A number that changes by these terms, the first of order one, in a unit with these powers. It and they
    /// are rounded; terms beyond the last coefficient count as roundings.
    #[inline]
    pub(crate) fn along(value: R, terms: impl Iterator<Item = R>, powers: &[R; TERMS]) -> Self {
        let mut variable = Self::constant(value);
        let mut terms = terms.zip(powers.iter().skip(1)).map(|(term, &power)| term * power);
        let mut degree = 0;
        for (coefficient, term) in variable.coefficients.iter_mut().skip(1).zip(&mut terms) {
            *coefficient = term;
            degree += 1;
        }
        while degree > 0 && variable.coefficients[degree].is_zero() {
            degree -= 1;
        }
        variable.degree = degree;
        // Four sums, of which none waits for another.
        let beyond = terms.fold([R::zero(); 4], |[a, b, c, d], term| [b, c, d, a + term.abs()]);
        let beyond = beyond.iter().fold(R::zero(), |sum, &part| sum + part);
        variable.error = R::epsilon() * (variable.extent() + beyond) + beyond;
        variable
    }

    /// The same in the unit `scale`.
    #[cfg(test)]
    pub(crate) fn variable(value: R, terms: impl Iterator<Item = R>, scale: R) -> Self {
        Self::along(value, terms, &powers(scale))
    }

    /// A number known by its value alone.
    #[inline]
    pub(crate) fn value(value: R) -> Self {
        Self { error: R::epsilon() * value.abs(), ..Self::constant(value) }
    }

    /// A number known by its value alone, a sum whose summands have this size.
    #[inline]
    pub(crate) fn sum_of(value: R, size: R) -> Self {
        Self { error: R::epsilon() * size, ..Self::constant(value) }
    }

    /// The same without derivatives of its numbers.
    #[inline]
    pub(crate) fn plain(&self) -> Self {
        if R::PARTS == 1 {
            return *self;
        }
        let plain = |x: R| x.part(0);
        Self { coefficients: self.coefficients.map(plain), error: plain(self.error), ..*self }
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
        self.coefficients.first().copied().unwrap_or(R::zero())
    }

    /// The value at the end.
    #[inline]
    pub(crate) fn end(&self) -> R {
        sum(self.terms(), |term| term)
    }

    /// A bound from below of what is gained since the start.
    #[inline]
    pub(crate) fn down(&self) -> R {
        sum(self.terms().get(1..).unwrap_or_default(), |term| if term < R::zero() { term } else { R::zero() })
    }

    /// The same with no more coefficients than these: what others there are counts as roundings.
    pub(crate) fn shortened<const U: usize>(longer: &Taylor<R, U>) -> Self {
        let mut short = Self::constant(R::zero());
        for (to, &term) in short.coefficients.iter_mut().zip(longer.terms()) {
            *to = term;
        }
        short.degree = longer.degree.min(short.orders);
        short.is_whole = longer.is_whole;
        short.error = longer.error + sum(longer.terms().get(T..).unwrap_or_default(), Real::abs);
        short
    }

    /// A variable on the interval from `from` that is `width` long, in units of the present one. Roundings
    /// are those of that interval: what its end does not reach has no part in them.
    pub(crate) fn on(mut self, from: R, width: R) -> Self {
        let (mut power, mut added) = (R::one(), R::one());
        self.error = R::zero();
        for &term in self.coefficients.get(..=self.degree).unwrap_or_default() {
            // Its own rounding, and one for each order that it is handed down.
            self.error += added * R::epsilon() * term.abs() * power;
            added += R::one();
            power *= from + width;
        }
        shift(self.coefficients.get_mut(..=self.degree).unwrap_or_default(), from, width);
        self
    }

    /// What two numbers have in common where they meet.
    #[inline]
    fn meeting(&self, other: &Self) -> (usize, bool) {
        (self.orders.min(other.orders), self.is_whole && other.is_whole)
    }

    #[inline]
    fn plus(mut self, other: &Self, sign: R) -> Self {
        (self.orders, self.is_whole) = self.meeting(other);
        for (to, &from) in self.coefficients.iter_mut().zip(other.terms()) {
            *to = R::mul_add(sign, from, *to);
        }
        self.degree = self.degree.max(other.degree);
        self.error += R::epsilon() * self.extent() + other.error;
        self
    }

    /// The product with a number that does not change.
    #[inline]
    fn scaled(mut self, by: &Self) -> Self {
        (self.orders, self.is_whole) = self.meeting(by);
        let (factor, extent) = (by.start(), self.extent());
        for term in self.coefficients.iter_mut().take(self.degree + 1) {
            *term *= factor;
        }
        self.error = self.error * factor.abs()
            + extent * R::epsilon() * factor.abs()
            + (extent + self.error) * by.error;
        self
    }

    /// A bound of the terms that a product leaves away.
    fn left(&self, other: &Self) -> R {
        left(self.terms(), other.terms(), T)
    }

    fn times(&self, other: &Self) -> Self {
        if other.degree == 0 {
            return self.scaled(other);
        }
        if self.degree == 0 {
            return other.scaled(self);
        }
        let (orders, are_whole) = self.meeting(other);
        let mut product = Self { orders, ..Self::constant(R::zero()) };
        product.degree = (self.degree + other.degree).min(orders);
        convolve(
            product.coefficients.get_mut(..=product.degree).unwrap_or_default(),
            self.terms(),
            other.terms(),
        );
        product.is_whole = are_whole && self.degree + other.degree <= orders;
        let (a, b) = (self.extent(), other.extent());
        let summed = R::from_f64(self.degree.min(other.degree) as f64 + 1.0);
        product.error = self.error * b + (a + self.error) * other.error + R::epsilon() * summed * a * b;
        if Self::IS_BOUND && !product.is_whole {
            product.error += self.left(other);
            product.is_whole = are_whole;
        }
        product
    }
}

/// Adds the terms of a product that fit. Numbers with more coefficients and with fewer have this
/// code in common.
#[inline(never)]
fn convolve<R: Real>(product: &mut [R], one: &[R], other: &[R]) {
    for (i, &a) in one.iter().enumerate() {
        for (to, &b) in product.get_mut(i..).unwrap_or_default().iter_mut().zip(other) {
            *to = R::mul_add(a, b, *to);
        }
    }
}

/// A bound of the terms of a product from an order on: of each factor those with which a term of the other
/// one has too high an order.
#[inline(never)]
fn left<R: Real>(one: &[R], other: &[R], beyond: usize) -> R {
    let (mut left, mut sum) = (R::zero(), R::zero());
    let mut others = other.iter().enumerate().rev().peekable();
    for (order, &term) in one.iter().enumerate() {
        while let Some((_, &next)) = others.next_if(|(other, _)| order + other >= beyond) {
            sum += next.abs();
        }
        left += term.abs() * sum;
    }
    left
}

/// The powers of a number, from that of order zero on.
#[inline]
pub(crate) fn powers<R: Real>(base: R) -> [R; TERMS] {
    let mut powers = [R::one(); TERMS];
    // Four at a time, of which none waits for another.
    let square = base * base;
    let mut group = [R::one(), base, square, square * base];
    for to in powers.chunks_mut(4) {
        for (to, power) in to.iter_mut().zip(&mut group) {
            *to = *power;
            *power *= square * square;
        }
    }
    powers
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

/// The coefficients of a polynomial on the interval from `from` that is `width` long: by Horner's rule, in
/// which those of one power of the argument do not wait for each other.
pub(crate) fn shift<R: Real>(coefficients: &mut [R], from: R, width: R) {
    if !from.is_zero() {
        for first in (0..coefficients.len().saturating_sub(1)).rev() {
            // What is known begins behind `first`; times the argument it begins there.
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

impl<R: Ordered, const T: usize> PartialEq for Taylor<R, T> {
    fn eq(&self, other: &Self) -> bool {
        self.coefficients == other.coefficients
    }
}

impl<R: Ordered, const T: usize> Add for Taylor<R, T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.plus(&other, R::one())
    }
}

impl<R: Ordered, const T: usize> Sub for Taylor<R, T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.plus(&other, -R::one())
    }
}

impl<R: Ordered, const T: usize> Mul for Taylor<R, T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.times(&other)
    }
}

impl<R: Ordered, const T: usize> Div for Taylor<R, T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.times(&other.recip())
    }
}

impl<R: Ordered, const T: usize> Neg for Taylor<R, T> {
    type Output = Self;
    fn neg(mut self) -> Self {
        for term in self.coefficients.iter_mut().take(self.degree + 1) {
            *term = -*term;
        }
        self
    }
}

macro_rules! assign {
    ($($trait:ident $method:ident $operator:tt;)*) => {$(
        impl<R: Ordered, const T: usize> $trait for Taylor<R, T> {
            fn $method(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )*};
}

assign! { AddAssign add_assign +; SubAssign sub_assign -; MulAssign mul_assign *; DivAssign div_assign /; }

impl<R: Ordered, const T: usize> Sum for Taylor<R, T> {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::zero(), |sum, term| sum + term)
    }
}

impl<R: Ordered, const T: usize> Zero for Taylor<R, T> {
    fn zero() -> Self {
        Self::constant(R::zero())
    }
    fn is_zero(&self) -> bool {
        self.terms().iter().all(|term| term.is_zero())
    }
}

impl<R: Ordered, const T: usize> One for Taylor<R, T> {
    fn one() -> Self {
        Self::constant(R::one())
    }
}

#[cfg(test)]
mod tests;
