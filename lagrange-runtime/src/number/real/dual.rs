//! [`Dual`]: numbers that carry derivatives.

use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

use super::Real;
use crate::number::elements::Each;

/// A number with its derivatives in `D` directions: value + Σ slopeᵢ εᵢ with εᵢ εⱼ = 0 (forward accumulation;
/// Griewank and Walther, *Evaluating Derivatives*, 2nd ed., chapter 3).
///
/// Every function of the library takes it for a scalar. A motion of a system over such numbers has the values
/// and their derivatives, in the directions that the slopes of start and parameters name. The steps follow
/// the errors of both ([`Real::part`]). Numbers are ordered by their values, and equal values by their slopes
/// one after the other, as infinitesimals are. `Dual<Dual<f64, A>, B>` has second derivatives.
///
/// A function of a number whose slopes are zero has slopes of zero, also where the function has no
/// derivative.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Dual<R, const D: usize> {
    /// The number.
    pub value: R,
    /// Its derivatives.
    pub slopes: [R; D],
}

impl<R: Real, const D: usize> Dual<R, D> {
    /// A number that does not vary.
    #[inline(always)]
    #[must_use]
    pub fn constant(value: R) -> Self {
        Self { value, slopes: [R::zero(); D] }
    }

    /// A number whose derivative in one direction is 1.
    #[inline]
    #[must_use]
    pub fn variable(value: R, direction: usize) -> Self {
        Self { value, slopes: each(|i| if i == direction { R::one() } else { R::zero() }) }
    }

    #[inline(always)]
    fn quotient(self, other: Self) -> Self {
        let value = self.value / other.value;
        let slope = |i: usize| (self.slopes[i] - value * other.slopes[i]) / other.value;
        Self { value, slopes: each(slope) }
    }

    /// A function of this number with its derivative.
    #[inline(always)]
    fn with(self, value: R, slope: R) -> Self {
        Self { value, slopes: self.slopes.each(|x| scaled(x, slope)) }
    }

    /// A function of two numbers with its derivatives by both.
    #[inline(always)]
    fn with_both(self, other: Self, value: R, [by_self, by_other]: [R; 2]) -> Self {
        let slope = |i: usize| scaled(self.slopes[i], by_self) + scaled(other.slopes[i], by_other);
        Self { value, slopes: each(slope) }
    }
}

/// An array of the values of a function for each index, always in line.
#[inline(always)]
fn each<R: Real, const D: usize>(slope: impl Fn(usize) -> R) -> [R; D] {
    let mut slopes = [R::zero(); D];
    for (i, to) in slopes.iter_mut().enumerate() {
        *to = slope(i);
    }
    slopes
}

/// `slope` · `factor`. It is zero where the slope is, even if the factor is infinite.
#[inline(always)]
fn scaled<R: Real>(slope: R, factor: R) -> R {
    if slope.is_zero() { slope } else { slope * factor }
}

impl<R: Real, const D: usize> Add for Dual<R, D> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let slope = |i: usize| self.slopes[i] + other.slopes[i];
        Self { value: self.value + other.value, slopes: each(slope) }
    }
}

impl<R: Real, const D: usize> Sub for Dual<R, D> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let slope = |i: usize| self.slopes[i] - other.slopes[i];
        Self { value: self.value - other.value, slopes: each(slope) }
    }
}

impl<R: Real, const D: usize> Mul for Dual<R, D> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let slope = |i: usize| R::mul_add(self.slopes[i], other.value, self.value * other.slopes[i]);
        Self { value: self.value * other.value, slopes: each(slope) }
    }
}

impl<R: Real, const D: usize> Div for Dual<R, D> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.quotient(other)
    }
}

impl<R: Real, const D: usize> Neg for Dual<R, D> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: -self.value, slopes: self.slopes.each(|slope| -slope) }
    }
}

macro_rules! assign {
    ($($trait:ident $method:ident $operator:tt;)*) => {$(
        impl<R: Real, const D: usize> $trait for Dual<R, D> {
            #[inline(always)]
            fn $method(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )*};
}

assign! { AddAssign add_assign +; SubAssign sub_assign -; MulAssign mul_assign *; DivAssign div_assign /; }

impl<R: Real, const D: usize> Sum for Dual<R, D> {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::zero(), |sum, term| sum + term)
    }
}

impl<R: Real, const D: usize> Zero for Dual<R, D> {
    #[inline(always)]
    fn zero() -> Self {
        Self::constant(R::zero())
    }
    #[inline]
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl<R: Real, const D: usize> One for Dual<R, D> {
    #[inline(always)]
    fn one() -> Self {
        Self::constant(R::one())
    }
}

/// Functions of one argument: value and derivative at `x`, the value known as `y` to the derivative.
macro_rules! functions {
    ($($name:ident($x:ident, $y:ident) = $slope:expr;)*) => {$(
        #[inline]
        fn $name(self) -> Self {
            let ($x, $y) = (self.value, self.value.$name());
            self.with($y, $slope)
        }
    )*};
}

impl<R: Real, const D: usize> Real for Dual<R, D> {
    /// Lanes have no derivatives: steps and tolerances are compared in them.
    type Lane = R::Lane;

    const PARTS: usize = R::PARTS * (1 + D);
    const DEPTH: usize = R::DEPTH + 1;

    #[inline(always)]
    fn part(self, index: usize) -> Self {
        let part = match (index / R::PARTS).checked_sub(1) {
            None => self.value,
            Some(direction) => self.slopes.get(direction).copied().unwrap_or(R::zero()),
        };
        Self::constant(part.part(index % R::PARTS))
    }
    #[inline(always)]
    fn infinitesimal(direction: usize) -> Self {
        Self::variable(R::zero(), direction)
    }
    #[inline(always)]
    fn splat(lane: R::Lane) -> Self {
        Self::constant(R::splat(lane))
    }
    #[inline]
    fn largest(self) -> R::Lane {
        self.value.largest()
    }
    #[inline(always)]
    fn from_f64(literal: f64) -> Self {
        Self::constant(R::from_f64(literal))
    }
    #[inline(always)]
    fn from_parts(high: f64, low: f64) -> Self {
        Self::constant(R::from_parts(high, low))
    }
    #[inline(always)]
    fn epsilon() -> Self {
        Self::constant(R::epsilon())
    }
    #[inline]
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.slopes.iter().all(|slope| slope.is_finite())
    }
    #[inline]
    fn is_positive(self) -> bool {
        self.value.is_positive()
    }
    #[inline]
    fn binade(self) -> Self {
        Self::constant(self.value.binade())
    }
    #[inline]
    fn signum(self) -> Self {
        Self::constant(self.value.signum())
    }
    #[inline]
    fn abs(self) -> Self {
        self.with(self.value.abs(), self.value.signum())
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.with(sin, cos), self.with(cos, -sin))
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        let radius = self.value.hypot(x.value);
        let slopes = [x.value / radius / radius, -(self.value / radius / radius)];
        self.with_both(x, self.value.atan2(x.value), slopes)
    }
    functions! {
        exp(_x, y) = y;
        ln(x, _y) = x.recip();
        sqrt(_x, y) = R::from_f64(0.5) / y;
        sin(x, _y) = x.cos();
        cos(x, _y) = -x.sin();
        tan(_x, y) = R::mul_add(y, y, R::one());
        asin(x, _y) = ((R::one() - x) * (R::one() + x)).sqrt().recip();
        acos(x, _y) = -((R::one() - x) * (R::one() + x)).sqrt().recip();
        atan(x, _y) = R::mul_add(x, x, R::one()).recip();
        sinh(x, _y) = x.cosh();
        cosh(x, _y) = x.sinh();
        // 1 − tanh² would lose its digits where the value approaches 1.
        tanh(x, _y) = x.sech() * x.sech();
        sech(x, y) = -(y * x.tanh());
        // 1 − y would lose its digits where the value approaches 1.
        logistic(x, y) = y * (-x).logistic();
        asinh(x, _y) = x.hypot(R::one()).recip();
        acosh(x, _y) = ((x - R::one()).sqrt() * (x + R::one()).sqrt()).recip();
        atanh(x, _y) = ((R::one() - x) * (R::one() + x)).recip();
        exp_m1(x, _y) = x.exp();
        ln_1p(x, _y) = (R::one() + x).recip();
        cbrt(_x, y) = (R::from_f64(3.0) * (y * y)).recip();
        recip(_x, y) = -(y * y);
    }
    #[inline]
    fn powf(self, exponent: Self) -> Self {
        let value = self.value.powf(exponent.value);
        let by_base = exponent.value * self.value.powf(exponent.value - R::one());
        // Most exponents do not vary, and need no logarithm.
        if exponent.slopes.iter().all(|&slope| slope == R::zero()) {
            return self.with(value, by_base);
        }
        self.with_both(exponent, value, [by_base, self.value.powf_ln(exponent.value)])
    }
    #[inline]
    fn powf_ln(self, exponent: Self) -> Self {
        let lowered = exponent.value - R::one();
        let by_base = exponent.value * self.value.powf_ln(lowered) + self.value.powf(lowered);
        // xʸ ln² x is the square of a function that has a limit at a base of zero as well.
        let root = self.value.powf_ln(R::from_f64(0.5) * exponent.value);
        self.with_both(exponent, self.value.powf_ln(exponent.value), [by_base, root * root])
    }
    #[inline]
    fn powi(self, exponent: i32) -> Self {
        let slope = match exponent {
            0 => R::zero(),
            // The exponent less one would be out of range in this case alone.
            i32::MIN => self.value.powi(exponent) / self.value,
            _ => self.value.powi(exponent - 1),
        };
        self.with(self.value.powi(exponent), R::from_f64(f64::from(exponent)) * slope)
    }
    #[inline]
    fn max(self, other: Self) -> Self {
        let [larger, smaller] = shares(self.value - other.value);
        self.with_both(other, self.value.max(other.value), [larger, smaller])
    }
    #[inline]
    fn min(self, other: Self) -> Self {
        let [larger, smaller] = shares(self.value - other.value);
        self.with_both(other, self.value.min(other.value), [smaller, larger])
    }
    #[inline]
    fn hypot(self, other: Self) -> Self {
        let value = self.value.hypot(other.value);
        self.with_both(other, value, [self.value / value, other.value / value])
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        let slope = |i: usize| {
            let rest = R::mul_add(self.value, factor.slopes[i], summand.slopes[i]);
            R::mul_add(self.slopes[i], factor.value, rest)
        };
        let value = R::mul_add(self.value, factor.value, summand.value);
        Self { value, slopes: each(slope) }
    }
}

/// 1 for the larger and 0 for the smaller of two numbers, by their difference, lane by lane.
#[inline]
fn shares<R: Real>(difference: R) -> [R; 2] {
    let (sign, half) = (difference.signum(), R::from_f64(0.5));
    [half * (R::one() + sign), half * (R::one() - sign)]
}

#[cfg(test)]
mod tests;
