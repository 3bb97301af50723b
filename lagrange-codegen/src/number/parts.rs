//! Numbers as two doubles: the value in doubles, and the double nearest to what that lacks.

use super::Number;

/// A number to about 106 bits.
pub(super) type Parts = (f64, f64);

impl Number {
    /// The double of the number, and the double nearest to what that lacks. The former is the nearest one for
    /// a ratio and a literal, and what arithmetic of doubles gives for other results.
    pub fn parts(self) -> (f64, f64) {
        match self {
            Number::Ratio(numerator, denominator) => {
                let (value, rest) = ratio(numerator.unsigned_abs(), denominator.unsigned_abs());
                if numerator < 0 { (-value, -rest) } else { (value, rest) }
            }
            Number::Float(value, rest) => (value, rest),
        }
    }

    /// A number whose double is given, and whose parts are known to more digits.
    pub(super) fn refined(value: f64, (high, low): Parts) -> Number {
        let rest = (high - value) + low;
        Number::Float(value, if rest.is_finite() { rest } else { 0.0 })
    }
}

/// The parts of a ratio, correctly rounded: 126 bits by long division, of which the last stands for what is
/// cut off.
fn ratio(numerator: u128, denominator: u128) -> Parts {
    const BITS: u32 = 126;
    if numerator == 0 || denominator == 0 {
        return (0.0, 0.0);
    }
    let (mut quotient, mut remainder) = (numerator / denominator, numerator % denominator);
    let mut exponent = 0;
    while quotient.leading_zeros() > 128 - BITS {
        // The denominator is below 2¹²⁷.
        remainder <<= 1;
        let bit = u128::from(remainder >= denominator);
        remainder -= bit * denominator;
        quotient = (quotient << 1) | bit;
        exponent -= 1;
    }
    quotient |= u128::from(remainder != 0);
    let value = quotient as f64;
    let rest = (quotient as i128 - value as i128) as f64;
    let scale = 2.0_f64.powi(exponent);
    (value * scale, rest * scale)
}

fn two_sum(a: f64, b: f64) -> Parts {
    let sum = a + b;
    let of_a = sum - b;
    let of_b = sum - of_a;
    (sum, (a - of_a) + (b - of_b))
}

pub(super) fn sum(a: Parts, b: Parts) -> Parts {
    let (high, low) = (two_sum(a.0, b.0), two_sum(a.1, b.1));
    let (high, low) = (two_sum(high.0, high.1 + low.0), low.1);
    two_sum(high.0, high.1 + low)
}

pub(super) fn product(a: Parts, b: Parts) -> Parts {
    let high = a.0 * b.0;
    two_sum(high, a.0.mul_add(b.0, -high) + (a.0 * b.1 + a.1 * b.0))
}

/// One step of Newton's method from the double.
pub(super) fn reciprocal(a: Parts) -> Parts {
    let rough = 1.0 / a.0;
    let less = product(a, (rough, 0.0));
    let error = sum((1.0, 0.0), (-less.0, -less.1));
    sum((rough, 0.0), product((rough, 0.0), error))
}

/// One step of Newton's method from the double.
pub(super) fn root(a: Parts) -> Parts {
    let rough = a.0.sqrt();
    let square = product((rough, 0.0), (rough, 0.0));
    let error = sum(a, (-square.0, -square.1));
    sum((rough, 0.0), (error.0 / (2.0 * rough), 0.0))
}

/// The difference between a decimal and a double, exactly: both are written out and subtracted digit by
/// digit.
pub(super) fn rest_of_decimal(text: &str, value: f64) -> f64 {
    /// Digits before the point, of which the largest double has 309, and behind it, of which the smallest one
    /// has 1074.
    const WHOLE: usize = 320;
    const FRACTION: usize = 1100;
    if !value.is_finite() {
        return 0.0;
    }
    let mut difference = [0_i32; WHOLE + FRACTION];
    let mut add = |text: &str, sign: i32| {
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let exponent: i64 = exponent.parse().unwrap_or(0);
        let whole = mantissa.find('.').unwrap_or(mantissa.len());
        let first = WHOLE as i64 - whole as i64 - exponent;
        for (place, digit) in (first..).zip(mantissa.bytes().filter(u8::is_ascii_digit)) {
            if let Some(to) = usize::try_from(place).ok().and_then(|place| difference.get_mut(place)) {
                *to += sign * i32::from(digit - b'0');
            }
        }
    };
    add(text, 1);
    add(&format!("{value:.FRACTION$}"), -1);
    // The first digit that is not zero has the sign of the difference. Borrowing gives all digits that sign.
    let sign = difference.iter().find(|&&digit| digit != 0).map_or(1, |digit| digit.signum());
    let mut carry = 0;
    for digit in difference.iter_mut().rev() {
        let signed = sign * *digit + carry;
        (*digit, carry) = (signed.rem_euclid(10), signed.div_euclid(10));
    }
    let digits = |range: &[i32]| -> String { range.iter().map(|digit| digit.to_string()).collect() };
    let decimal = format!("{}.{}", digits(&difference[..WHOLE]), digits(&difference[WHOLE..]));
    f64::from(sign) * decimal.parse().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By mpmath: `h = float(x); h, float(x - mpf(h))`.
    #[test]
    fn parts_are_correctly_rounded() {
        for (text, parts) in [
            ("0.1", (0.1, -5.551115123125783e-18)),
            ("9.81", (9.81, -4.973799150320702e-16)),
            ("0.25", (0.25, 0.0)),
            ("1e-300", (1e-300, -2.5059094e-317)),
            ("6.62607015e-34", (6.62607015e-34, 1.7027509332425372e-50)),
            ("6.02214076e23", (6.02214076e23, 12976128.0)),
            (
                "3.14159265358979323846264338327950288419716939937510",
                (std::f64::consts::PI, 1.2246467991473532e-16),
            ),
        ] {
            assert_eq!(Number::parse(text).unwrap().parts(), parts, "{text}");
        }
        let third = Number::ratio(-1, 3).unwrap();
        assert_eq!(third.parts(), (-0.3333333333333333, -1.850371707708594e-17));
    }

    #[test]
    fn what_leaves_the_ratios_keeps_its_digits() {
        // (10³⁰/3)² / 10⁶⁰ = 1/9, by way of numbers beyond 128 bits.
        let large = Number::ratio(10_i128.pow(30), 3).unwrap();
        let square = large * large;
        assert!(matches!(square, Number::Float(..)));
        let small = Number::parse("1e-60").unwrap();
        let (ninth, expected) = ((square * small).parts(), Number::ratio(1, 9).unwrap().parts());
        assert!(((ninth.0 - expected.0) + (ninth.1 - expected.1)).abs() < 1e-32, "{ninth:?}");
        let back = small.recip().unwrap() * small;
        assert!(((back.parts().0 - 1.0) + back.parts().1).abs() < 1e-31);
        let sum = square + Number::parse("1e-40").unwrap();
        assert_eq!(sum.parts(), square.parts());
        let (root, expected) = (Number::integer(2).sqrt().parts(), Number::named("SQRT_2").unwrap().parts());
        assert!(root.0 == expected.0 && (root.1 - expected.1).abs() < 2e-32, "{root:?}");
        assert_eq!(Number::ratio(9, 4).unwrap().sqrt(), Number::ratio(3, 2).unwrap());
    }

    /// The double is the one of the operation on doubles, so that nothing changes where doubles are all there
    /// is.
    #[test]
    fn doubles_of_results_are_results_of_doubles() {
        let [a, b] = ["1e-200", "3e-150"].map(|text| Number::parse(text).unwrap());
        assert_eq!((a * b).value(), 0.0);
        assert_eq!((a + b).value(), 1e-200 + 3e-150);
        let pi = Number::named("PI").unwrap();
        assert_eq!((pi * pi).value(), std::f64::consts::PI * std::f64::consts::PI);
        assert_eq!((Number::Float(f64::INFINITY, 0.0) * a).parts(), (f64::INFINITY, 0.0));
    }
}
