//! Sums, products, quotients and roots.
//!
//! They stay calls: an expansion has thousands of them, and inlined they make it 40 % larger and a quarter
//! longer to compile for 6 % fewer instructions.

use super::DoubleDouble;
use crate::number::math;

/// a + b and its rounding error, for |a| ≥ |b| or a = 0.
#[inline(always)]
pub(super) fn fast_two_sum(a: f64, b: f64) -> DoubleDouble {
    let sum = a + b;
    DoubleDouble { high: sum, low: b - (sum - a) }
}

/// a + b and its rounding error.
#[inline(always)]
pub(super) fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let sum = a + b;
    let of_a = sum - b;
    let of_b = sum - of_a;
    DoubleDouble { high: sum, low: (a - of_a) + (b - of_b) }
}

/// a · b and its rounding error.
#[inline(always)]
pub(super) fn two_product(a: f64, b: f64) -> DoubleDouble {
    #[cfg(all(feature = "std", not(feature = "libm"), any(target_feature = "fma", target_arch = "aarch64")))]
    {
        let product = a * b;
        DoubleDouble { high: product, low: a.mul_add(b, -product) }
    }
    #[cfg(not(all(
        feature = "std",
        not(feature = "libm"),
        any(target_feature = "fma", target_arch = "aarch64")
    )))]
    split_product(a, b)
}

/// [`two_product`] by Dekker's splitting: faster than a call of a fused multiply–add where there is no such
/// instruction, and the same on every target.
#[allow(dead_code)]
#[inline(always)]
pub(super) fn split_product(a: f64, b: f64) -> DoubleDouble {
    // From 2⁹⁹⁷ on the splitting overflows.
    const LARGE: f64 = f64::from_bits((1023 + 995) << 52);
    if a.abs() > LARGE || b.abs() > LARGE {
        return large_product(a, b);
    }
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (halves(a), halves(b));
    let low = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    DoubleDouble { high: product, low }
}

/// [`split_product`] of a large number.
#[cold]
fn large_product(a: f64, b: f64) -> DoubleDouble {
    const DOWN: f64 = f64::from_bits((1023 - 64) << 52);
    const UP: f64 = f64::from_bits((1023 + 64) << 52);
    let (scaled, other) = if a.abs() > b.abs() { (a * DOWN, b) } else { (b * DOWN, a) };
    if !scaled.is_finite() || scaled.abs() * other.abs() > f64::MAX * DOWN {
        return DoubleDouble { high: a * b, low: 0.0 };
    }
    let (product, (s_high, s_low), (o_high, o_low)) = (scaled * other, halves(scaled), halves(other));
    let low = ((s_high * o_high - product) + s_high * o_low + s_low * o_high) + s_low * o_low;
    DoubleDouble { high: product * UP, low: low * UP }
}

/// Two numbers of at most 26 bits with this sum.
#[inline(always)]
fn halves(x: f64) -> (f64, f64) {
    let shifted = ((1 << 27) + 1) as f64 * x;
    let high = shifted - (shifted - x);
    (high, x - high)
}

/// `AccurateDWPlusDW` of Joldes et al.
#[inline(never)]
pub(super) fn add(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble {
    let (high, low) = (two_sum(a.high, b.high), two_sum(a.low, b.low));
    let sum = fast_two_sum(high.high, high.low + low.high);
    fast_two_sum(sum.high, low.low + sum.low).or(a.high + b.high)
}

#[inline]
pub(super) fn sub(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble {
    add(a, -b)
}

/// The product as a sum that may overlap by a bit or two.
#[inline(always)]
fn loose_product(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble {
    let product = two_product(a.high, b.high);
    DoubleDouble { high: product.high, low: product.low + (a.high * b.low + a.low * b.high) }
}

/// `DWTimesDW1` of Joldes et al.
#[inline(never)]
pub(super) fn mul(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble {
    let product = loose_product(a, b);
    fast_two_sum(product.high, product.low).or(a.high * b.high)
}

#[inline(never)]
pub(super) fn mul_add(a: DoubleDouble, b: DoubleDouble, summand: DoubleDouble) -> DoubleDouble {
    let product = loose_product(a, b);
    let (high, low) = (two_sum(product.high, summand.high), two_sum(product.low, summand.low));
    let sum = fast_two_sum(high.high, high.low + low.high);
    fast_two_sum(sum.high, low.low + sum.low).or(a.high * b.high + summand.high)
}

/// A double quotient and one correction by the remainder, as `DWDivDW2` of Joldes et al.
#[inline(never)]
pub(super) fn div(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble {
    let quotient = a.high / b.high;
    let product = two_product(quotient, b.high);
    // The first difference is exact.
    let remainder = (((a.high - product.high) - product.low) + a.low) - quotient * b.low;
    fast_two_sum(quotient, remainder / b.high).or(quotient)
}

/// Times a double.
#[inline(always)]
pub(super) fn times(a: DoubleDouble, b: f64) -> DoubleDouble {
    let product = two_product(a.high, b);
    fast_two_sum(product.high, product.low + a.low * b).or(a.high * b)
}

/// A double root and one correction: A. H. Karp, P. Markstein, ACM Trans. Math. Softw. 23 (1997) 561.
#[inline(never)]
pub(super) fn sqrt(x: DoubleDouble) -> DoubleDouble {
    // Below, the square of the root would lose its low part to underflow.
    const SMALL: f64 = f64::from_bits((1023 - 900) << 52);
    const UP: f64 = f64::from_bits((1023 + 200) << 52);
    const DOWN: f64 = f64::from_bits((1023 - 100) << 52);
    if x.high < SMALL && x.high > 0.0 {
        return sqrt(x.scaled(UP)).scaled(DOWN);
    }
    let root = math::f64::sqrt(x.high);
    if root == 0.0 {
        return DoubleDouble::from(root);
    }
    let square = two_product(root, root);
    let remainder = ((x.high - square.high) - square.low) + x.low;
    fast_two_sum(root, remainder / (root + root)).or(root)
}

/// Two steps of Newton's method from a double root. One would leave the square of its error, which is as
/// large as the wanted precision.
pub(super) fn cbrt(x: DoubleDouble) -> DoubleDouble {
    let (scale, back) = scales(x.high, 3);
    let scaled = x.scaled(scale);
    let rough = math::f64::cbrt(scaled.high);
    if rough == 0.0 || !rough.is_finite() {
        return DoubleDouble::from(rough);
    }
    let mut root = DoubleDouble::from(rough);
    for _ in 0..2 {
        let square = mul(root, root);
        let remainder = sub(scaled, mul(square, root));
        root = add(root, DoubleDouble::from(remainder.high / (3.0 * square.high)));
    }
    root.scaled(back)
}

pub(super) fn hypot(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble {
    let rough = math::f64::hypot(a.high, b.high);
    let (scale, back) = scales(rough, 1);
    let (a, b) = (a.scaled(scale), b.scaled(scale));
    if rough == 0.0 || !rough.is_finite() || !scale.is_finite() {
        return DoubleDouble::from(rough);
    }
    sqrt(add(mul(a, a), mul(b, b))).scaled(back)
}

/// A power of two that brings a very large or small number to where products are exact, and the factor that
/// undoes it in a root of this `degree`.
fn scales(x: f64, degree: i32) -> (f64, f64) {
    const FAR: f64 = f64::from_bits((1023 + 300) << 52);
    let exponent = match x.abs() {
        size if size > FAR => -600,
        size if size < FAR.recip() => 600,
        _ => 0,
    };
    (power_of_two(exponent), power_of_two(-exponent / degree))
}

/// 2 to a power in the range of normal numbers.
#[inline]
pub(super) fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent.clamp(-1022, 1023)) as u64) << 52)
}
