//! Against the functions of `f64`, rounded.

extern crate std;
use super::*;

/// The distance of two neighbours at `x`.
fn unit(x: f64) -> f64 {
    let size = (x.abs() as f32).max(f32::MIN_POSITIVE);
    f64::from(f32::EPSILON) * f64::from(f32::from_bits(size.to_bits() & 0x7f80_0000))
}

/// The largest error in units of the last place, over arguments of both signs from `low` to `high`.
fn worst(function: fn(f32) -> f32, exact: fn(f64) -> f64, low: f32, high: f32) -> f64 {
    let mut worst = 0.0_f64;
    // The step is prime, so that all patterns of the low bits occur.
    for bits in (low.to_bits()..=high.to_bits()).step_by(12_373) {
        for x in [f32::from_bits(bits), -f32::from_bits(bits)] {
            let expected = exact(f64::from(x));
            let error = (f64::from(function(x)) - expected).abs() / unit(expected);
            assert!(error.is_finite(), "{x:e}: {} against {expected}", function(x));
            worst = worst.max(error);
        }
    }
    worst
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn circular_functions() {
    for (low, high) in [(1e-38, 0.8), (0.8, 2048.0), (2048.0, 1e6), (1e6, f32::MAX)] {
        assert!((0.5..2.7).contains(&worst(sinf, f64::sin, low, high)));
        assert!((0.5..2.7).contains(&worst(cosf, f64::cos, low, high)));
        assert!((0.5..4.7).contains(&worst(tanf, f64::tan, low, high)));
    }
    assert!((0.5..2.6).contains(&worst(asinf, f64::asin, 1e-38, 1.0)));
}

#[test]
fn multiples_of_a_quarter_turn_keep_their_digits() {
    for turns in [1_u32, 2, 3, 100, 1303, 1304, 1305, 1 << 20, u32::MAX] {
        let x = turns as f32 * FRAC_PI_2;
        let (sin, cos) = (f64::from(x).sin(), f64::from(x).cos());
        assert!((f64::from(sinf(x)) - sin).abs() < 3.0 * unit(sin), "sin {x}");
        assert!((f64::from(cosf(x)) - cos).abs() < 3.0 * unit(cos), "cos {x}");
    }
}

#[test]
#[cfg_attr(miri, ignore = "the root of libm is in assembly")]
fn what_is_not_finite_has_no_sine() {
    for x in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
        let (sin, cos) = sincosf(x);
        assert!(sin.is_nan() && cos.is_nan() && tanf(x).is_nan(), "{x}");
    }
    assert!(asinf(1.1).is_nan());
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn cube_roots() {
    assert!((0.5..1.0).contains(&worst(cbrtf, f64::cbrt, f32::from_bits(1), f32::MAX)));
    assert_eq!((cbrtf(27.0), cbrtf(-8.0), cbrtf(0.0)), (3.0, -2.0, 0.0));
    assert!(cbrtf(f32::NAN).is_nan() && cbrtf(f32::INFINITY).is_infinite());
}

#[test]
#[cfg_attr(miri, ignore = "the root of libm is in assembly")]
fn hypotenuses_of_any_size() {
    for scale in [1e-30, 1.0, 1e37] {
        for (x, y) in [(3.0, 4.0), (-5.0, 12.0), (1.0, 1e-9), (0.0, 7.0), (0.7, 0.7)] {
            let expected = f64::from(x * scale).hypot(f64::from(y * scale));
            assert!((f64::from(hypotf(x * scale, y * scale)) - expected).abs() < 2.0 * unit(expected));
        }
    }
    assert_eq!(hypotf(0.0, -0.0), 0.0);
    assert!(hypotf(f32::NAN, 1.0).is_nan() && hypotf(1.0, f32::NAN).is_nan());
    assert!(hypotf(f32::NAN, f32::INFINITY).is_infinite());
}
