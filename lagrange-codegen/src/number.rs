//! Exact constants: rationals until emission.
//!
//! A decimal literal is exact (0.1 is one tenth). Where a rational would not fit into 128-bit
//! numerator and denominator the value becomes two doubles, marked as such and never exact again.

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};

mod named;
mod parts;

/// A constant of the graph.
#[derive(Clone, Copy, Debug)]
pub enum Number {
    /// `numerator / denominator` in lowest terms, denominator positive. The numerator is above `i128::MIN`,
    /// so that it can change its sign.
    Ratio(i128, i128),
    /// A value that does not fit into a ratio: the double that arithmetic of doubles gives, and the rest that
    /// it lacks.
    Float(f64, f64),
}

impl Number {
    /// 0.
    pub const ZERO: Number = Number::Ratio(0, 1);
    /// 1.
    pub const ONE: Number = Number::Ratio(1, 1);
    /// −1.
    pub const MINUS_ONE: Number = Number::Ratio(-1, 1);
    /// ½.
    pub const HALF: Number = Number::Ratio(1, 2);

    /// An integer.
    pub fn integer(value: i128) -> Number {
        if value == i128::MIN { Number::Float(value as f64, 0.0) } else { Number::Ratio(value, 1) }
    }

    /// `value as f64`, or `value as f32`: an integer of more digits than these have is rounded, as by Rust.
    pub fn cast(value: i128, single: bool) -> Number {
        let float = if single { f64::from(value as f32) } else { value as f64 };
        // The largest integers round to 2¹²⁷, which no `i128` holds.
        if float >= -(i128::MIN as f64) { Number::Float(float, 0.0) } else { Number::integer(float as i128) }
    }

    /// A quotient of integers; `None` for a zero denominator, and where an integer cannot change its sign.
    pub fn ratio(numerator: i128, denominator: i128) -> Option<Number> {
        if denominator == 0 || numerator == i128::MIN || denominator == i128::MIN {
            return None;
        }
        let divisor = gcd(numerator.unsigned_abs(), denominator.unsigned_abs()) as i128;
        let sign = if denominator < 0 { -1 } else { 1 };
        Some(Number::Ratio(sign * (numerator / divisor), sign * (denominator / divisor)))
    }

    /// An exponent that counts halves, as a number.
    pub fn halves(count: i32) -> Number {
        if count % 2 == 0 {
            Number::integer(i128::from(count / 2))
        } else {
            Number::Ratio(i128::from(count), 2)
        }
    }

    /// The value of a decimal literal such as `6.674_30e-11` (without suffix), exact if it fits into a ratio.
    /// `None` if it cannot be read.
    pub fn parse(literal: &str) -> Option<Number> {
        let text: String = literal.chars().filter(|&c| c != '_').collect();
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
            None => (text.as_str(), 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let float = || {
            let value = text.parse().ok()?;
            Some(Number::Float(value, parts::rest_of_decimal(&text, value)))
        };
        let Ok(digits) = format!("{whole}{fraction}").parse::<i128>() else { return float() };
        let Some(power) = exponent.checked_sub(fraction.len() as i32) else { return float() };
        let Some(scale) = 10_i128.checked_pow(power.unsigned_abs()) else { return float() };
        if power >= 0 {
            digits.checked_mul(scale).map(Number::integer).or_else(float)
        } else {
            Number::ratio(digits, scale).or_else(float)
        }
    }

    /// The nearest double.
    pub fn value(self) -> f64 {
        match self {
            Number::Ratio(numerator, 1) => numerator as f64,
            Number::Ratio(numerator, denominator) => {
                const EXACT: u128 = 1 << 53;
                if numerator.unsigned_abs() <= EXACT && denominator.unsigned_abs() <= EXACT {
                    numerator as f64 / denominator as f64
                } else {
                    self.parts().0
                }
            }
            Number::Float(value, _) => value,
        }
    }

    /// Whether this is 0.
    pub fn is_zero(self) -> bool {
        self == Number::ZERO || matches!(self, Number::Float(value, _) if value == 0.0)
    }

    /// Whether this is 1.
    pub fn is_one(self) -> bool {
        self == Number::ONE
    }

    /// Whether this is ∞ or −∞.
    pub fn is_infinite(self) -> bool {
        matches!(self, Number::Float(value, _) if value.is_infinite())
    }

    /// Whether this is below 0.
    pub fn is_negative(self) -> bool {
        match self {
            Number::Ratio(numerator, _) => numerator < 0,
            Number::Float(value, _) => value < 0.0,
        }
    }

    /// The integer this is, if it is one.
    pub fn as_integer(self) -> Option<i128> {
        match self {
            Number::Ratio(numerator, 1) => Some(numerator),
            _ => None,
        }
    }

    /// Absolute value.
    pub fn abs(self) -> Number {
        if self.is_negative() { -self } else { self }
    }

    /// `1 / self`; `None` for 0.
    pub fn recip(self) -> Option<Number> {
        match self {
            Number::Ratio(numerator, denominator) => Number::ratio(denominator, numerator),
            Number::Float(value, rest) => {
                (value != 0.0).then(|| Number::refined(1.0 / value, parts::reciprocal((value, rest))))
            }
        }
    }

    /// An integer power; `None` for a negative power of 0.
    pub fn powi(self, exponent: i32) -> Option<Number> {
        let base = if exponent < 0 { self.recip()? } else { self };
        Some((0..exponent.unsigned_abs()).fold(Number::ONE, |power, _| power * base))
    }

    /// The square root of a number that is not negative.
    pub fn sqrt(self) -> Number {
        self.exact_sqrt().unwrap_or_else(|| Number::refined(self.value().sqrt(), parts::root(self.parts())))
    }

    /// The square root, if it is rational. That of a ratio of larger squares than 2¹⁰⁶ may not be found.
    pub fn exact_sqrt(self) -> Option<Number> {
        let root = |value: i128| {
            let guess = (value as f64).sqrt().round() as i128;
            (guess.checked_mul(guess) == Some(value)).then_some(guess)
        };
        match self {
            Number::Ratio(numerator, denominator) if numerator >= 0 => {
                Number::ratio(root(numerator)?, root(denominator)?)
            }
            _ => None,
        }
    }
}

impl std::ops::Add for Number {
    type Output = Number;
    fn add(self, other: Number) -> Number {
        if let (Number::Ratio(a, b), Number::Ratio(c, d)) = (self, other) {
            if b == 1
                && d == 1
                && let Some(sum) = a.checked_add(c)
            {
                return Number::integer(sum);
            }
            let exact = || {
                let numerator = a.checked_mul(d)?.checked_add(c.checked_mul(b)?)?;
                Number::ratio(numerator, b.checked_mul(d)?)
            };
            if let Some(sum) = exact() {
                return sum;
            }
        }
        Number::refined(self.value() + other.value(), parts::sum(self.parts(), other.parts()))
    }
}

impl std::ops::Neg for Number {
    type Output = Number;
    fn neg(self) -> Number {
        match self {
            Number::Ratio(numerator, denominator) => Number::Ratio(-numerator, denominator),
            Number::Float(value, rest) => Number::Float(-value, -rest),
        }
    }
}

impl std::ops::Sub for Number {
    type Output = Number;
    fn sub(self, other: Number) -> Number {
        self + -other
    }
}

impl std::ops::Mul for Number {
    type Output = Number;
    fn mul(self, other: Number) -> Number {
        if self.is_one() {
            return other;
        }
        if other.is_one() {
            return self;
        }
        if let (Number::Ratio(a, b), Number::Ratio(c, d)) = (self, other) {
            let exact = || Number::ratio(a.checked_mul(c)?, b.checked_mul(d)?);
            if let Some(product) = exact() {
                return product;
            }
        }
        Number::refined(self.value() * other.value(), parts::product(self.parts(), other.parts()))
    }
}

impl PartialEq for Number {
    fn eq(&self, other: &Number) -> bool {
        match (self, other) {
            (Number::Ratio(a, b), Number::Ratio(c, d)) => a == c && b == d,
            (Number::Float(a, of_a), Number::Float(b, of_b)) => {
                a.to_bits() == b.to_bits() && of_a.to_bits() == of_b.to_bits()
            }
            _ => false,
        }
    }
}

impl Eq for Number {}

impl Hash for Number {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match self {
            Number::Ratio(numerator, denominator) => {
                state.write_i128(*numerator);
                state.write_i128(*denominator);
            }
            Number::Float(value, rest) => {
                state.write_u64(value.to_bits());
                state.write_u64(rest.to_bits());
            }
        }
    }
}

impl PartialOrd for Number {
    fn partial_cmp(&self, other: &Number) -> Option<Ordering> {
        self.value().partial_cmp(&other.value())
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Number::Ratio(numerator, 1) => write!(f, "{numerator}"),
            Number::Ratio(numerator, denominator) => {
                // A decimal, if it is short and exact, as the user would have written it.
                let short = format!("{}", self.value());
                if short.len() < 17 && Number::parse(&short) == Some(*self) {
                    f.write_str(&short)
                } else {
                    write!(f, "{numerator}/{denominator}")
                }
            }
            Number::Float(value, _) => write!(f, "{value:?}"),
        }
    }
}

fn gcd(a: u128, b: u128) -> u128 {
    if b == 0 { a.max(1) } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimal_literals_are_exact() {
        assert_eq!(Number::parse("0.1"), Number::ratio(1, 10));
        assert_eq!(Number::parse("1_000.50"), Number::ratio(2001, 2));
        assert_eq!(Number::parse("6.674_30e-11"), Number::ratio(667_430, 10_i128.pow(16)));
        assert_eq!(Number::parse("2e3"), Some(Number::integer(2000)));
        assert!(matches!(Number::parse("1e-300"), Some(Number::Float(..))));
    }

    #[test]
    fn values_are_the_nearest_doubles() {
        for literal in
            ["0.1", "9.81", "3.141592653589793", "1.7976931348623157e10", "0.003827465019283746510293"]
        {
            let expected: f64 = literal.parse().unwrap();
            assert_eq!(Number::parse(literal).unwrap().value().to_bits(), expected.to_bits(), "{literal}");
        }
    }

    #[test]
    fn casts_round_to_the_nearest_float_and_halves_to_even() {
        let double = 1_i128 << 53;
        let single = 1_i128 << 24;
        for sign in [1, -1] {
            for (value, expected) in [(double - 1, -1), (double + 1, 0), (double + 2, 2), (double + 3, 4)] {
                let expected = Number::integer(sign * (double + expected));
                assert_eq!(Number::cast(sign * value, false), expected, "{value}");
            }
            for (value, expected) in [(single - 1, -1), (single + 1, 0), (single + 2, 2), (single + 3, 4)] {
                let expected = Number::integer(sign * (single + expected));
                assert_eq!(Number::cast(sign * value, true), expected, "{value}");
                assert_eq!(Number::cast(sign * value, false), Number::integer(sign * value));
            }
        }
        // Beside a half a double would round twice.
        let beside = (1_i128 << 60) + (1 << 36) + 1;
        assert_eq!(Number::cast(beside, true).value(), f64::from(beside as f32));
        assert_ne!(Number::cast(beside, true).value(), f64::from(beside as f64 as f32));
        for value in [i128::MIN, i128::MIN + 1, i128::MAX, i128::MAX - 1, 123_456_789_012_345_678] {
            assert_eq!(Number::cast(value, false).parts(), (value as f64, 0.0), "{value}");
            assert_eq!(Number::cast(value, true).parts(), (f64::from(value as f32), 0.0), "{value}");
        }
    }

    #[test]
    fn overflow_falls_back_to_doubles() {
        let big = Number::integer(i128::MAX / 2);
        assert!(matches!(big * big, Number::Float(..)));
        assert_eq!((big + big + Number::integer(1)).value(), i128::MAX as f64);
    }

    #[test]
    fn the_integer_without_a_negative_changes_its_sign_too() {
        let quarter = Number::parse("8.5070591730234615865843651857942052864e37").unwrap();
        let (half, two) = (2.0_f64.powi(127), Number::integer(2));
        let lowest = [
            -quarter - quarter,
            quarter * -two,
            Number::integer(i128::MIN),
            Number::integer(-i128::MAX) - Number::ONE,
        ];
        for lowest in lowest {
            assert_eq!((lowest.value(), (-lowest).value(), lowest.abs().value()), (-half, half, half));
            assert_eq!((lowest - lowest).value(), 0.0);
            assert_eq!((lowest * Number::HALF).value(), -quarter.value());
            assert_eq!(lowest.recip().map(Number::value), Some(-1.0 / half));
        }
        assert_eq!(Number::ratio(1, i128::MIN), None);
    }
}
