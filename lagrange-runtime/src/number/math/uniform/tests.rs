//! Every argument gives the bits of the `libm` crate, beside its branches most of all.

use super::*;
use crate::linear::samples::Noise;

fn check(x: f64) {
    for x in [x, -x] {
        let bits = |(s, c): (f64, f64)| [s.to_bits(), c.to_bits()];
        let (found, expected) = (sin_cos(x), libm::sincos(x));
        if expected.0.is_nan() {
            assert!(found.0.is_nan() && found.1.is_nan(), "{x:e}: {found:?}");
        } else {
            assert_eq!(bits(found), bits(expected), "{x:e}: {found:?} and not {expected:?}");
            assert_eq!(bits(found), bits((libm::sin(x), libm::cos(x))), "{x:e}");
        }
    }
}

#[test]
fn ends_of_branches_have_the_bits_of_libm() {
    let tiny = [0, 1, 1 << 20, 1 << 52].map(f64::from_bits);
    [f64::INFINITY, f64::NAN, f64::MAX, 1e300].into_iter().chain(tiny).for_each(check);
    // π/4, 3π/4, 5π/4, 7π/4: where `libm` goes over to the next multiple.
    let turns = [upper::QUARTER, 0x4002_D97C, 0x400F_6A7A, 0x4015_FDBC];
    let ends = [upper::TINY, upper::NEAR, upper::LARGE, 0x3E50_0000];
    for word in turns.into_iter().chain(ends).chain(upper::MULTIPLES) {
        for near in word - 2..=word + 2 {
            for low in [0, 1, 0x5442_D180, 0x7FFF_FFFF, 0x8000_0000, 0xFFFF_FFFF] {
                check(f64::from_bits(u64::from(near) << 32 | low));
            }
        }
    }
}

/// Multiples of π/2 lose bits of the reduced angle, the more the nearer the argument is.
#[test]
fn multiples_of_a_quarter_turn_have_the_bits_of_libm() {
    for n in (1..2000).chain((0..40).map(|k| 1_000_000 - k * k * 611)) {
        let multiple = f64::from(n) * core::f64::consts::FRAC_PI_2;
        for power in 0..52 {
            for sign in [-1, 1] {
                check(f64::from_bits(multiple.to_bits().wrapping_add_signed(sign << power)));
            }
        }
        check(multiple);
    }
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn random_angles_have_the_bits_of_libm() {
    let mut noise = Noise(7);
    for scale in [1e-12, 1e-8, 1e-3, 1.0, 4.0, 8.0, 100.0, 1e4, 1.6e6, 1e8] {
        for _ in 0..20_000 {
            let [x]: [f64; 1] = noise.vector();
            check(scale * x);
        }
    }
}
