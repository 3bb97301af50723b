//! Decimal numbers, read and written exactly.

use core::fmt;
use core::str::FromStr;

use super::DoubleDouble;
use super::integer::Integer;
use crate::number::real::Real;

/// The number of digits that are read and written. Further digits only round them.
const DIGITS: usize = 38;

/// An exponent that no count of digits makes up for.
const FARTHEST: i64 = 1 << 62;

/// Digits that tell two numbers apart in nearly all cases.
const SHOWN: usize = 32;

/// The most digits after the point that can be asked for.
const MOST: i32 = 400;

/// More than the longest text has: 309 digits before the point, [`MOST`] behind it.
const WIDEST: usize = 720;

/// Why a text is no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParseError;

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("not a decimal number, such as `-1.25`, `6.02e23` or `inf`")
    }
}

impl core::error::Error for ParseError {}

/// Reads the nearest number to a decimal, in the grammar of `f64`.
impl FromStr for DoubleDouble {
    type Err = ParseError;

    fn from_str(text: &str) -> Result<Self, ParseError> {
        // The grammar, infinities and NaN.
        let rough: f64 = text.parse().map_err(|_| ParseError)?;
        if !rough.is_finite() && text.bytes().all(|c| !c.is_ascii_digit()) {
            return Ok(Self::from(rough));
        }
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        // Beyond this every number is infinite or zero, since no text has as many digits.
        let clamped = |_| if exponent.starts_with('-') { -FARTHEST } else { FARTHEST };
        let mut exponent = exponent.parse::<i64>().unwrap_or_else(clamped).clamp(-FARTHEST, FARTHEST);
        let (mut value, mut count, mut inexact, mut after_point) = (0_u128, 0, false, false);
        for c in mantissa.bytes() {
            match c {
                b'.' => after_point = true,
                b'0'..=b'9' if count < DIGITS => {
                    value = 10 * value + u128::from(c - b'0');
                    count += usize::from(value > 0);
                    exponent -= i64::from(after_point);
                }
                b'0'..=b'9' => {
                    inexact |= c != b'0';
                    exponent += i64::from(!after_point);
                }
                _ => {}
            }
        }
        // The largest number has 309 digits before the point, the smallest 323 zeros behind it.
        let exponent = match i32::try_from(exponent) {
            Ok(exponent @ -400..=310) if value != 0 => exponent,
            _ => return Ok(Self::from(rough)),
        };
        let mut integer = Integer::new(value);
        // Room for 126 bits of the quotient.
        let shift = if exponent < 0 { 140 - (exponent * 10) / 3 } else { 0 };
        integer = integer.times_power_of_two(shift).times_power_of_ten(exponent);
        integer.inexact |= inexact;
        let size = integer.rounded(-shift);
        Ok(if mantissa.starts_with('-') { -size } else { size })
    }
}

/// A size in scientific notation: its digits and the power of ten of the first.
struct Decimal {
    digits: [u8; DIGITS],
    exponent: i32,
}

impl Decimal {
    /// A finite size above zero.
    fn new(x: DoubleDouble) -> Self {
        let (integer, power) = integer(x);
        // log₁₀ 2 ≈ 0.30103. The exponent from the bits is one too small at times.
        let mut exponent = ((integer.bits() + power - 1) * 30103).div_euclid(100_000);
        let mut scaled = scaled(integer, power, DIGITS as i32 - 1 - exponent);
        if scaled >= 10_u128.pow(DIGITS as u32) {
            exponent += 1;
            scaled = self::scaled(integer, power, DIGITS as i32 - 1 - exponent);
        }
        let mut digits = [0; DIGITS];
        for digit in digits.iter_mut().rev() {
            (*digit, scaled) = ((scaled % 10) as u8, scaled / 10);
        }
        Self { digits, exponent }
    }

    /// Rounds to so many digits, which may be none; half away from zero, as what is beyond the digits is
    /// lost.
    fn round(&mut self, count: i32) {
        let Ok(count) = usize::try_from(count) else {
            self.digits = [0; DIGITS];
            return;
        };
        let up = self.digits.get(count).is_some_and(|&digit| digit >= 5);
        for digit in self.digits.iter_mut().skip(count) {
            *digit = 0;
        }
        if !up {
            return;
        }
        for digit in self.digits.iter_mut().take(count).rev() {
            if *digit < 9 {
                *digit += 1;
                return;
            }
            *digit = 0;
        }
        self.digits[0] = 1;
        self.exponent += 1;
    }

    /// The digit that stands for a power of ten.
    fn digit(&self, power: i32) -> u8 {
        let place = usize::try_from(self.exponent - power).ok();
        place.and_then(|place| self.digits.get(place)).copied().unwrap_or(0)
    }

    /// The power of ten of the last digit that is not zero.
    fn last(&self) -> i32 {
        let zeros = self.digits.iter().rev().take_while(|&&digit| digit == 0).count();
        self.exponent + 1 - (DIGITS - zeros) as i32
    }
}

/// A number above zero as an integer times a power of two.
fn integer(x: DoubleDouble) -> (Integer, i32) {
    let parts = |x: f64| {
        let bits = x.abs().to_bits();
        let fraction = u128::from(bits & ((1 << 52) - 1));
        match (bits >> 52) as i32 {
            0 => (fraction, -1074),
            exponent => (fraction | (1 << 52), exponent - 1075),
        }
    };
    let ((high, of_high), (low, of_low)) = (parts(x.high), parts(x.low));
    if low == 0 {
        return (Integer::new(high), of_high);
    }
    // A gap of so many bits is beyond all digits that are written.
    let gap = (of_high - of_low).min(200);
    let integer = Integer::new(high).times_power_of_two(gap);
    let low = low >> (of_high - of_low - gap).min(127);
    (integer.plus(low, x.low < 0.0), of_high - gap)
}

/// An integer times powers of two and ten, rounded down.
fn scaled(integer: Integer, two: i32, ten: i32) -> u128 {
    // Factors above one come first. Of the divisions that follow, both rounded down, the second gives the
    // quotient by the product of the divisors, rounded down.
    let larger = integer.times_power_of_two(two.max(0)).times_power_of_ten(ten.max(0));
    larger.times_power_of_ten(ten.min(0)).times_power_of_two(two.min(0)).value()
}

/// A buffer that text is written into; text that does not fit is dropped.
struct Text {
    bytes: [u8; WIDEST],
    length: usize,
}

impl Text {
    fn push(&mut self, byte: u8) {
        if let Some(place) = self.bytes.get_mut(self.length) {
            *place = byte;
            self.length += 1;
        }
    }

    fn finish(&self, f: &mut fmt::Formatter<'_>, positive: bool) -> fmt::Result {
        let text = self.bytes.get(..self.length).and_then(|bytes| core::str::from_utf8(bytes).ok());
        f.pad_integral(positive, "", text.unwrap_or_default())
    }
}

impl DoubleDouble {
    /// Writes a number without digits. `None` for other numbers.
    fn special(self, f: &mut fmt::Formatter<'_>) -> Option<fmt::Result> {
        (!self.high.is_finite()).then(|| fmt::Display::fmt(&self.high, f))
    }

    fn decimal(self) -> Decimal {
        match self.high == 0.0 {
            true => Decimal { digits: [0; DIGITS], exponent: 0 },
            false => Decimal::new(Real::abs(self)),
        }
    }
}

/// 32 significant digits, or as many after the point as are asked for. Of the written digits the first 38 are
/// right; zeros follow.
impl fmt::Display for DoubleDouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(done) = self.special(f) {
            return done;
        }
        let mut decimal = self.decimal();
        let last = match f.precision() {
            Some(precision) => {
                let precision = i32::try_from(precision).unwrap_or(i32::MAX).min(MOST);
                decimal.round((decimal.exponent + 1).saturating_add(precision));
                -precision
            }
            None => {
                decimal.round(SHOWN as i32);
                decimal.last().min(0)
            }
        };
        // As with `f64`, large and small numbers are written in full, without an exponent.
        let mut text = Text { bytes: [0; WIDEST], length: 0 };
        for power in (last..=decimal.exponent.max(0)).rev() {
            if power == -1 {
                text.push(b'.');
            }
            text.push(b'0' + decimal.digit(power));
        }
        text.finish(f, self.high.is_sign_positive())
    }
}

/// Scientific notation: 32 significant digits, or as many after the point as are asked for.
impl fmt::LowerExp for DoubleDouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(done) = self.special(f) {
            return done;
        }
        let mut decimal = self.decimal();
        let after = match f.precision() {
            Some(precision) => {
                let precision = i32::try_from(precision).unwrap_or(i32::MAX).min(MOST);
                decimal.round(precision.saturating_add(1));
                precision
            }
            None => {
                decimal.round(SHOWN as i32);
                (decimal.exponent - decimal.last()).max(0)
            }
        };
        let mut text = Text { bytes: [0; WIDEST], length: 0 };
        for place in 0..=after {
            if place == 1 {
                text.push(b'.');
            }
            text.push(b'0' + decimal.digit(decimal.exponent - place));
        }
        text.push(b'e');
        if decimal.exponent < 0 {
            text.push(b'-');
        }
        let size = decimal.exponent.unsigned_abs();
        for divisor in [100, 10, 1] {
            if size >= divisor || divisor == 1 {
                text.push(b'0' + (size / divisor % 10) as u8);
            }
        }
        text.finish(f, self.high.is_sign_positive())
    }
}

/// As [`fmt::Display`] for zero and sizes from 1e-5 to 1e16, else in scientific notation.
impl fmt::Debug for DoubleDouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.high.abs();
        if size == 0.0 || (1e-5..1e16).contains(&size) {
            fmt::Display::fmt(self, f)
        } else {
            fmt::LowerExp::fmt(self, f)
        }
    }
}
