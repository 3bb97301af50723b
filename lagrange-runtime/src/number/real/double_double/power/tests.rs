//! Powers against integer arithmetic.

extern crate std;

use std::vec;
use std::vec::Vec;

use super::*;
use crate::Real;

/// A positive integer of any size, the lowest words first, times 2 to a power.
struct Exact(Vec<u32>, i32);

impl Exact {
    fn times(&self, factor: u128, power: i32) -> Self {
        let mut product = vec![0_u32; self.0.len() + 4];
        for (k, &word) in self.0.iter().enumerate() {
            let mut carry = 0_u64;
            for (i, sum) in product[k..].iter_mut().enumerate() {
                let part = if i < 4 { u64::from((factor >> (32 * i)) as u32) } else { 0 };
                carry += u64::from(*sum) + u64::from(word) * part;
                *sum = carry as u32;
                carry >>= 32;
            }
        }
        Self(product, self.1 + power)
    }

    /// With a lower power of two.
    fn lowered(&self, power: i32) -> Self {
        let bits = (self.1 - power) as u32;
        let mut words = vec![0; bits as usize / 32];
        words.extend(&self.0);
        Self(words, power).times(1 << (bits % 32), 0)
    }

    /// The leading 64 bits, and the power of two that they are to be taken with.
    fn leading(&self) -> (f64, i32) {
        let top = self.0.iter().rposition(|&word| word != 0).unwrap_or(0);
        let word = |k: usize| if k <= top { f64::from(self.0[top - k]) } else { 0.0 };
        let unit = 2.0_f64.powi(-32);
        (word(0) + unit * (word(1) + unit * word(2)), self.1 + 32 * top as i32)
    }

    /// |self − other| as a part of the other.
    fn error(&self, other: &Self) -> f64 {
        let power = self.1.min(other.1);
        let [mut a, mut b] = [self.lowered(power), other.lowered(power)];
        let length = a.0.len().max(b.0.len());
        a.0.resize(length, 0);
        b.0.resize(length, 0);
        let of_other = b.leading();
        if a.0.iter().rev().lt(b.0.iter().rev()) {
            core::mem::swap(&mut a, &mut b);
        }
        let mut borrow = 0_i64;
        for (a, &b) in a.0.iter_mut().zip(&b.0) {
            borrow += i64::from(*a) - i64::from(b);
            *a = borrow as u32;
            borrow >>= 32;
        }
        let of_difference = a.leading();
        of_difference.0 / of_other.0 * 2.0_f64.powi(of_difference.1 - of_other.1)
    }
}

/// A positive number as an integer and a power of two, to 2⁻¹¹³ of it.
fn integer(x: DoubleDouble) -> (u128, i32) {
    let power = ((x.high.to_bits() >> 52) as i32) - 1075;
    let unit = 2.0_f64.powi(power);
    let (high, low) = ((x.high / unit) as i128, (x.low / unit * (1_u64 << 60) as f64) as i128);
    (((high << 60) + low) as u128, power - 60)
}

/// The error of a power as a part of what `book/src/accuracy.md` allows.
fn part_of_bound(x: DoubleDouble, k: i32) -> f64 {
    let (base, of_base) = integer(x);
    let (value, of_value) = integer(x.powi(k));
    let (value, one) = (Exact(vec![1], 0).times(value, of_value), Exact(vec![1], 0));
    let power = |from| (0..k.unsigned_abs()).fold(from, |power: Exact, _| power.times(base, of_base));
    let error = if k < 0 { power(value).error(&one) } else { value.error(&power(one)) };
    let condition = 1.0 + (f64::from(k) * x.high.ln()).abs();
    error / (3.0 * f64::EPSILON * f64::EPSILON * condition)
}

/// Uniform in \[0, 1).
fn random(state: &mut u64) -> f64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

#[test]
fn powers_keep_the_bound_of_the_book() {
    let mut state = 88172645463325252;
    // A number for which repeated multiplication has an error of 3.5 times the bound.
    let found = DoubleDouble::from_sum(1.0067859540054094, -6.074852771012601e-17);
    assert!(part_of_bound(found, 53) < 0.1, "{}", part_of_bound(found, 53));
    let mut worst = [0.0_f64; 2];
    for (draw, spread) in (0..400).zip([0.1, 0.1, 0.1, 1.0].into_iter().cycle()) {
        let [a, b, c] = [(); 3].map(|()| random(&mut state));
        let x = DoubleDouble::from_sum(1.0 + (a - 0.5) * spread, (b - 0.5) * 1e-16);
        // Small exponents more often: they go another way.
        let k = (c * if draw % 2 == 0 { 13.0 } else { 129.0 }).floor() as i32;
        let k = if draw % 2 == 0 { k - 6 } else { k - 64 };
        let part = part_of_bound(x, k);
        let of = &mut worst[usize::from(k.abs() > 4)];
        *of = of.max(part);
    }
    assert!(worst[0] < 0.9 && worst[1] < 0.25, "{worst:?}");
}

#[test]
fn powers_of_integers_are_exact() {
    let power = |base: i32, k: i32| DoubleDouble::from(base).powi(k);
    let exact = |value: u128| {
        let high = value as f64;
        DoubleDouble::from_sum(high, (value as i128 - high as i128) as f64)
    };
    for k in 0..67 {
        assert_eq!(power(3, k), exact(3_u128.pow(k as u32)), "3 to {k}");
    }
    assert_eq!(power(-3, 65), -exact(3_u128.pow(65)));
    assert_eq!(power(2, -1000), DoubleDouble::from(2.0_f64.powi(-1000)));
}

/// The ends of the range, as of `f64`; and a power whose inverse has lost digits to underflow.
#[test]
fn powers_at_the_ends_of_the_range() {
    let powers = [i32::MIN, -1001, -8, -3, -2, -1, 0, 1, 2, 3, 4, 5, 8, 1001, i32::MAX];
    for x in [0.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1e300, 1e-300, 1.0, -1.0, 1.7e308, 5e-324] {
        for k in powers {
            let (value, expected) = (DoubleDouble::from(x).powi(k), x.powi(k));
            let close = (value.high - expected).abs() <= 1e-12 * expected.abs();
            let is_nan = value.high.is_nan() && expected.is_nan();
            assert!(value.high == expected || close || is_nan, "{x:e} to {k}: {value:?}, {expected:e}");
            assert!(value.low == 0.0 || value.is_finite(), "{x:e} to {k}: {value:?}");
        }
    }
    let third = DoubleDouble::from(1e-50) / DoubleDouble::from(3);
    for (x, k) in [(third, -6), (third, -5), (third, -1), (third * third * third, -2), (third * third, -3)] {
        let expected = DoubleDouble::ONE / x;
        let error = (x.powi(k) / expected.powi(-k) - DoubleDouble::ONE).abs();
        assert!(error.high < 30.0 * f64::EPSILON * f64::EPSILON, "{x} to {k}: {error}");
    }
}
