//! Functions of `f64` for threads in step: the same instructions for every argument, and the bits of the
//! `libm` crate.
//!
//! The threads of a warp of a graphics processor share one instruction at a time, so a branch that depends on
//! the argument costs both of its sides. `libm` has a branch for each quarter turn up to 9π/4.
//!
//! The method is that of `libm`, which is Sun's fdlibm (`e_rem_pio2.c`, `k_sin.c`, `k_cos.c`): x = n π/2 + y
//! after Cody and Waite, and a polynomial in y for each function. Choices replace branches. The two that
//! remain are of arguments beyond 2²⁰ quarter turns and of those next to a multiple of π/2.

use core::hint::select_unpredictable as choose;

/// 53 bits of 2/π.
const INVERSE: f64 = f64::from_bits(0x3FE4_5F30_6DC9_C883);

/// Added and subtracted, it rounds a number to an integer.
const TO_INTEGER: f64 = 1.5 / f64::EPSILON;

/// π/2 in parts of 33 bits, each with what is left of π/2 after it.
const HALF_PI: [[f64; 2]; 3] = [
    [f64::from_bits(0x3FF9_21FB_5440_0000), f64::from_bits(0x3DD0_B461_1A62_6331)],
    [f64::from_bits(0x3DD0_B461_1A60_0000), f64::from_bits(0x3BA3_198A_2E03_7073)],
    [f64::from_bits(0x3BA3_198A_2E00_0000), f64::from_bits(0x397B_839A_2520_49C1)],
];

/// Coefficients of the sine, of y³ and higher odd powers.
const SINE: [f64; 6] = [
    f64::from_bits(0xBFC5_5555_5555_5549),
    f64::from_bits(0x3F81_1111_1110_F8A6),
    f64::from_bits(0xBF2A_01A0_19C1_61D5),
    f64::from_bits(0x3EC7_1DE3_57B1_FE7D),
    f64::from_bits(0xBE5A_E5E6_8A2B_9CEB),
    f64::from_bits(0x3DE5_D93A_5ACF_D57C),
];

/// Coefficients of the cosine, of y⁴ and higher even powers.
const COSINE: [f64; 6] = [
    f64::from_bits(0x3FA5_5555_5555_554C),
    f64::from_bits(0xBF56_C16C_16C1_5177),
    f64::from_bits(0x3EFA_01A0_19CB_1590),
    f64::from_bits(0xBE92_7E4F_809C_52AD),
    f64::from_bits(0x3E21_EE9E_BDB4_B1C4),
    f64::from_bits(0xBDA8_FAE9_BE88_38D4),
];

/// The upper words, without the sign, at which `libm` goes another way.
mod upper {
    /// Below it the sine is the argument.
    pub const TINY: u32 = 0x3E46_A09E;
    /// π/4: up to here nothing is subtracted.
    pub const QUARTER: u32 = 0x3FE9_21FB;
    /// 3π/2.
    pub const THREE_HALVES: u32 = 0x4012_D97C;
    /// 9π/4: up to here the multiple of π/2 follows from the upper word alone.
    pub const NEAR: u32 = 0x401C_463B;
    /// The words of the multiples of π/2 up to there. An argument with one of them may need more parts of it.
    pub const MULTIPLES: [u32; 4] = [0x3FF9_21FB, 0x4009_21FB, THREE_HALVES, 0x4019_21FB];
    /// 2²⁰ π/2: from here on π/2 needs more bits.
    pub const LARGE: u32 = 0x4139_21FB;
}

/// The upper half of a number, without its sign.
fn upper(x: f64) -> u32 {
    ((x.to_bits() >> 32) & 0x7FFF_FFFF) as u32
}

/// The sine and the cosine of an angle \[rad]. A function of its own: a processor reads its code again and
/// again from a small cache, and the caller stays small enough to be put into its own callers.
#[inline(never)]
pub(crate) fn sin_cos(x: f64) -> (f64, f64) {
    let size = upper(x);
    if size >= upper::LARGE {
        return libm::sincos(x);
    }
    let (turns, [y, rest]) = reduced(x, size);
    let squared = y * y;
    let (s, c) = (sine(y, rest, squared, size <= upper::QUARTER), cosine(y, rest, squared));
    let s = choose(size < upper::TINY, x, s);
    let is_swapped = turns & 1 == 1;
    let (s, c) = (choose(is_swapped, c, s), choose(is_swapped, s, c));
    (choose(turns & 2 == 2, -s, s), choose((turns + 1) & 2 == 2, -c, c))
}

/// The multiple of π/2 next to `x`, and the difference from it as a sum of two numbers.
#[inline]
fn reduced(x: f64, size: u32) -> (i32, [f64; 2]) {
    let is_near = size <= upper::NEAR;
    // The bounds of `libm` are the words of π/4, 3π/4 and 5π/4, but the words after those of 7π/4 and 9π/4.
    let word = (x.to_bits() >> 32) - u64::from(size > upper::THREE_HALVES);
    let rough = choose(is_near, f64::from_bits(word << 32), x);
    let n = (rough * INVERSE + TO_INTEGER) - TO_INTEGER;
    let [[first, after_first], ..] = HALF_PI;
    let (mut r, mut w) = (x - n * first, n * after_first);
    let mut y = r - w;
    // What the first part leaves has too few bits beside a multiple.
    if lost(size, y) > 16 && (!is_near || upper::MULTIPLES.contains(&size)) {
        [y, r, w] = next(r, n, HALF_PI[1]);
        if lost(size, y) > 49 {
            [y, r, w] = next(r, n, HALF_PI[2]);
        }
    }
    (n as i32, [y, (r - y) - w])
}

/// The number of leading bits in which a number and its multiple of π/2 agree.
#[inline]
fn lost(size: u32, y: f64) -> i32 {
    (size >> 20).cast_signed() - (upper(y) >> 20).cast_signed()
}

/// Subtracts n times another part of π/2 from what is left: the difference, and the two terms of it.
#[inline]
fn next(left: f64, n: f64, [part, after]: [f64; 2]) -> [f64; 3] {
    let subtracted = n * part;
    let r = left - subtracted;
    let w = n * after - ((left - r) - subtracted);
    [r - w, r, w]
}

/// The sine of `y` + `rest`, for |y| up to π/4. With `alone` there is no rest.
#[inline]
fn sine(y: f64, rest: f64, z: f64, alone: bool) -> f64 {
    let [c3, c5, c7, c9, c11, c13] = SINE;
    let r = c5 + z * (c7 + z * c9) + z * (z * z) * (c11 + z * c13);
    let v = z * y;
    let direct = y + v * (c3 + z * r);
    let with_rest = y - ((z * (0.5 * rest - v * r) - rest) - v * c3);
    choose(alone, direct, with_rest)
}

/// The cosine of `y` + `rest`, for |y| up to π/4.
#[inline]
fn cosine(y: f64, rest: f64, z: f64) -> f64 {
    let [c4, c6, c8, c10, c12, c14] = COSINE;
    let w = z * z;
    let r = z * (c4 + z * (c6 + z * c8)) + w * w * (c10 + z * (c12 + z * c14));
    let half = 0.5 * z;
    let w = 1.0 - half;
    w + (((1.0 - w) - half) + (z * r - y * rest))
}

#[cfg(test)]
mod tests;
