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

/// The highest order whose quotient is tabulated: that of the longest series.
const TABULATED: usize = 32;

/// 1 / order, what rounding has taken from it, and half of its ulp; no ulp where nothing was taken.
macro_rules! quotient {
    ($scalar:ident, $bits:ident, $order:expr) => {{
        let nearest = 1.0 / $order as $scalar;
        // nearest = whole / 2^digits.
        let fraction = $scalar::MANTISSA_DIGITS - 1;
        let digits = fraction + $scalar::MAX_EXP as u32 - 1 - (nearest.to_bits() >> fraction) as u32;
        let whole = (nearest.to_bits() & ((1 << fraction) - 1)) | (1 << fraction);
        let ulp = 1.0 / ((1 as $bits) << digits) as $scalar;
        let rest = ((1 as $bits) << digits).wrapping_sub(whole * $order as $bits).cast_signed();
        [nearest, rest as $scalar * ulp / $order as $scalar, if rest == 0 { 0.0 } else { 0.5 * ulp }]
    }};
}

macro_rules! impl_real {
    ($scalar:ident, $bits:ident, $from_f64:expr) => {
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
            #[inline(always)]
            fn over_order(self, order: usize, dither: Self) -> Self {
                const QUOTIENTS: [[$scalar; 3]; TABULATED + 1] = {
                    let (mut table, mut order) = ([[0.0; 3]; TABULATED + 1], 1);
                    while order <= TABULATED {
                        table[order] = quotient!($scalar, $bits, order);
                        order += 1;
                    }
                    table
                };
                match QUOTIENTS.get(order) {
                    // The sum is rounded, and nothing else. (L. Schuchman, "Dither signals and their
                    // effect on quantization noise", IEEE Trans. Comm. 12, 1964.)
                    Some(&[nearest, rest, half_ulp]) => self * (nearest + (rest + dither * half_ulp)),
                    None => self / order as $scalar,
                }
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

impl_real!(f64, u64, |x: f64| x);
impl_real!(f32, u32, |x: f64| x as f32);
