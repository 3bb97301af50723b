//! `f64` and `f32` as scalars: their own functions, and those of the backend.

use super::Real;
use crate::number::math;

/// Forwards functions of `Real` to the backend of the same name.
macro_rules! forward {
    ($scalar:ident: $($name:ident($($arg:ident),*);)*) => {$(
        #[inline]
        fn $name(self $(, $arg: Self)*) -> Self {
            math::$scalar::$name(self $(, $arg)*)
        }
    )*};
}

macro_rules! impl_real {
    ($scalar:ident, $from_f64:expr) => {
        impl Real for $scalar {
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
                $from_f64(literal)
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                math::$scalar::sin_cos(self)
            }
            #[inline]
            fn abs(self) -> Self {
                $scalar::abs(self)
            }
            #[inline]
            fn signum(self) -> Self {
                $scalar::signum(self)
            }
            #[inline]
            fn epsilon() -> Self {
                $scalar::EPSILON
            }
            #[inline]
            fn is_finite(self) -> bool {
                $scalar::is_finite(self)
            }
            #[inline]
            fn is_positive(self) -> bool {
                self > 0.0
            }
            #[inline]
            fn max(self, other: Self) -> Self {
                $scalar::max(self, other)
            }
            #[inline]
            fn min(self, other: Self) -> Self {
                $scalar::min(self, other)
            }
            #[inline(always)]
            fn mul_add(self, factor: Self, summand: Self) -> Self {
                math::fused::$scalar::mul_add(self, factor, summand)
            }
            #[inline]
            fn binade(self) -> Self {
                // The bits of an infinite number are those of an exponent alone, those of a subnormal number
                // have no exponent.
                let power = $scalar::from_bits(self.to_bits() & $scalar::INFINITY.to_bits());
                if power > 0.0 { power } else { self }
            }
            #[inline]
            fn to_single(self) -> f32 {
                self as f32
            }
            forward! { $scalar:
                sin(); cos(); tan(); asin(); acos(); atan(); atan2(x);
                sinh(); cosh(); tanh(); asinh(); acosh(); atanh();
                exp(); exp_m1(); ln(); ln_1p(); sqrt(); cbrt(); powf(exponent); hypot(other);
            }
        }
    };
}

impl_real!(f64, |x: f64| x);
impl_real!(f32, |x: f64| x as f32);
