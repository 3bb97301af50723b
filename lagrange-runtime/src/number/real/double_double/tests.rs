//! Operations against integers and identities that doubles cannot fake; the table of functions stands in
//! `tests/digits.rs` of the facade.

use super::arithmetic::{split_product, two_product};
use super::*;
use crate::Ordered;

fn number(text: &str) -> DoubleDouble {
    text.parse().unwrap()
}

/// Whether two numbers agree to so many roundings (2⁻¹⁰⁶) of the first.
fn close(a: DoubleDouble, b: DoubleDouble, roundings: f64) -> bool {
    (a - b).abs().high() <= roundings * f64::EPSILON * f64::EPSILON * 0.25 * a.high().abs()
}

#[test]
fn products_of_doubles_are_exact() {
    // (2⁵³ − 1)² = 2¹⁰⁶ − 2⁵⁴ + 1.
    let odd = ((1_u64 << 53) - 1) as f64;
    for product in [two_product(odd, odd), split_product(odd, odd)] {
        let sum = DoubleDouble::from_sum(product.high, product.low);
        let expected = DoubleDouble::from_sum((1_u128 << 106) as f64 - (1_u64 << 54) as f64, 1.0);
        assert_eq!(sum, expected);
    }
    for (a, b) in [(1e300, 3e-5), (1.7e308, 0.7), (-1e308, 1e-308), (3e300, 5e7)] {
        let (split, expected) = (split_product(a, b), a.mul_add(b, -(a * b)));
        assert_eq!((split.high, split.low), (a * b, expected), "{a} {b}");
    }
}

#[test]
fn nothing_is_lost_where_sums_cancel() {
    let (third, near) = (number("1") / number("3"), number("0.33333333333333333333"));
    // 1/3 − 0.33333333333333333333 = 3.33…e-21, to the rounding of 1/3.
    assert!(((third - near) / number("3.3333333333333333e-21") - DoubleDouble::ONE).abs().high() < 1e-11);
    let tiny = DoubleDouble::from(1e-25);
    assert_eq!((DoubleDouble::ONE + tiny) - DoubleDouble::ONE, tiny);
}

#[test]
fn quotients_roots_and_sums_of_products() {
    for k in 1..200 {
        let x = DoubleDouble::from(k) / DoubleDouble::from(7);
        let root = x.sqrt();
        assert!(close(root * root, x, 12.0), "{x}");
        assert!(close(x.cbrt().powi(3), x, 24.0), "{x}");
        assert!(close((x / root) * root, x, 16.0), "{x}");
        assert!(close(x.mul_add(root, x), x * root + x, 16.0), "{x}");
    }
}

/// As in `f64`: no NaN where there is a limit, and no numbers where there is none.
#[test]
fn infinities_and_nan_behave_as_those_of_doubles() {
    let [inf, one, zero, large] = [f64::INFINITY, 1.0, 0.0, 1e300].map(DoubleDouble::from);
    for (result, expected) in [
        (inf + one, f64::INFINITY),
        (inf - inf, f64::NAN),
        (inf * -one, f64::NEG_INFINITY),
        (inf * zero, f64::NAN),
        (one / zero, f64::INFINITY),
        (one / inf, 0.0),
        (large * large, f64::INFINITY),
        (large + large, 2e300),
        (large.mul_add(large, one), f64::INFINITY),
        (inf.sqrt(), f64::INFINITY),
        ((-one).sqrt(), f64::NAN),
        (zero.sqrt(), 0.0),
        (inf.exp(), f64::INFINITY),
        ((-inf).exp(), 0.0),
        (DoubleDouble::from(-1e4).exp_m1(), -1.0),
        (zero.ln(), f64::NEG_INFINITY),
        ((-one).ln(), f64::NAN),
        ((-one).ln_1p(), f64::NEG_INFINITY),
        (inf.sin(), f64::NAN),
        (inf.tanh(), 1.0),
        (inf.asinh(), f64::INFINITY),
        (zero.powf(zero), 1.0),
        (DoubleDouble::from(-8).powf(DoubleDouble::from(0.5)), f64::NAN),
        (inf.hypot(DoubleDouble::from(f64::NAN)), f64::INFINITY),
        (zero.recip(), f64::INFINITY),
    ] {
        assert!(
            result.high() == expected || (result.high().is_nan() && expected.is_nan()),
            "{result:?} {expected}"
        );
        assert!(result.high().is_finite() || result.low() == 0.0, "{result:?}");
    }
    assert!(!inf.is_finite() && inf > large && DoubleDouble::from(f64::NAN).partial_cmp(&zero).is_none());
    assert_eq!(DoubleDouble::from(f64::NAN).max(one), one);
}

#[test]
fn angles_of_the_axes() {
    let signed = |x: f64| DoubleDouble::from(x);
    let half = DoubleDouble::FRAC_PI_2;
    assert_eq!(signed(1.0).atan2(signed(0.0)), half);
    assert_eq!(signed(-1.0).atan2(signed(0.0)), -half);
    assert_eq!(signed(0.0).atan2(signed(-1.0)), DoubleDouble::PI);
    assert_eq!(signed(-0.0).atan2(signed(-1.0)), -DoubleDouble::PI);
    assert_eq!(signed(f64::INFINITY).atan2(signed(f64::INFINITY)), half.scaled(0.5));
    assert!(signed(-0.0).atan2(signed(1.0)).high().is_sign_negative());
    assert_eq!(signed(-1.0).acos(), DoubleDouble::PI);
}

#[test]
fn decimals_are_read_and_written_exactly() {
    for text in
        ["0.1", "-9.81", "6.62607015e-34", "1e22", "123456789.123456789123456789", "1e-300", "17", "1e300"]
    {
        let x = number(text);
        assert_eq!(x.high(), text.parse::<f64>().unwrap(), "{text}");
        assert_eq!(number(&std::format!("{x}")), x, "{text}");
        assert_eq!(number(&std::format!("{x:e}")), x, "{text}");
    }
    assert_eq!((number("0.1").low(), number("9.81").low()), (-5.551115123125783e-18, -4.973799150320702e-16));
    let third = DoubleDouble::ONE / DoubleDouble::from(3);
    assert_eq!(std::format!("{third}"), "0.33333333333333333333333333333333");
    assert_eq!(std::format!("{third:.3} {:.0} {:.2}", number("2.5"), number("0.0006")), "0.333 3 0.00");
    assert_eq!(std::format!("{:.2} {:>6.1}|", number("9.999"), number("-0.25")), "10.00   -0.3|");
    assert_eq!(std::format!("{:.3e} {:e}", number("9.9996"), number("-0.00125")), "1.000e1 -1.25e-3");
    assert_eq!(std::format!("{:?} {}", number("1e-7"), number("-inf")), "1e-7 -inf");
    assert_eq!(std::format!("{}", DoubleDouble::from_sum(1.0, 1e-300)), "1");
    assert_eq!(number("1e400").high(), f64::INFINITY);
    assert_eq!(number("-0").high().to_bits(), (-0.0_f64).to_bits());
    let zeros = "0".repeat(100_001);
    assert_eq!(number(&std::format!("1{zeros}e-100001")), DoubleDouble::ONE);
    assert_eq!(number(&std::format!("0.{zeros}1e+100002")), DoubleDouble::ONE);
    assert_eq!(number("1e-99999999999999999999999").high(), 0.0);
    assert_eq!(number("1e99999999999999999999999").high(), f64::INFINITY);
    for wrong in ["", "1.2.3", "0x10", "1e", "twelve"] {
        assert_eq!(wrong.parse::<DoubleDouble>(), Err(ParseError), "{wrong}");
    }
}

/// The order that step size control needs.
#[test]
fn it_is_ordered() {
    fn ordered<R: Ordered>(low: R, high: R) -> bool {
        low < high && crate::number::real::larger(low, high) == high
    }
    assert!(ordered(number("1"), number("1.0000000000000000000000000000001")));
}
