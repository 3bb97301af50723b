//! Integer powers.
//!
//! A product of two numbers is right to 5u², and the errors of repeated products add up: x⁶⁴ by six squarings
//! has that of 63 products, as a power has by x. So the factors of longer products are sums of three doubles,
//! whose products are right to some u³, and there is one rounding at the end.

use super::DoubleDouble;
use super::arithmetic::{div, fast_two_sum, mul, two_product, two_sum};

/// A number and what is left of it beside two doubles.
#[derive(Clone, Copy)]
struct Long {
    near: DoubleDouble,
    rest: f64,
}

impl Long {
    fn new(near: DoubleDouble) -> Self {
        Self { near, rest: 0.0 }
    }

    /// The sum of a number, a smaller one and a still smaller one. If a part is not finite, it is `rough`.
    #[inline]
    fn of_parts(large: f64, small: f64, rest: f64, rough: f64) -> Self {
        let near = fast_two_sum(large, small);
        let tail = two_sum(near.low, rest);
        if near.high.is_finite() && tail.high.is_finite() && tail.low.is_finite() {
            Self { near: DoubleDouble { high: near.high, low: tail.high }, rest: tail.low }
        } else {
            Self::new(DoubleDouble::from(rough))
        }
    }

    /// 1/x: one step beyond the quotient of doubles, to the second order in its error.
    fn inverse(x: DoubleDouble) -> Self {
        let quotient = 1.0 / x.high;
        let (of_high, of_low) = (two_product(quotient, x.high), two_product(quotient, x.low));
        // 1 − x · quotient. The first difference is exact.
        let first = two_sum(1.0 - of_high.high, -of_high.low);
        let second = two_sum(first.high, -of_low.high);
        let (error, rest) = (second.high, second.low + first.low - of_low.low);
        let change = two_product(quotient, error);
        Self::of_parts(quotient, change.high, change.low + quotient * (rest + error * error), quotient)
    }

    #[inline(never)]
    fn times(self, other: Self) -> Self {
        let (a, b) = (self.near, other.near);
        let product = two_product(a.high, b.high);
        let (one, two) = (two_product(a.high, b.low), two_product(a.low, b.high));
        let small = two_sum(one.high, two.high);
        let sum = two_sum(product.low, small.high);
        let rest = a.low * b.low + (a.high * other.rest + self.rest * b.high) + (one.low + two.low);
        Self::of_parts(product.high, sum.high, rest + (small.low + sum.low), a.high * b.high)
    }

    /// The two doubles that are nearest.
    fn rounded(self) -> DoubleDouble {
        let DoubleDouble { high, low } = self.near;
        fast_two_sum(high, low + self.rest).or(high)
    }
}

/// Up to the fourth power three products at most, which meet the bound.
#[inline]
pub(super) fn powi(x: DoubleDouble, exponent: i32) -> DoubleDouble {
    /// Between this size and its inverse a product has all its digits, and so has its inverse.
    const SMALL: f64 = f64::from_bits((1023 - 960) << 52);
    match exponent {
        0 => DoubleDouble::ONE,
        1..=4 => few(x, exponent),
        -4..0 => {
            let power = few(x, -exponent);
            let is_far = power.high.abs() < SMALL || power.high.abs() > SMALL.recip();
            if is_far { long_power(x, exponent) } else { div(DoubleDouble::ONE, power) }
        }
        _ => long_power(x, exponent),
    }
}

/// The first four powers.
#[inline]
fn few(x: DoubleDouble, exponent: i32) -> DoubleDouble {
    match exponent {
        1 => x,
        2 => mul(x, x),
        3 => mul(mul(x, x), x),
        _ => {
            let square = mul(x, x);
            mul(square, square)
        }
    }
}

/// By repeated squaring. The base is inverted first: a power that underflows may have an inverse in range.
fn long_power(x: DoubleDouble, exponent: i32) -> DoubleDouble {
    let mut square = if exponent < 0 { Long::inverse(x) } else { Long::new(x) };
    let mut left = exponent.unsigned_abs();
    let mut product = None;
    loop {
        if left & 1 == 1 {
            product = Some(product.map_or(square, |product: Long| product.times(square)));
        }
        left >>= 1;
        if left == 0 {
            return product.map_or(DoubleDouble::ONE, Long::rounded);
        }
        square = square.times(square);
    }
}

#[cfg(test)]
mod tests;
