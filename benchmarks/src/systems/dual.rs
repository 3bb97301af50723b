//! [`Dual`]: a value with its derivative in one direction, which implicit peers ask for.

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use super::number::Number;

/// A value and its derivative in one direction.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dual {
    pub value: f64,
    pub slope: f64,
}

impl From<f64> for Dual {
    #[inline]
    fn from(value: f64) -> Self {
        Self { value, slope: 0.0 }
    }
}

impl Number for Dual {
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (Self { value: sin, slope: cos * self.slope }, Self { value: cos, slope: -sin * self.slope })
    }

    #[inline]
    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        Self { value, slope: 0.5 * self.slope / value }
    }

    #[inline]
    fn inverse(self) -> Self {
        let value = 1.0 / self.value;
        Self { value, slope: -self.slope * value * value }
    }
}

/// An operator of dual numbers, also with a constant on the right where that is named.
macro_rules! operator {
    ($trait:ident, $method:ident, |$a:ident, $b:ident| $value:expr, $slope:expr) => {
        impl $trait for Dual {
            type Output = Self;

            #[inline]
            fn $method(self, other: Self) -> Self {
                let ($a, $b) = (self, other);
                Self { value: $value, slope: $slope }
            }
        }
    };
    ($trait:ident<f64>, $method:ident) => {
        impl $trait<f64> for Dual {
            type Output = Self;

            #[inline]
            fn $method(self, other: f64) -> Self {
                self.$method(Self::from(other))
            }
        }
    };
    ($trait:ident, $method:ident, $by:ident) => {
        impl $trait for Dual {
            #[inline]
            fn $method(&mut self, other: Self) {
                *self = self.$by(other);
            }
        }
    };
}

operator!(Add, add, |a, b| a.value + b.value, a.slope + b.slope);
operator!(Sub, sub, |a, b| a.value - b.value, a.slope - b.slope);
operator!(Mul, mul, |a, b| a.value * b.value, a.slope * b.value + a.value * b.slope);
operator!(Div, div, |a, b| a.value / b.value, (a.slope - a.value / b.value * b.slope) / b.value);
operator!(Add<f64>, add);
operator!(Sub<f64>, sub);
operator!(Mul<f64>, mul);
operator!(AddAssign, add_assign, add);
operator!(SubAssign, sub_assign, sub);
operator!(MulAssign, mul_assign, mul);

impl Neg for Dual {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}
