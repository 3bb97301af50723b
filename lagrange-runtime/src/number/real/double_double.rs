//! A scalar of twice the digits: the unevaluated sum of two doubles.
//!
//! T. J. Dekker, *A floating-point technique for extending the available precision*, Numer. Math. 18 (1971)
//! 224; the algorithms with proven errors are those of M. Joldes, J.-M. Muller, V. Popescu, *Tight and
//! rigorous error bounds for basic building blocks of double-word arithmetic*, ACM Trans. Math. Softw. 44
//! (2017) 15. With u = 2⁻⁵³, sums are right to 3u² ≈ 4e-32 of the result, however much cancels, products to
//! 5u², quotients to 15u², roots to 4u².
//!
//! Infinities and NaN behave as those of `f64`: the low part of a number that is not finite is zero.

use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

use super::Real;

mod angle;
mod arithmetic;
mod circular;
mod decimal;
mod exponential;
mod integer;
mod power;

use arithmetic::{fast_two_sum, two_sum};
pub use decimal::ParseError;

/// A real number with 31 decimal digits in the range of `f64`: the sum of two doubles that do not overlap.
///
/// As the scalar of a system (`impl<R: Real> … `) it gives the motion with twice the digits of `f64`, at 10
/// to 30 times the cost. Literals of a description are exact to all its digits. Parameters are what they are
/// made from:
///
/// ```
/// use lagrange_runtime::DoubleDouble;
///
/// // One tenth to 31 digits, and the double that is nearest to one tenth.
/// let (decimal, double): (DoubleDouble, _) = ("0.1".parse().unwrap(), DoubleDouble::from(0.1));
/// assert_eq!(decimal, DoubleDouble::from(1.0) / DoubleDouble::from(10.0));
/// assert_eq!(format!("{double}"), "0.1000000000000000055511151231258");
/// ```
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub struct DoubleDouble {
    /// The nearest double.
    high: f64,
    /// The double nearest to the remainder; zero where `high` is not finite.
    low: f64,
}

impl DoubleDouble {
    /// π.
    pub const PI: Self = Self::constant(core::f64::consts::PI, 1.2246467991473532e-16);

    const ZERO: Self = Self::constant(0.0, 0.0);
    const ONE: Self = Self::constant(1.0, 0.0);
    const LN_2: Self = Self::constant(core::f64::consts::LN_2, 2.3190468138462996e-17);
    const FRAC_PI_2: Self = Self::constant(core::f64::consts::FRAC_PI_2, 6.123233995736766e-17);

    const fn constant(high: f64, low: f64) -> Self {
        Self { high, low }
    }

    /// The sum of two doubles: exact where both parts of the result are in the range of `f64`.
    #[inline]
    #[must_use]
    pub fn from_sum(a: f64, b: f64) -> Self {
        two_sum(a, b).or(a + b)
    }

    /// The nearest double.
    #[inline]
    #[must_use]
    pub fn high(self) -> f64 {
        self.high
    }

    /// The remainder beside the nearest double, to the nearest double.
    #[inline]
    #[must_use]
    pub fn low(self) -> f64 {
        self.low
    }

    /// The number itself where both parts are finite, else `rough`, its value in the arithmetic of `f64`.
    #[inline(always)]
    fn or(self, rough: f64) -> Self {
        if self.low.is_finite() && self.high.is_finite() { self } else { Self::constant(rough, 0.0) }
    }

    /// Times a power of two: exact but for underflow.
    #[inline]
    fn scaled(self, power: f64) -> Self {
        Self::constant(self.high * power, self.low * power).or(self.high * power)
    }
}

impl From<f64> for DoubleDouble {
    #[inline]
    fn from(value: f64) -> Self {
        Self::constant(value, 0.0)
    }
}

impl From<f32> for DoubleDouble {
    #[inline]
    fn from(value: f32) -> Self {
        Self::from(f64::from(value))
    }
}

impl From<i32> for DoubleDouble {
    #[inline]
    fn from(value: i32) -> Self {
        Self::from(f64::from(value))
    }
}

macro_rules! operators {
    ($($trait:ident $function:ident $assign:ident $assign_function:ident;)*) => {$(
        impl $trait for DoubleDouble {
            type Output = Self;

            #[inline]
            fn $function(self, other: Self) -> Self {
                arithmetic::$function(self, other)
            }
        }

        impl $assign for DoubleDouble {
            #[inline]
            fn $assign_function(&mut self, other: Self) {
                *self = arithmetic::$function(*self, other);
            }
        }
    )*};
}

operators! {
    Add add AddAssign add_assign;
    Sub sub SubAssign sub_assign;
    Mul mul MulAssign mul_assign;
    Div div DivAssign div_assign;
}

impl Neg for DoubleDouble {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self::constant(-self.high, -self.low)
    }
}

impl Zero for DoubleDouble {
    #[inline]
    fn zero() -> Self {
        Self::ZERO
    }

    #[inline]
    fn is_zero(&self) -> bool {
        self.high == 0.0
    }
}

impl One for DoubleDouble {
    #[inline]
    fn one() -> Self {
        Self::ONE
    }
}

impl Sum for DoubleDouble {
    #[inline]
    fn sum<I: Iterator<Item = Self>>(items: I) -> Self {
        items.fold(Self::ZERO, Add::add)
    }
}

/// Forwards functions of `Real` to those of a module.
macro_rules! forward {
    ($module:ident: $($name:ident($($arg:ident),*) -> $out:ty;)*) => {$(
        #[inline]
        fn $name(self $(, $arg: Self)*) -> $out {
            $module::$name(self $(, $arg)*)
        }
    )*};
}

impl Real for DoubleDouble {
    type Lane = Self;

    #[inline]
    fn splat(lane: Self) -> Self {
        lane
    }

    #[inline]
    fn largest(self) -> Self {
        self
    }

    #[inline]
    fn from_f64(literal: f64) -> Self {
        Self::from(literal)
    }

    #[inline]
    fn from_parts(high: f64, low: f64) -> Self {
        fast_two_sum(high, low).or(high)
    }

    #[inline]
    fn pi() -> Self {
        Self::PI
    }

    #[inline]
    fn abs(self) -> Self {
        if self.high.is_sign_negative() { -self } else { self }
    }

    #[inline]
    fn binade(self) -> Self {
        Self::from(self.high.binade())
    }

    #[inline]
    fn signum(self) -> Self {
        Self::from(self.high.signum())
    }

    /// 2⁻¹⁰⁴ = 4u², about the error of a single operation (u = 2⁻⁵³).
    #[inline]
    fn epsilon() -> Self {
        Self::from(f64::EPSILON * f64::EPSILON)
    }

    #[inline]
    fn is_finite(self) -> bool {
        self.high.is_finite()
    }

    #[inline]
    fn is_positive(self) -> bool {
        self.high > 0.0
    }

    #[inline]
    fn max(self, other: Self) -> Self {
        if self >= other || other.high.is_nan() { self } else { other }
    }

    #[inline]
    fn min(self, other: Self) -> Self {
        if self <= other || other.high.is_nan() { self } else { other }
    }

    #[inline]
    fn powi(self, exponent: i32) -> Self {
        power::powi(self, exponent)
    }

    forward! { arithmetic: sqrt() -> Self; mul_add(factor, summand) -> Self; cbrt() -> Self; hypot(other) -> Self; }
    forward! { circular: sin_cos() -> (Self, Self); atan2(x) -> Self; }
    forward! { exponential:
        exp() -> Self; exp_m1() -> Self; ln() -> Self; ln_1p() -> Self; powf(exponent) -> Self;
        sinh() -> Self; cosh() -> Self; asinh() -> Self; acosh() -> Self; atanh() -> Self;
    }
}

#[cfg(test)]
mod tests;
