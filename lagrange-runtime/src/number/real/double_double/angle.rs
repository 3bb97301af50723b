//! Angles in quarter turns, in integers: M. H. Payne, R. N. Hanek, *Radian reduction for trigonometric
//! functions*, SIGNUM Newsletter 18 (1983) 19.

use crate::number::elements::{Each, array};

/// The number of words in the fraction of a fixed-point number. One more word is its integer part. The
/// lowest words come first.
const FRACTION: usize = 5;

/// A fixed-point number modulo 2⁶⁴, negative ones in two's complement.
type Fixed = [u64; FRACTION + 1];

/// The first 1344 bits of 2/π after the point, by mpmath: 971 for the largest exponent, 53 for a mantissa,
/// 320 for the fraction.
const TWO_OVER_PI: [u64; 21] = [
    0xa2f9_836e_4e44_1529,
    0xfc27_57d1_f534_ddc0,
    0xdb62_9599_3c43_9041,
    0xfe51_63ab_debb_c561,
    0xb724_6e3a_424d_d2e0,
    0x0649_2eea_09d1_921c,
    0xfe1d_eb1c_b129_a73e,
    0xe882_35f5_2ebb_4484,
    0xe99c_7026_b45f_7e41,
    0x3991_d639_8353_39f4,
    0x9c84_5f8b_bdf9_283b,
    0x1ff8_97ff_de05_980f,
    0xef2f_118b_5a0a_6d1f,
    0x6d36_7ecf_27cb_09b7,
    0x4f46_3f66_9e5f_ea2d,
    0x7527_bac7_ebe5_f17b,
    0x3d07_39f7_8a52_92ea,
    0x6bfb_5fb1_1f8d_5d08,
    0x5603_3046_fc7b_6bab,
    0xf0cf_bc20_9af4_361d,
    0xa9e3_9161_5ee6_1b08,
];

/// The multiple of a quarter turn that is nearest to `high` + `low` radians, modulo four, and what is left:
/// whether it is negative, the zeros of its fraction before the first bit, and the 128 bits from there.
///
/// Bits of 2⁻²⁶⁶ and more are right. No sum of two doubles with 107 bits in this range is expected to come
/// closer to a multiple than 2⁻¹³⁰, because there are fewer than 2¹³⁰ of them. So the 128 bits are right.
pub(super) fn nearest_quarter(high: f64, low: f64) -> (u64, bool, u32, u128) {
    let mut turns = sum(quarter_turns(high), quarter_turns(low));
    let mut quadrant = turns[FRACTION];
    let negative = turns[FRACTION - 1] >> 63 == 1;
    if negative {
        quadrant = quadrant.wrapping_add(1);
        turns = opposite(turns);
    }
    turns[FRACTION] = 0;
    let (zeros, bits) = leading_bits(&turns);
    (quadrant & 3, negative, zeros, bits)
}

/// x · 2/π for a finite x, modulo 2⁶⁴.
fn quarter_turns(x: f64) -> Fixed {
    let bits = x.to_bits();
    let exponent = ((bits >> 52) & 0x7ff) as i32;
    let fraction = bits & ((1 << 52) - 1);
    let (mantissa, exponent) = match exponent {
        0 => (fraction, -1074),
        normal => (fraction | (1 << 52), normal - 1075),
    };
    // x = mantissa · 2^exponent. Bits of 2/π · 2^exponent of weight 2⁶⁴ and more give multiples of 2⁶⁴, which
    // are left out.
    let mut product = [0; FRACTION + 1];
    let mut carry = 0_u128;
    for (place, word) in product.iter_mut().enumerate() {
        // Bit 63 of this word has the weight 2^(64 (place − FRACTION) + 63) in 2/π · 2^exponent.
        let first = exponent - 63 - 64 * (place as i32 - FRACTION as i32);
        carry += u128::from(mantissa) * u128::from(bits_of_two_over_pi(first));
        *word = carry as u64;
        carry >>= 64;
    }
    if x.is_sign_negative() { opposite(product) } else { product }
}

/// 64 bits of 2/π, the first of them of weight 2^−first.
fn bits_of_two_over_pi(first: i32) -> u64 {
    let word = |index: i32| {
        usize::try_from(index).ok().and_then(|index| TWO_OVER_PI.get(index)).copied().unwrap_or(0)
    };
    // The bit of weight ½ stands first.
    let (index, shift) = ((first - 1).div_euclid(64), (first - 1).rem_euclid(64) as u32);
    let both = (u128::from(word(index)) << 64) | u128::from(word(index + 1));
    (both >> (64 - shift)) as u64
}

fn sum(a: Fixed, b: Fixed) -> Fixed {
    let mut sum = a;
    let mut carry = 0_u128;
    for (to, from) in sum.iter_mut().zip(b) {
        carry += u128::from(*to) + u128::from(from);
        *to = carry as u64;
        carry >>= 64;
    }
    sum
}

fn opposite(x: Fixed) -> Fixed {
    sum(x.each(|word| !word), [1, 0, 0, 0, 0, 0])
}

/// The zeros of a fraction before its first bit, and the 128 bits from there.
fn leading_bits(x: &Fixed) -> (u32, u128) {
    let mut words = x.iter().take(FRACTION).rev().copied().chain([0, 0]);
    let mut zeros = 0;
    let mut first = 0;
    for word in words.by_ref() {
        first = word;
        if word != 0 {
            break;
        }
        zeros += 64;
    }
    let [second, third] = array(|_| words.next().unwrap_or(0));
    let shift = first.leading_zeros();
    let top = (u128::from(first) << 64) | u128::from(second);
    match shift {
        64 => (zeros, 0),
        0 => (zeros, top),
        shift => (zeros + shift, (top << shift) | u128::from(third >> (64 - shift))),
    }
}
