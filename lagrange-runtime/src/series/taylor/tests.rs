//! Every function against its values, along a path with all orders.

use super::{FEW, TERMS, Taylor, powers};
use crate::number::real::Real;

/// A path through a place, short enough that its series converges to rounding.
fn path(at: f64, slope: f64) -> Taylor<f64> {
    let terms = [slope, -0.02, 0.01, 0.003];
    Taylor::variable(at, terms.into_iter().chain(core::iter::repeat_n(0.0, 28)), 1.0)
}

fn value<const T: usize>(x: &Taylor<f64, T>, theta: f64) -> f64 {
    x.terms().iter().rev().fold(0.0, |sum, term| sum * theta + term)
}

/// A function, and the same of two values.
type Case<const T: usize> =
    (&'static str, fn(Taylor<f64, T>, Taylor<f64, T>) -> Taylor<f64, T>, fn(f64, f64) -> f64);

macro_rules! cases {
    () => {
        [
            ("sum", |x, y| x + y, |x, y| x + y),
            ("difference", |x, y| x - y, |x, y| x - y),
            ("product", |x, y| x * y, |x, y| x * y),
            ("quotient", |x, y| x / y, |x, y| x / y),
            ("sin", |x, _| x.sin(), |x, _| x.sin()),
            ("cos", |x, _| x.cos(), |x, _| x.cos()),
            ("tan", |x, _| x.tan(), |x, _| x.tan()),
            ("asin", |x, _| x.asin(), |x, _| x.asin()),
            ("acos", |x, _| x.acos(), |x, _| x.acos()),
            ("atan", |x, _| x.atan(), |x, _| x.atan()),
            ("atan2", |x, y| x.atan2(y), |x, y| x.atan2(y)),
            ("sinh", |x, _| x.sinh(), |x, _| x.sinh()),
            ("cosh", |x, _| x.cosh(), |x, _| x.cosh()),
            ("tanh", |x, _| x.tanh(), |x, _| x.tanh()),
            ("sech", |x, _| x.sech(), |x, _| x.cosh().recip()),
            ("asinh", |x, _| x.asinh(), |x, _| x.asinh()),
            ("acosh", |_, y| y.acosh(), |_, y| y.acosh()),
            ("atanh", |x, _| x.atanh(), |x, _| x.atanh()),
            ("exp", |x, _| x.exp(), |x, _| x.exp()),
            ("exp_m1", |x, _| x.exp_m1(), |x, _| x.exp_m1()),
            ("ln", |x, _| x.ln(), |x, _| x.ln()),
            ("ln_1p", |x, _| x.ln_1p(), |x, _| x.ln_1p()),
            ("sqrt", |x, _| x.sqrt(), |x, _| x.sqrt()),
            ("cbrt", |x, _| (-x).cbrt(), |x, _| (-x).cbrt()),
            ("powf", |x, y| x.powf(y), f64::powf),
            ("powi", |x, _| x.powi(-3), |x, _| x.powi(-3)),
            ("hypot", |x, y| x.hypot(y), f64::hypot),
            ("abs", |x, _| (-x).abs(), |x, _| x),
        ]
    };
}

#[test]
fn functions_of_polynomials_have_the_values_of_functions() {
    let cases: [Case<TERMS>; 28] = cases!();
    let (x, y) = (path(0.4, 0.05), path(2.0, -0.1));
    for (name, series, function) in cases {
        let series = series(x, y);
        for theta in [0.0, 0.2, 0.7, 1.0] {
            let (mine, other) = (value(&series, theta), function(value(&x, theta), value(&y, theta)));
            assert!(
                (mine - other).abs() <= series.error,
                "{name} at {theta}: {mine} {other} {}",
                series.error
            );
        }
        assert!(series.error < 2e-12, "{name}: {}", series.error);
    }
}

/// What a first look leaves away is bounded, of the path itself and of its functions.
#[test]
fn a_first_look_bounds_functions() {
    let cases: [Case<FEW>; 28] = cases!();
    let long = |at: f64, slope: f64| {
        let terms = (0..TERMS as i32 - 1).map(|order| slope * (-0.4_f64).powi(order));
        (
            Taylor::<f64>::along(at, terms.clone(), &powers(1.0)),
            Taylor::<f64, FEW>::along(at, terms, &powers(1.0)),
        )
    };
    for size in [0.01, 0.1, 0.3] {
        let (x, y) = (long(0.4, 0.5 * size), long(2.0, -size));
        let mut bounded = 0;
        for (name, series, function) in &cases {
            let series = series(x.1, y.1);
            if !series.is_whole {
                continue;
            }
            bounded += 1;
            for theta in [0.0, 0.2, 0.7, 1.0] {
                let (mine, other) = (value(&series, theta), function(value(&x.0, theta), value(&y.0, theta)));
                let error = (mine - other).abs();
                assert!(error <= series.error, "{name}: {mine} {other} {}", series.error);
            }
        }
        // Of `tanh` and `sech` no bound is known, nor of a path that comes near the end of where a function
        // is.
        let least = if size > 0.2 { 15 } else { 25 };
        assert!(bounded >= least, "{bounded} at {size}");
    }
}

#[test]
fn a_number_that_does_not_change_stays_one() {
    let x = Taylor::constant(0.3_f64);
    for f in [Taylor::sin, Taylor::exp, Taylor::sqrt, Taylor::tanh, Taylor::recip, Taylor::atan] {
        assert_eq!(f(x).degree, 0);
        assert!(f(x).is_whole);
    }
    assert!((x * path(1.0, 0.5)).is_whole);
    assert_eq!((x * path(1.0, 0.5)).degree, 4);
    assert_eq!((path(1.0, 0.5) * path(1.0, 0.5)).degree, 8);
    assert!(!path(1.0, 0.5).sin().is_whole);
}

#[test]
fn the_distance_from_a_centre_has_a_series_where_it_starts_there() {
    let (x, y) = (path(0.0, 0.3), path(0.0, 0.4));
    let r = x.hypot(y);
    assert_eq!(r.start(), 0.0);
    for theta in [0.3_f64, 1.0] {
        let other = value(&x, theta).hypot(value(&y, theta));
        assert!((value(&r, theta) - other).abs() < 1e-14);
    }
}

#[test]
fn a_shifted_polynomial_is_the_same_one() {
    let x = path(0.4, 0.5).sin();
    let part = x.on(0.25, 0.5);
    for theta in [0.0, 0.4, 1.0] {
        assert!((value(&part, theta) - value(&x, 0.25 + 0.5 * theta)).abs() < 1e-15);
    }
}
