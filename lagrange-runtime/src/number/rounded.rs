//! [`Rounded`]: a number with a bound of its error.
//!
//! Errors are followed from operation to operation, to first order (Higham, *Accuracy and Stability of
//! Numerical Algorithms*, 3.3). In products and quotients they are followed exactly, since a factor may be
//! nothing but a rounding error, and a denominator little more than its own.

use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

use super::real::{Ordered, Real, smaller};

/// A number and a bound of its error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rounded<R> {
    pub(crate) value: R,
    pub(crate) error: R,
}

impl<R: Ordered> Rounded<R> {
    /// A number as it is.
    #[inline]
    pub(crate) fn exact(value: R) -> Self {
        Self { value, error: R::zero() }
    }

    /// A function of this number, with this value and slope here.
    fn through(self, value: R, slope: R) -> Self {
        Self { value, error: slope.abs() * self.error + R::epsilon() * value.abs() }
    }

    fn plus(self, other: Self, value: R) -> Self {
        Self { value, error: self.error + other.error + R::epsilon() * value.abs() }
    }
}

impl<R: Ordered> PartialEq for Rounded<R> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<R: Ordered> Add for Rounded<R> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.plus(other, self.value + other.value)
    }
}

impl<R: Ordered> Sub for Rounded<R> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.plus(other, self.value - other.value)
    }
}

impl<R: Ordered> Mul for Rounded<R> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b, value) = (self.value.abs(), other.value.abs(), self.value * other.value);
        let carried = self.error * b + (a + self.error) * other.error;
        Self { value, error: carried + R::epsilon() * value.abs() }
    }
}

impl<R: Ordered> Div for Rounded<R> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Mul::mul(self, other.recip())
    }
}

impl<R: Ordered> Neg for Rounded<R> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

macro_rules! assign {
    ($($trait:ident $method:ident $operator:tt;)*) => {$(
        impl<R: Ordered> $trait for Rounded<R> {
            fn $method(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )*};
}

assign! { AddAssign add_assign +; SubAssign sub_assign -; MulAssign mul_assign *; DivAssign div_assign /; }

impl<R: Ordered> Sum for Rounded<R> {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::zero(), |sum, term| sum + term)
    }
}

impl<R: Ordered> Zero for Rounded<R> {
    fn zero() -> Self {
        Self::exact(R::zero())
    }
    fn is_zero(&self) -> bool {
        self.value.is_zero()
    }
}

impl<R: Ordered> One for Rounded<R> {
    fn one() -> Self {
        Self::exact(R::one())
    }
}

impl<R: Ordered> Real for Rounded<R> {
    type Lane = R::Lane;

    fn splat(lane: R::Lane) -> Self {
        Self::exact(R::splat(lane))
    }
    fn largest(self) -> R::Lane {
        self.value.largest()
    }
    fn from_f64(literal: f64) -> Self {
        Self::exact(R::from_f64(literal))
    }
    fn from_parts(high: f64, low: f64) -> Self {
        Self::exact(R::from_parts(high, low))
    }
    fn epsilon() -> Self {
        Self::exact(R::epsilon())
    }
    fn is_finite(self) -> bool {
        self.value.is_finite()
    }
    fn is_positive(self) -> bool {
        self.value.is_positive()
    }
    fn signum(self) -> Self {
        Self::exact(self.value.signum())
    }
    fn abs(self) -> Self {
        Self { value: self.value.abs(), ..self }
    }
    fn recip(self) -> Self {
        let value = self.value.recip();
        // |1 / (v ± e) − 1 / v| ≤ e / (|v| (|v| − e)). Where v may be zero there is no bound.
        let least = self.value.abs() - self.error;
        let slope = if least.is_positive() { value / least } else { R::from_f64(f64::INFINITY) };
        self.through(value, slope)
    }
    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        // |√(v ± e) − √v| ≤ √e, which is the smaller bound where v is no more than a rounding error.
        let by_slope = R::from_f64(0.5) * self.error / value;
        Self { value, error: smaller(by_slope, self.error.sqrt()) + R::epsilon() * value }
    }
    fn cbrt(self) -> Self {
        let value = self.value.cbrt();
        self.through(value, value / (R::from_f64(3.0) * self.value))
    }
    fn powf(self, exponent: Self) -> Self {
        let value = self.value.powf(exponent.value);
        let by_base = self.through(value, exponent.value * value / self.value);
        let by_exponent = if exponent.error.is_zero() {
            R::zero()
        } else {
            (value * self.value.ln()).abs() * exponent.error
        };
        Self { error: by_base.error + by_exponent, ..by_base }
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.through(sin, cos), self.through(cos, sin))
    }
    fn sinh(self) -> Self {
        self.through(self.value.sinh(), self.value.cosh())
    }
    fn cosh(self) -> Self {
        self.through(self.value.cosh(), self.value.sinh())
    }
    fn tanh(self) -> Self {
        let decay = self.value.sech();
        self.through(self.value.tanh(), decay * decay)
    }
    fn sech(self) -> Self {
        let value = self.value.sech();
        self.through(value, value)
    }
    fn logistic(self) -> Self {
        let value = self.value.logistic();
        self.through(value, value * (-self.value).logistic())
    }
    fn exp(self) -> Self {
        let value = self.value.exp();
        self.through(value, value)
    }
    fn exp_m1(self) -> Self {
        self.through(self.value.exp_m1(), self.value.exp())
    }
    fn ln(self) -> Self {
        self.through(self.value.ln(), self.value.recip())
    }
    fn ln_1p(self) -> Self {
        self.through(self.value.ln_1p(), (R::one() + self.value).recip())
    }
    fn atan2(self, x: Self) -> Self {
        let (a, b) = (self.value, x.value);
        let weight = (a * a + b * b).recip();
        let angle = self.through(a.atan2(b), b * weight);
        Self { error: angle.error + (a * weight).abs() * x.error, ..angle }
    }
    fn atan(self) -> Self {
        self.through(self.value.atan(), (R::one() + self.value * self.value).recip())
    }
    fn asin(self) -> Self {
        self.through(self.value.asin(), self.of_circle())
    }
    fn acos(self) -> Self {
        self.through(self.value.acos(), self.of_circle())
    }
    fn asinh(self) -> Self {
        self.through(self.value.asinh(), (R::one() + self.value * self.value).sqrt().recip())
    }
    fn acosh(self) -> Self {
        let square = (self.value - R::one()) * (self.value + R::one());
        self.through(self.value.acosh(), square.sqrt().recip())
    }
    fn atanh(self) -> Self {
        let square = (R::one() - self.value) * (R::one() + self.value);
        self.through(self.value.atanh(), square.recip())
    }
}

impl<R: Ordered> Rounded<R> {
    /// The slope of the inverse of the sine.
    fn of_circle(self) -> R {
        ((R::one() - self.value) * (R::one() + self.value)).sqrt().recip()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A function, and the same of plain numbers.
    type Case = (&'static str, fn(Rounded<f64>, Rounded<f64>) -> Rounded<f64>, fn(f64, f64) -> f64);

    /// The values of a function of numbers within their errors are within the error of its value, which is at
    /// most a few times larger.
    #[test]
    fn errors_are_those_that_a_function_makes() {
        let cases: [Case; 29] = [
            ("sum", |x, y| x + y, |x, y| x + y),
            ("difference", |x, y| x - y, |x, y| x - y),
            ("product", |x, y| x * y, |x, y| x * y),
            ("quotient", |x, y| x / y, |x, y| x / y),
            ("sin", |x, _| x.sin(), |x, _| x.sin()),
            ("cos", |x, _| x.cos(), |x, _| x.cos()),
            ("tan", |x, _| x.tan(), |x, _| x.tan()),
            ("asin", |x, _| x.asin(), |x, _| x.asin()),
            ("acos", |x, _| x.acos(), |x, _| x.acos()),
            ("atan", |x, _| x.atan(), |x, _| x.atan()),
            ("atan2", |x, y| x.atan2(y), |x, y| x.atan2(y)),
            ("sinh", |x, _| x.sinh(), |x, _| x.sinh()),
            ("cosh", |x, _| x.cosh(), |x, _| x.cosh()),
            ("tanh", |x, _| x.tanh(), |x, _| x.tanh()),
            ("sech", |x, _| x.sech(), |x, _| x.cosh().recip()),
            ("logistic", |x, _| x.logistic(), |x, _| ((-x).exp() + 1.0).recip()),
            ("asinh", |x, _| x.asinh(), |x, _| x.asinh()),
            ("acosh", |_, y| y.acosh(), |_, y| y.acosh()),
            ("atanh", |x, _| x.atanh(), |x, _| x.atanh()),
            ("exp", |x, _| x.exp(), |x, _| x.exp()),
            ("exp_m1", |x, _| x.exp_m1(), |x, _| x.exp_m1()),
            ("ln", |x, _| x.ln(), |x, _| x.ln()),
            ("ln_1p", |x, _| x.ln_1p(), |x, _| x.ln_1p()),
            ("sqrt", |x, _| x.sqrt(), |x, _| x.sqrt()),
            ("cbrt", |x, _| (-x).cbrt(), |x, _| (-x).cbrt()),
            ("powf", |x, y| x.powf(y), f64::powf),
            ("powi", |x, _| x.powi(-3), |x, _| x.powi(-3)),
            ("hypot", |x, y| x.hypot(y), f64::hypot),
            ("abs", |x, _| (-x).abs(), |x, _| x),
        ];
        let number = |value| Rounded { value, error: 1e-9 };
        for (name, rounded, function) in cases {
            let found = rounded(number(0.4), number(2.0));
            let mut furthest: f64 = 0.0;
            for (x, y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                let other = function(0.4 + 1e-9 * x, 2.0 + 1e-9 * y);
                furthest = furthest.max((other - found.value).abs());
            }
            let (least, most) = (furthest * (1.0 - 1e-6), 4.0 * furthest);
            assert!(found.error >= least && found.error <= most, "{name}: {} {furthest}", found.error);
        }
    }

    #[test]
    fn a_root_of_roundings_is_known_by_their_root() {
        assert!((Rounded { value: 0.0, error: 1e-16 }.sqrt().error - 1e-8_f64).abs() < 1e-20);
    }

    #[test]
    fn a_quotient_has_a_bound_as_long_as_its_denominator_is_no_zero() {
        let over = |error| Rounded::exact(3.0) / Rounded { value: 2.0, error };
        for error in [0.1, 1.0, 1.9] {
            let furthest = 3.0 / (2.0 - error) - 1.5;
            let bound = over(error).error;
            assert!((bound / furthest - 1.0).abs() < 1e-12, "{error}: {bound} {furthest}");
        }
        for error in [2.0, 3.0] {
            assert_eq!(over(error).error, f64::INFINITY);
        }
    }

    #[test]
    fn what_is_exact_has_the_roundings_of_operations_alone() {
        let sum = Rounded::exact(1.0) + Rounded::exact(2.0);
        assert!(sum.error <= 3.0 * f64::EPSILON && sum.error > 0.0);
    }
}
