//! Integers of two thousand bits: enough for a decimal number of any exponent in the range of `f64`.

use super::DoubleDouble;
use super::arithmetic::power_of_two;

const WORDS: usize = 64;

/// An integer, the lowest words first, and whether something was cut off below it.
#[derive(Clone, Copy)]
pub(super) struct Integer {
    words: [u32; WORDS],
    pub inexact: bool,
}

impl Integer {
    pub(super) fn new(value: u128) -> Self {
        let mut words = [0; WORDS];
        for (k, word) in words.iter_mut().take(4).enumerate() {
            *word = (value >> (32 * k)) as u32;
        }
        Self { words, inexact: false }
    }

    /// The lowest 128 bits.
    pub(super) fn value(&self) -> u128 {
        self.words.iter().take(4).rev().fold(0, |value, &word| (value << 32) | u128::from(word))
    }

    /// How many bits it takes.
    pub(super) fn bits(&self) -> i32 {
        let zeros = self.words.iter().rev().take_while(|&&word| word == 0).count();
        let top = self.words.iter().rev().find(|&&word| word != 0).map_or(0, |word| word.leading_zeros());
        32 * (WORDS - zeros) as i32 - top as i32
    }

    fn times_small(&mut self, factor: u32, mut carry: u64) {
        for word in &mut self.words {
            carry += u64::from(*word) * u64::from(factor);
            *word = carry as u32;
            carry >>= 32;
        }
    }

    fn over_small(&mut self, divisor: u32) {
        let divisor = u64::from(divisor.max(1));
        let mut rest = 0_u64;
        for word in self.words.iter_mut().rev() {
            let part = (rest << 32) | u64::from(*word);
            (*word, rest) = ((part / divisor) as u32, part % divisor);
        }
        self.inexact |= rest != 0;
    }

    /// Times 10 to a power, rounded down.
    pub(super) fn times_power_of_ten(mut self, power: i32) -> Self {
        const NINE: u32 = 9;
        let mut left = power.unsigned_abs();
        while left > 0 {
            let part = left.min(NINE);
            let factor = 10_u32.pow(part);
            if power > 0 {
                self.times_small(factor, 0)
            } else {
                self.over_small(factor)
            }
            left -= part;
        }
        self
    }

    /// Times 2 to a power, rounded down.
    pub(super) fn times_power_of_two(mut self, power: i32) -> Self {
        const MOST: u32 = 31;
        let mut left = power.unsigned_abs();
        while left > 0 {
            let part = left.min(MOST);
            if power > 0 {
                self.times_small(1 << part, 0)
            } else {
                self.over_small(1 << part)
            }
            left -= part;
        }
        self
    }

    /// A sum or difference with a number below 2¹²⁸; the integer is the larger of the two.
    pub(super) fn plus(mut self, other: u128, subtract: bool) -> Self {
        let mut carry = i64::from(false);
        for (k, word) in self.words.iter_mut().enumerate() {
            let of_other = if k < 4 { i64::from((other >> (32 * k)) as u32) } else { 0 };
            carry += i64::from(*word) + if subtract { -of_other } else { of_other };
            *word = carry as u32;
            carry >>= 32;
        }
        self
    }

    /// The number of two doubles that is nearest to this times 2 to a power.
    pub(super) fn rounded(&self, power: i32) -> DoubleDouble {
        let excess = self.bits() - 126;
        let top = self.times_power_of_two(-excess);
        // The last bit stands for the bits that were cut off, so that they break ties. It is far below the
        // last bits of both doubles.
        let leading = top.value() | u128::from(top.inexact);
        let high = leading as f64;
        let low = (leading as i128 - high as i128) as f64;
        let exponent = power + excess;
        let (first, second) = (power_of_two(exponent / 2), power_of_two(exponent - exponent / 2));
        DoubleDouble { high, low }.scaled(first).scaled(second)
    }
}
