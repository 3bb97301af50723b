//! [`Number`]: the numbers of formulas by hand.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A real number, possibly with a derivative.
pub trait Number:
    Copy
    + Debug
    + Default
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + From<f64>
{
    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);

    /// Square root.
    fn sqrt(self) -> Self;

    /// One over it.
    fn inverse(self) -> Self;
}

impl Number for f64 {
    #[inline]
    fn sin_cos(self) -> (f64, f64) {
        self.sin_cos()
    }

    #[inline]
    fn sqrt(self) -> f64 {
        self.sqrt()
    }

    #[inline]
    fn inverse(self) -> f64 {
        1.0 / self
    }
}
