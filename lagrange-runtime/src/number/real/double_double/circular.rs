//! Sine and cosine, and the angle of a point.

use super::DoubleDouble;
use super::angle;
use super::arithmetic::{add, div, mul, mul_add, power_of_two, sub};
use super::exponential::{INVERSE_FACTORIALS, nearest_integer};
use crate::number::math;

/// An eighth of a turn, rounded down.
const EIGHTH: f64 = core::f64::consts::FRAC_PI_4;

pub(super) fn sin_cos(x: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    if !x.high.is_finite() {
        let nan = DoubleDouble::from(f64::NAN);
        return (nan, nan);
    }
    let (quadrant, r) = if x.high.abs() < EIGHTH { (0, x) } else { reduced(x) };
    let (sin, cos) = (small_sin(r), small_cos(r));
    match quadrant {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// The quadrant, modulo four, and the angle from its middle axis.
fn reduced(x: DoubleDouble) -> (u64, DoubleDouble) {
    let (quadrant, negative, zeros, leading) = angle::nearest_quarter(x.high, x.low);
    // 53 bits a part, the first of weight ½.
    let part = |shift: u32| ((leading >> shift) & ((1 << 53) - 1)) as f64;
    let (a, b) = (part(75) * power_of_two(-53), part(22) * power_of_two(-106));
    let c = (leading & ((1 << 22) - 1)) as f64 * power_of_two(-128);
    let size = add(DoubleDouble::from(a), add(DoubleDouble::from(b), DoubleDouble::from(c)));
    let angle = mul(size.scaled(power_of_two(-(zeros as i32))), DoubleDouble::FRAC_PI_2);
    (quadrant, if negative { -angle } else { angle })
}

/// Terms of a series, for r² below 0.62: the rest is below 2⁻¹⁰⁸ of the sum.
const TERMS: usize = 14;

/// From this term on they are below 2⁻⁵³ of the sum: doubles are enough.
const DOUBLES: usize = 8;

/// 1/3!, 1/5!, …
const OF_SIN: [(f64, f64); TERMS] = every_second(1);

/// 1/2!, 1/4!, …
const OF_COS: [(f64, f64); TERMS] = every_second(0);

const fn every_second(first: usize) -> [(f64, f64); TERMS] {
    let mut of = [(0.0, 0.0); TERMS];
    let mut k = 0;
    while k < TERMS {
        of[k] = INVERSE_FACTORIALS[2 * k + first];
        k += 1;
    }
    of
}

/// Σ cₖ (−z)ᵏ.
#[inline]
fn series(z: DoubleDouble, coefficients: &[(f64, f64); TERMS]) -> DoubleDouble {
    let (pairs, doubles) = coefficients.split_at(DOUBLES);
    let tail = doubles.iter().rev().fold(0.0, |sum, (high, _)| high - sum * z.high);
    let pairs = pairs.iter().rev().map(|&(high, low)| DoubleDouble::constant(high, low));
    pairs.fold(DoubleDouble::from(tail), |sum, c| mul_add(-z, sum, c))
}

/// r − r³/3! + …
fn small_sin(r: DoubleDouble) -> DoubleDouble {
    let z = mul(r, r);
    mul_add(-mul(r, z), series(z, &OF_SIN), r)
}

/// 1 − r²/2! + …
fn small_cos(r: DoubleDouble) -> DoubleDouble {
    let z = mul(r, r);
    mul_add(-z, series(z, &OF_COS), DoubleDouble::ONE)
}

pub(super) fn atan2(y: DoubleDouble, x: DoubleDouble) -> DoubleDouble {
    let rough = math::f64::atan2(y.high, x.high);
    if y.high == 0.0 || x.high == 0.0 || !y.high.is_finite() || !x.high.is_finite() {
        // Multiples of an eighth of a turn, zeros with their sign, NaN.
        return match rough / EIGHTH {
            eighths if eighths == 0.0 || eighths.is_nan() => DoubleDouble::from(rough),
            eighths => mul(DoubleDouble::FRAC_PI_2, DoubleDouble::from(0.5 * nearest_integer(eighths))),
        };
    }
    // In so thin a triangle the angle is its tangent, and the products below would underflow.
    const THIN: f64 = f64::from_bits((1023 - 56) << 52);
    if x.high > 0.0 && y.high.abs() < THIN * x.high {
        return div(y, x);
    }
    // Sides near 1: the smaller matters down to a rounding of the larger.
    let larger = y.high.abs().max(x.high.abs());
    let exponent = 1023 - (larger.to_bits() >> 52) as i32;
    let scale = |side: DoubleDouble| {
        side.scaled(power_of_two(exponent / 2)).scaled(power_of_two(exponent - exponent / 2))
    };
    let (y, x) = (scale(y), scale(x));
    // With δ the angle that is left, tan δ = δ + δ³/3: the cube is far below a rounding.
    let (sin, cos) = sin_cos(DoubleDouble::from(rough));
    let across = sub(mul(y, cos), mul(x, sin));
    let along = x.high * cos.high + y.high * sin.high;
    add(DoubleDouble::from(rough), DoubleDouble::from(across.high / along))
}
