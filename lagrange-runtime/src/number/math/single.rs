//! Functions of `f32` in single precision throughout.
//!
//! The `libm` crate computes these in double precision. On a processor whose floating-point unit knows `f32`
//! alone, each of them would take thousands of instructions and link the emulation of doubles, several
//! kilobytes. The functions here need neither. Their largest errors, found by trying all arguments, are 2.8
//! units in the last place for sine and cosine (1.2e-7 at most), 4.8 for the tangent, 2.6 for the arc sine, 1
//! for the cube root. For the hypotenuse samples show 2.

pub(crate) use libm::*;

use core::f32::consts::{FRAC_2_PI, FRAC_PI_2};

/// 1.5 · 2²³: a number below 2²² added to it is rounded to an integer, which then stands in the low bits.
const TO_INTEGER: f32 = 12_582_912.0;

/// π/2 in three parts. The first two have so few digits that their products with numbers below 2¹¹ are exact.
const HALF_PI: [f32; 3] =
    [f32::from_bits(0x3fc9_1000), f32::from_bits(0xb695_7800), f32::from_bits(0x2e85_a309)];

/// Angles from here on are reduced in integer arithmetic \[rad].
const LARGE: f32 = 2048.0;

/// sin x = x + x³ (S₀ + S₁ x² + S₂ x⁴) for |x| ≤ π/4 (Moshier's Cephes library).
const S: [f32; 3] = [-1.666_665_5e-1, 8.332_161e-3, -1.951_529_6e-4];

/// cos x = 1 − x²/2 + x⁴ (C₀ + C₁ x² + C₂ x⁴) for |x| ≤ π/4.
const C: [f32; 3] = [4.166_664_6e-2, -1.388_731_6e-3, 2.443_315_7e-5];

/// Sine and cosine of an angle in radians.
#[inline(never)]
pub(crate) fn sincosf(x: f32) -> (f32, f32) {
    let (quarter, rest) = if x.abs() < LARGE { reduce(x) } else { reduce_large(x) };
    let square = rest * rest;
    let sin = rest + rest * (square * (S[0] + square * (S[1] + square * S[2])));
    let cos = 1.0 + square * (-0.5 + square * (C[0] + square * (C[1] + square * C[2])));
    let (sin, cos) = if quarter & 1 == 0 { (sin, cos) } else { (cos, sin) };
    // Bit 1 of the quarter is the sign of the sine. The cosine has the sign of the sine a quarter turn later.
    let signed = |x: f32, quarter: u32| f32::from_bits(x.to_bits() ^ ((quarter & 2) << 30));
    (signed(sin, quarter), signed(cos, quarter.wrapping_add(1)))
}

/// The nearest multiple of π/2 modulo 4 (more of its bits may be set), and the remaining angle.
#[inline]
fn reduce(x: f32) -> (u32, f32) {
    let shifted = x * FRAC_2_PI + TO_INTEGER;
    let count = shifted - TO_INTEGER;
    let rest = ((x - count * HALF_PI[0]) - count * HALF_PI[1]) - count * HALF_PI[2];
    (shifted.to_bits(), rest)
}

/// The same for any angle: the product with the binary digits of 2/π that matter (Payne and Hanek). NaN for
/// what is not finite.
#[cold]
#[inline(never)]
fn reduce_large(x: f32) -> (u32, f32) {
    /// 2⁻³² · 2/π.
    const DIGITS: [u32; 8] =
        [0, 0xa2f9_836e, 0x4e44_1529, 0xfc27_57d1, 0xf534_ddc0, 0xdb62_9599, 0x3c43_9041, 0xfe51_63ab];
    let bits = x.to_bits();
    let (exponent, mantissa) = ((bits >> 23) & 0xff, (bits & 0x7f_ffff) | 0x80_0000);
    // The product of this binary digit and the last bit of the mantissa is two quarter turns. Those of the
    // digits before are full turns.
    let first = exponent.wrapping_sub(120);
    let Some(&[a, b, c, d]) = DIGITS.get(first as usize / 32..).and_then(|digits| digits.first_chunk())
    else {
        return (0, f32::NAN);
    };
    if !x.is_finite() {
        return (0, f32::NAN);
    }
    let window =
        |high: u32, low: u32| (((u64::from(high) << 32 | u64::from(low)) << (first % 32)) >> 32) as u32;
    let times = |digits: u32| u64::from(mantissa) * u64::from(digits);
    let product =
        (times(window(a, b)) << 32).wrapping_add(times(window(b, c))).wrapping_add(times(window(c, d)) >> 32);
    // Two bits of quarters, 62 of their fraction.
    let quarter = product.wrapping_add(1 << 61) >> 62;
    let fraction = product.wrapping_sub(quarter << 62) as i64;
    let rest = fraction as f32 * (FRAC_PI_2 / (1_u64 << 62) as f32);
    if x.is_sign_negative() { ((quarter as u32).wrapping_neg(), -rest) } else { (quarter as u32, rest) }
}

/// Sine of an angle in radians.
#[inline]
pub(crate) fn sinf(x: f32) -> f32 {
    sincosf(x).0
}

/// Cosine of an angle in radians.
#[inline]
pub(crate) fn cosf(x: f32) -> f32 {
    sincosf(x).1
}

/// Tangent of an angle in radians.
#[inline]
pub(crate) fn tanf(x: f32) -> f32 {
    let (sin, cos) = sincosf(x);
    sin / cos
}

/// Angle in \[−π/2, π/2] with this sine.
#[inline]
pub(crate) fn asinf(x: f32) -> f32 {
    atan2f(x, sqrtf((1.0 - x) * (1.0 + x)))
}

/// √(x² + y²) where no square can overflow.
#[inline]
pub(crate) fn hypotf(x: f32, y: f32) -> f32 {
    let (x, y) = (x.abs(), y.abs());
    if x.is_infinite() || y.is_infinite() {
        return f32::INFINITY;
    }
    let (large, small) = if x < y { (y, x) } else { (x, y) };
    if large == 0.0 {
        return large;
    }
    let ratio = small / large;
    large * sqrtf(1.0 + ratio * ratio)
}

/// Cube root: five bits from the exponent, then a step of a rational approximation (as in Sun's fdlibm).
#[inline]
pub(crate) fn cbrtf(x: f32) -> f32 {
    const TWO_24: f32 = 16_777_216.0;
    if x == 0.0 || !x.is_finite() {
        return x;
    }
    let size = x.abs();
    // The roots of subnormal numbers are 2⁸ times smaller than those of 2²⁴ times the numbers.
    let (size, back) = if size < f32::MIN_POSITIVE { (size * TWO_24, 1.0 / 256.0) } else { (size, 1.0) };
    let root = f32::from_bits(size.to_bits() / 3 + 709_958_130);
    let s = 0.542_857_17 + root * root / size * root;
    let root = root * (0.357_142_87 + 1.607_142_8 / (s + 1.414_285_7 - 0.705_306_1 / s));
    // A step of Newton's method, for the last two bits.
    let root = root - (root - size / (root * root)) / 3.0;
    (root * back).copysign(x)
}

#[cfg(test)]
mod tests;
