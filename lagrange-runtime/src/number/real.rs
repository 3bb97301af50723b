//! [`Real`]: the scalar that equations of motion are evaluated in.
//!
//! The trait is open. `f32`, `f64` and [`Dual`] implement it here, and so do `Lanes` and `DoubleDouble` with
//! features of their own. Implement it for fixed point, SIMD lanes or a hardware CORDIC, and every generated
//! method works with them. Thirteen functions are required; the
//! others have defaults. Where a default is weak its documentation says so, and an implementor with a better
//! routine overrides it. The supertraits are what nalgebra needs for sums, products, `dot` and `cross`.

use core::fmt::Debug;
use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

#[cfg(feature = "double-double")]
mod double_double;
mod dual;
mod floats;
#[cfg(feature = "double-double")]
pub use double_double::{DoubleDouble, ParseError};
pub use dual::Dual;
#[cfg(feature = "wide")]
mod lanes;
#[cfg(feature = "wide")]
pub use lanes::Lanes;
mod ordered;
pub use ordered::Ordered;
pub(crate) use ordered::{any, extent, larger, smaller};
mod vector;
pub use vector::Vector;

/// A real number, or several of them side by side (lanes).
pub trait Real:
    Copy
    + Debug
    + PartialEq
    + 'static
    + Sum
    + Zero
    + One
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// One lane: the type itself, the element of a SIMD vector, or the number without the derivatives that it
    /// carries.
    type Lane: Real<Lane = Self::Lane> + PartialOrd;

    /// The same value in every lane.
    fn splat(lane: Self::Lane) -> Self;

    /// The largest lane. It may skip a lane with NaN, which [`Real::is_finite`] tells.
    fn largest(self) -> Self::Lane;

    /// The nearest value to a double.
    fn from_f64(literal: f64) -> Self;

    /// Sine and cosine of an angle in radians, together.
    fn sin_cos(self) -> (Self, Self);

    /// Angle of the point (`x`, `self`) in radians, in \[−π, π].
    fn atan2(self, x: Self) -> Self;

    /// e to the power `self`.
    fn exp(self) -> Self;

    /// Natural logarithm.
    fn ln(self) -> Self;

    /// Square root; NaN below zero.
    fn sqrt(self) -> Self;

    /// Absolute value.
    fn abs(self) -> Self;

    /// +1 from +0 upwards, −1 from −0 downwards, as `f64::signum`.
    fn signum(self) -> Self;

    /// Distance from 1 to the next larger number.
    fn epsilon() -> Self;

    /// Whether no lane is infinite or NaN.
    fn is_finite(self) -> bool;

    /// Whether every lane is strictly above zero; false for NaN.
    fn is_positive(self) -> bool;

    /// `self` in the lanes where `sign` is strictly above zero, `other` in the rest.
    #[inline(always)]
    #[must_use]
    fn where_positive(self, sign: Self, other: Self) -> Self {
        if sign.is_positive() { self } else { other }
    }

    /// The number of parts that error control weighs separately: one, or a number and its derivatives.
    const PARTS: usize = 1;

    /// The order of the derivatives that a number carries: 0 for plain numbers.
    const DEPTH: usize = 0;

    /// One of the [`Real::PARTS`] as a number of its own, whose derivatives are zero: the value first.
    #[inline(always)]
    #[must_use]
    fn part(self, _index: usize) -> Self {
        self
    }

    /// A number without value whose derivative in one direction is one: zero where there are no derivatives.
    #[doc(hidden)]
    #[inline(always)]
    #[must_use]
    fn infinitesimal(_direction: usize) -> Self {
        Self::zero()
    }

    /// A power of two that is at most a positive number, up to rounding, and more than its half. The default
    /// is the number itself.
    #[doc(hidden)]
    #[inline]
    #[must_use]
    fn binade(self) -> Self {
        self
    }

    /// The nearest value to a constant that is not a double, such as a tenth or ln 2. `high` is the double
    /// nearest to it, `low` the one nearest to the difference. The default ignores `low`, which is right for
    /// scalars with no more digits than `f64`.
    #[inline]
    fn from_parts(high: f64, low: f64) -> Self {
        let _ = low;
        Self::from_f64(high)
    }

    /// π.
    #[inline]
    fn pi() -> Self {
        Self::from_f64(core::f64::consts::PI)
    }

    /// Sine of an angle in radians.
    #[inline]
    fn sin(self) -> Self {
        self.sin_cos().0
    }

    /// Cosine of an angle in radians.
    #[inline]
    fn cos(self) -> Self {
        self.sin_cos().1
    }

    /// Tangent of an angle in radians.
    #[inline]
    fn tan(self) -> Self {
        let (sin, cos) = self.sin_cos();
        sin / cos
    }

    /// Angle in \[−π/2, π/2] with this sine.
    #[inline]
    fn asin(self) -> Self {
        self.atan2(((Self::one() - self) * (Self::one() + self)).sqrt())
    }

    /// Angle in \[0, π] with this cosine.
    #[inline]
    fn acos(self) -> Self {
        ((Self::one() - self) * (Self::one() + self)).sqrt().atan2(self)
    }

    /// Angle in (−π/2, π/2) with this tangent.
    #[inline]
    fn atan(self) -> Self {
        self.atan2(Self::one())
    }

    /// Hyperbolic sine. The default is as accurate near zero as [`Real::exp_m1`].
    #[inline]
    fn sinh(self) -> Self {
        (self.exp_m1() - (-self).exp_m1()) / Self::from_f64(2.0)
    }

    /// Hyperbolic cosine.
    #[inline]
    fn cosh(self) -> Self {
        (self.exp() + (-self).exp()) / Self::from_f64(2.0)
    }

    /// Hyperbolic tangent. The default is as accurate near zero as [`Real::exp_m1`].
    #[inline]
    fn tanh(self) -> Self {
        // The exponent is never positive, so nothing overflows.
        let decay = (Self::from_f64(-2.0) * self.abs()).exp_m1();
        self.signum() * (-decay / (decay + Self::from_f64(2.0)))
    }

    /// One over the hyperbolic cosine: 0 where that overflows, and so are its derivatives.
    #[inline]
    fn sech(self) -> Self {
        self.cosh().recip()
    }

    /// 1/(1 + e⁻ˣ): 0 where the exponential overflows, and so are its derivatives.
    #[inline]
    fn logistic(self) -> Self {
        (Self::one() + (-self).exp()).recip()
    }

    /// Inverse hyperbolic sine.
    #[inline]
    fn asinh(self) -> Self {
        let x = self.abs();
        let square = x * x;
        self.signum() * (x + square / (Self::one() + (square + Self::one()).sqrt())).ln_1p()
    }

    /// Inverse hyperbolic cosine; NaN below 1.
    #[inline]
    fn acosh(self) -> Self {
        let above = self - Self::one();
        (above + (above * (self + Self::one())).sqrt()).ln_1p()
    }

    /// Inverse hyperbolic tangent.
    #[inline]
    fn atanh(self) -> Self {
        let two = Self::from_f64(2.0);
        (two * self / (Self::one() - self)).ln_1p() / two
    }

    /// e to the power `self`, less 1. The default loses relative accuracy near zero.
    #[inline]
    fn exp_m1(self) -> Self {
        self.exp() - Self::one()
    }

    /// Natural logarithm of 1 + `self`. The default compensates for the rounding of 1 + `self`.
    #[inline]
    fn ln_1p(self) -> Self {
        let sum = Self::one() + self;
        sum.ln() - ((sum - Self::one()) - self) / sum
    }

    /// Cube root, odd in `self`.
    #[inline]
    fn cbrt(self) -> Self {
        self.signum() * (self.abs().ln() / Self::from_f64(3.0)).exp()
    }

    /// Power with a real exponent; the default is NaN for a negative base.
    #[inline]
    fn powf(self, exponent: Self) -> Self {
        (exponent * self.ln()).exp()
    }

    /// `self` to a real power, times the natural logarithm of `self`: the derivative of the power by its
    /// exponent. Where the power is zero, so is this: the limit.
    #[inline]
    fn powf_ln(self, exponent: Self) -> Self {
        let power = self.powf(exponent);
        if power == Self::zero() { power } else { power * self.ln() }
    }

    /// Power with an integer exponent, by repeated squaring: the same bits on every target.
    #[inline]
    fn powi(self, exponent: i32) -> Self {
        let mut square = self;
        let mut product = Self::one();
        let mut left = exponent.unsigned_abs();
        while left > 0 {
            if left & 1 == 1 {
                product *= square;
            }
            left >>= 1;
            if left > 0 {
                square *= square;
            }
        }
        if exponent < 0 { product.recip() } else { product }
    }

    /// The larger of two, lane by lane. The default has a rounding error.
    #[inline]
    fn max(self, other: Self) -> Self {
        (self + other + (self - other).abs()) / Self::from_f64(2.0)
    }

    /// The smaller of two, lane by lane. The default has a rounding error.
    #[inline]
    fn min(self, other: Self) -> Self {
        (self + other - (self - other).abs()) / Self::from_f64(2.0)
    }

    /// `self` where it is positive, else zero.
    #[inline]
    fn positive_part(self) -> Self {
        self.max(Self::zero())
    }

    /// One where `self` is not negative, else zero, lane by lane; NaN where it is NaN. Derivatives are zero.
    #[inline]
    fn step(self) -> Self {
        let [zero, one] = [Self::zero(), Self::one()];
        // `self + -self` is zero or NaN, without derivatives.
        one.where_positive(self, zero.where_positive(-self, (self + -self) + one))
    }

    /// One where `self` is negative, else zero, lane by lane: the opposite of [`Real::step`].
    #[inline]
    fn below(self) -> Self {
        let [zero, one] = [Self::zero(), Self::one()];
        zero.where_positive(self, one.where_positive(-self, self + -self))
    }

    /// `self` between two bounds, lane by lane.
    #[inline]
    fn clamp(self, low: Self, high: Self) -> Self {
        self.max(low).min(high)
    }

    /// √(`self`² + `other`²). The default overflows if a square does.
    #[inline]
    fn hypot(self, other: Self) -> Self {
        (self * self + other * other).sqrt()
    }

    /// `self` · `factor` + `summand`, in the way that is fast on the target and never a call. `f32` and `f64`
    /// are rounded once where the target has the instruction and the math is the standard library's, twice
    /// otherwise.
    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        self * factor + summand
    }

    /// 1 / `self`.
    #[inline]
    fn recip(self) -> Self {
        Self::one() / self
    }

    /// A nonnegative number in single precision, enough for a report; infinity for one that is too large. The
    /// default finds its binary digits one by one, because a scalar of the user's own has no conversion.
    fn to_single(self) -> f32
    where
        Self: PartialOrd,
    {
        let (mut rest, mut sum) = (self, 0.0);
        let (mut digit, mut power) = (Self::from_f64(LARGEST_DIGIT as f64), LARGEST_DIGIT);
        if self >= digit + digit {
            return f32::INFINITY;
        }
        while power > 0.0 && rest > Self::zero() {
            if rest >= digit {
                rest -= digit;
                sum += power;
            }
            digit *= Self::from_f64(0.5);
            power *= 0.5;
        }
        sum
    }
}

/// 2¹²⁷, the largest power of two in `f32`.
const LARGEST_DIGIT: f32 = f32::from_bits(0x7f00_0000);

#[cfg(test)]
pub(crate) mod tests;
