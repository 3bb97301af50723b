//! Exponentials, logarithms, hyperbolic functions.

use super::DoubleDouble;
use super::arithmetic::{add, div, mul, mul_add, power_of_two, sqrt, sub, times};
use crate::number::math;
use crate::number::real::Real;

/// ln 2 to 40 bits, so that its multiples by exponents are exact.
const LN_2_HIGH: f64 = 0.6931471805592082;

/// The rest of ln 2.
const LN_2_REST: DoubleDouble = DoubleDouble::constant(7.371002565167799e-13, 1.94704509238075e-31);

/// 1/n! for n from 2: both parts.
pub(super) const INVERSE_FACTORIALS: [(f64, f64); 28] = [
    (0.5, 0.0),
    (0.16666666666666666, 9.25185853854297e-18),
    (0.041666666666666664, 2.3129646346357427e-18),
    (0.008333333333333333, 1.1564823173178714e-19),
    (0.001388888888888889, -5.300543954373577e-20),
    (0.0001984126984126984, 1.7209558293420705e-22),
    (2.48015873015873e-05, 2.1511947866775882e-23),
    (2.7557319223985893e-06, -1.858393274046472e-22),
    (2.755731922398589e-07, 2.3767714622250297e-23),
    (2.505210838544172e-08, -1.448814070935912e-24),
    (2.08767569878681e-09, -1.20734505911326e-25),
    (1.6059043836821613e-10, 1.2585294588752098e-26),
    (1.1470745597729725e-11, 2.0655512752830745e-28),
    (7.647163731819816e-13, 7.03872877733453e-30),
    (4.779477332387385e-14, 4.399205485834081e-31),
    (2.8114572543455206e-15, 1.6508842730861433e-31),
    (1.5619206968586225e-16, 1.1910679660273754e-32),
    (8.22063524662433e-18, 2.2141894119604265e-34),
    (4.110317623312165e-19, 1.4412973378659527e-36),
    (1.9572941063391263e-20, -1.3643503830087908e-36),
    (8.896791392450574e-22, -7.911402614872376e-38),
    (3.868170170630684e-23, -8.843177655482344e-40),
    (1.6117375710961184e-24, -3.6846573564509766e-41),
    (6.446950284384474e-26, -1.9330404233703465e-42),
    (2.4795962632247976e-27, -1.2953730964765229e-43),
    (9.183689863795546e-29, 1.4303150396787322e-45),
    (3.279889237069838e-30, 1.5117542744029879e-46),
    (1.1309962886447716e-31, 1.0498015412959506e-47),
];

/// The nearest integer, for sizes below 2⁵¹: the sum has no bits for a fraction.
#[inline]
pub(super) fn nearest_integer(x: f64) -> f64 {
    const SHIFT: f64 = 1.5 * (1_u64 << 52) as f64;
    (x + SHIFT) - SHIFT
}

/// (k, eʳ − 1) with x = k ln 2 + r and |r| ≤ ½ ln 2. For |x| < 1000.
fn reduced(x: DoubleDouble) -> (i32, DoubleDouble) {
    let k = nearest_integer(x.high * core::f64::consts::LOG2_E);
    let r = if k == 0.0 {
        x
    } else {
        // The product is exact, and so is the difference of numbers so near to each other.
        let near = add(DoubleDouble::from(x.high - k * LN_2_HIGH), DoubleDouble::from(x.low));
        sub(near, times(LN_2_REST, k))
    };
    (k as i32, small_exp_m1(r))
}

/// eʳ − 1 for |r| ≤ 0.35, with all digits relative to itself: Taylor's series at r/64, then six times
/// e²ˣ − 1 = (eˣ − 1)(eˣ + 1).
fn small_exp_m1(r: DoubleDouble) -> DoubleDouble {
    /// Terms from here on are below 2⁻⁵³ of the sum: doubles are enough.
    const DOUBLES: usize = 7;
    /// Terms beyond are below 2⁻¹⁰⁸ of the sum.
    const LAST: usize = 12;
    let x = r.scaled(1.0 / 64.0);
    let mut tail = 0.0;
    for (high, _) in INVERSE_FACTORIALS[DOUBLES - 2..=LAST - 2].iter().rev() {
        tail = tail * x.high + high;
    }
    let mut sum = DoubleDouble::from(tail);
    for &(high, low) in INVERSE_FACTORIALS[..DOUBLES - 2].iter().rev() {
        sum = mul_add(sum, x, DoubleDouble::constant(high, low));
    }
    let mut y = mul_add(mul(x, x), sum, x);
    for _ in 0..6 {
        y = mul_add(y, y, y.scaled(2.0));
    }
    y
}

/// x · 2ᵏ, in two factors that are in range.
fn times_power(x: DoubleDouble, k: i32) -> DoubleDouble {
    x.scaled(power_of_two(k / 2)).scaled(power_of_two(k - k / 2))
}

pub(super) fn exp(x: DoubleDouble) -> DoubleDouble {
    // Beyond, all is infinite, zero or NaN, as it is in `f64`.
    if x.high.is_nan() || x.high.abs() > 800.0 {
        return DoubleDouble::from(math::f64::exp(x.high));
    }
    let (k, less_one) = reduced(x);
    times_power(add(DoubleDouble::ONE, less_one), k)
}

pub(super) fn exp_m1(x: DoubleDouble) -> DoubleDouble {
    // Below, the square of x is less than a rounding of x, and parts of its low part would underflow.
    const TINY: f64 = f64::from_bits((1023 - 110) << 52);
    if x.high.abs() < TINY {
        return x;
    }
    if x.high.is_nan() || x.high.abs() > 800.0 {
        return DoubleDouble::from(math::f64::exp_m1(x.high));
    }
    let (k, less_one) = reduced(x);
    if k == 0 {
        return less_one;
    }
    sub(times_power(add(DoubleDouble::ONE, less_one), k), DoubleDouble::ONE)
}

pub(super) fn ln(x: DoubleDouble) -> DoubleDouble {
    const SUBNORMAL: i32 = 54;
    if x.high <= 0.0 || !x.high.is_finite() {
        return DoubleDouble::from(math::f64::ln(x.high));
    }
    let (shift, y) = match x.high < f64::MIN_POSITIVE {
        true => (SUBNORMAL, x.scaled(power_of_two(SUBNORMAL))),
        false => (0, x),
    };
    let mut k = ((y.high.to_bits() >> 52) as i32) - 1023;
    let mut m = times_power(y, -k);
    // Between √½ and √2 the logarithm of m cancels less than half of k ln 2.
    if m.high > core::f64::consts::SQRT_2 {
        (k, m) = (k + 1, m.scaled(0.5));
    }
    let of_m = small_ln_1p(sub(m, DoubleDouble::ONE));
    let exponent = f64::from(k - shift);
    if exponent == 0.0 {
        return of_m;
    }
    add(DoubleDouble::from(exponent * LN_2_HIGH), add(times(LN_2_REST, exponent), of_m))
}

/// ln(1 + x) for x between −½ and 1, with all digits relative to itself: from the double y₀,
/// ln((1 + x)/e^y₀) = 2 d/s + O(d³) with the difference d and the sum s of numerator and denominator.
fn small_ln_1p(x: DoubleDouble) -> DoubleDouble {
    let rough = math::f64::ln_1p(x.high);
    let less_one = exp_m1(DoubleDouble::from(rough));
    let difference = sub(x, less_one);
    let sum = 2.0 + x.high + less_one.high;
    add(DoubleDouble::from(rough), DoubleDouble::from(2.0 * difference.high / sum))
}

pub(super) fn ln_1p(x: DoubleDouble) -> DoubleDouble {
    if x.high > -0.5 && x.high < 1.0 && x.high != 0.0 {
        small_ln_1p(x)
    } else if x.high == 0.0 {
        x
    } else {
        ln(add(DoubleDouble::ONE, x))
    }
}

/// e to the power y ln x: the relative error is that of a rounding times y ln x. Zeros, infinities and signs
/// as in `f64`.
pub(super) fn powf(x: DoubleDouble, y: DoubleDouble) -> DoubleDouble {
    let special = x.high == 0.0 || !x.high.is_finite() || !y.high.is_finite() || y.high == 0.0;
    if special {
        // A base next to ±1 with an infinite exponent: `f64` would take the base for ±1 itself.
        if !y.high.is_nan() && !y.high.is_finite() && x.high.abs() == 1.0 && x.low != 0.0 {
            let grows = (x.abs() > DoubleDouble::ONE) == (y.high > 0.0);
            return DoubleDouble::from(if grows { f64::INFINITY } else { 0.0 });
        }
        return DoubleDouble::from(math::f64::powf(x.high, y.high));
    }
    if x.high > 0.0 {
        return exp(mul(y, ln(x)));
    }
    // NaN for a fraction, else the sign.
    let integer = y.low == 0.0 || y.low == nearest_integer(y.low) || y.low.abs() >= (1_u64 << 51) as f64;
    let of_high = math::f64::powf(-1.0, y.high);
    let of_low = math::f64::powf(-1.0, y.low);
    if !integer || of_high.is_nan() || of_low.is_nan() {
        return DoubleDouble::from(f64::NAN);
    }
    exp(mul(y, ln(-x))).scaled(of_high * of_low)
}

/// (e^½ˣ)² / 2 where x is large: eˣ would overflow before its half does.
fn half_exp(x: DoubleDouble) -> DoubleDouble {
    let root = exp(x.scaled(0.5));
    mul(root.scaled(0.5), root)
}

/// Above, e⁻ˣ is less than a rounding of eˣ.
const ALONE: f64 = 40.0;

pub(super) fn sinh(x: DoubleDouble) -> DoubleDouble {
    if !x.high.is_finite() {
        return x;
    }
    if x.high.abs() > ALONE {
        return half_exp(x.abs()).scaled(x.high.signum());
    }
    // (y + y/(y + 1))/2 with y = eˣ − 1. Both terms have the same sign.
    let y = exp_m1(x.abs());
    add(y, div(y, add(y, DoubleDouble::ONE))).scaled(0.5 * x.high.signum())
}

pub(super) fn cosh(x: DoubleDouble) -> DoubleDouble {
    if x.high.abs() > ALONE {
        return half_exp(x.abs());
    }
    let grown = exp(x.abs());
    add(grown, div(DoubleDouble::ONE, grown)).scaled(0.5)
}

/// Above, 1 is less than a rounding of x².
const FAR: f64 = (1_u64 << 60) as f64;

pub(super) fn asinh(x: DoubleDouble) -> DoubleDouble {
    let size = x.abs();
    let of_size = if size.high > FAR {
        add(ln(size), DoubleDouble::LN_2)
    } else {
        let square = mul(size, size);
        let root = sqrt(add(square, DoubleDouble::ONE));
        ln_1p(add(size, div(square, add(DoubleDouble::ONE, root))))
    };
    if x.high.is_sign_negative() { -of_size } else { of_size }
}

pub(super) fn acosh(x: DoubleDouble) -> DoubleDouble {
    if x.high > FAR {
        return add(ln(x), DoubleDouble::LN_2);
    }
    let above = sub(x, DoubleDouble::ONE);
    ln_1p(add(above, sqrt(mul(above, add(x, DoubleDouble::ONE)))))
}

pub(super) fn atanh(x: DoubleDouble) -> DoubleDouble {
    // The quotient of the size: near −1 the quotient of the number would round to −1.
    let size = x.abs();
    let quotient = div(size.scaled(2.0), sub(DoubleDouble::ONE, size));
    ln_1p(quotient).scaled(0.5 * x.high.signum())
}
