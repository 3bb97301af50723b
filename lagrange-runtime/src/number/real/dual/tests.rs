//! Every function against differences of order four, at points on both sides of zero and near the ends of its
//! domain.

use super::*;

type D = Dual<f64, 2>;

fn difference(f: impl Fn(f64) -> f64, x: f64, h: f64) -> f64 {
    (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h)
}

macro_rules! functions {
    ($points:expr; $($name:ident)*) => {
        for x in $points {
            $(
                let found = D { value: x, slopes: [1.0, -3.0] }.$name();
                assert_eq!(found.value, Real::$name(x), "{}({x})", stringify!($name));
                let h = 1e-3 * x.abs().min(1.0);
                let expected = difference(|x| Real::$name(x), x, h);
                let error = (found.slopes[0] - expected).abs() / expected.abs().max(1e-3);
                assert!(error < 1e-8, "{}′({x}): {} against {expected}", stringify!($name), found.slopes[0]);
                let off = found.slopes[1] + 3.0 * found.slopes[0];
                assert!(off.abs() <= 1e-15 * found.slopes[0].abs(), "{}", stringify!($name));
                // Duals of duals: the derivative of the derivative.
                let twice = Dual::<D, 1> { value: D::variable(x, 0), slopes: [D::constant(1.0)] }.$name();
                assert_eq!(twice.slopes[0].value, twice.value.slopes[0], "{}", stringify!($name));
                let second = difference(|x| D::variable(x, 0).$name().slopes[0], x, h);
                let error = (twice.slopes[0].slopes[0] - second).abs() / second.abs().max(1e-2);
                assert!(error < 1e-7, "{}″({x}): {} against {second}", stringify!($name), twice.slopes[0].slopes[0]);
            )*
        }
    };
}

#[test]
fn derivatives_of_functions() {
    functions!([-2.7, -0.6, -0.02, 0.01, 0.4, 1.3, 3.0]; sin cos tan atan sinh cosh tanh sech asinh exp exp_m1 recip cbrt abs);
    functions!([0.01, 0.4, 1.3, 30.0]; ln sqrt ln_1p);
    functions!([-0.8, -0.3, 0.02, 0.8]; asin acos atanh ln_1p);
    functions!([1.3, 1.5, 20.0]; acosh);
}

#[test]
fn tanh_keeps_its_digits_far_away() {
    let found = D::variable(20.0, 0).tanh().slopes[0];
    let expected = 4.0 * Real::exp(-40.0);
    assert!((found / expected - 1.0).abs() < 1e-14);
    // Where cosh overflows, too: a smoothed sign of a speed has arguments of thousands.
    let beyond = Dual::<D, 1> { value: D::variable(1e4, 0), slopes: [D::constant(1.0)] }.tanh();
    assert_eq!((beyond.slopes[0].value, beyond.slopes[0].slopes), (0.0, [0.0; 2]));
}

#[test]
fn a_power_of_nothing_has_a_slope() {
    let power = D::variable(0.0, 0).powf(D::constant(2.5));
    assert_eq!((power.value, power.slopes), (0.0, [0.0; 2]));
    // By its exponent as well, and by both in either order: xʸ ln x and its derivatives go to zero for y > 1.
    type Second = Dual<D, 2>;
    let vary = |x: f64, y: f64| {
        let number = |x: f64, k: usize| Second {
            value: D::variable(x, k),
            slopes: core::array::from_fn(|i| D::constant(if i == k { 1.0 } else { 0.0 })),
        };
        number(x, 0).powf(number(y, 1))
    };
    let power = vary(0.0, 2.5);
    assert!(power.is_finite(), "{power:?}");
    assert_eq!(
        (power.slopes[1].value, power.slopes[1].slopes, power.slopes[0].slopes),
        (0.0, [0.0; 2], [0.0; 2])
    );
    // At an exponent of one the mixed derivative is infinite, and at zero the derivative by the exponent.
    assert_eq!(vary(0.0, 1.0).slopes[1].slopes[0], f64::NEG_INFINITY);
    assert_eq!(vary(0.0, 0.0).slopes[1].value, f64::NEG_INFINITY);
    let beside = vary(1e-3, 2.5);
    let (power, logarithm) = (1e-3_f64.powf(2.5), 1e-3_f64.ln());
    for (found, expected) in [
        (beside.slopes[1].value, power * logarithm),
        (beside.slopes[1].slopes[1], power * logarithm * logarithm),
        (beside.slopes[1].slopes[0], power * (2.5 * logarithm + 1.0) / 1e-3),
        (beside.slopes[0].slopes[1], power * (2.5 * logarithm + 1.0) / 1e-3),
    ] {
        assert!((found / expected - 1.0).abs() < 1e-13, "{found} for {expected}");
    }
}

#[test]
fn derivatives_of_functions_of_two_numbers() {
    let points = [(0.3, 1.2), (1.2, 0.3), (2.0, -0.7), (0.4, 2.1)];
    type Of<R> = fn(R, R) -> R;
    let functions: [(Of<f64>, Of<D>); 10] = [
        (|x, y| x + y, |x, y| x + y),
        (|x, y| x - y, |x, y| x - y),
        (|x, y| x * y, |x, y| x * y),
        (|x, y| x / y, |x, y| x / y),
        (Real::atan2, Real::atan2),
        (Real::powf, Real::powf),
        (Real::powf_ln, Real::powf_ln),
        (Real::hypot, Real::hypot),
        (Real::max, Real::max),
        (Real::min, Real::min),
    ];
    for (x, y) in points {
        for (i, (plain, dual)) in functions.iter().enumerate() {
            let found = dual(D::variable(x, 0), D::variable(y, 1));
            assert_eq!(found.value, plain(x, y));
            let expected = [difference(|x| plain(x, y), x, 1e-3), difference(|y| plain(x, y), y, 1e-3)];
            for (found, expected) in found.slopes.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-8 * expected.abs().max(1.0), "{i} at {x}, {y}");
            }
        }
        let [x, y, z] = [D::variable(x, 0), D::variable(y, 1), D { value: 0.7, slopes: [2.0, 3.0] }];
        let (fused, apart) = (x.mul_add(y, z), x * y + z);
        assert!(
            (fused.slopes[0] - apart.slopes[0]).abs() + (fused.slopes[1] - apart.slopes[1]).abs() < 1e-14
        );
        let (sin, cos) = x.sin_cos();
        assert_eq!((sin, cos), (x.sin(), x.cos()));
    }
}

#[test]
fn integer_powers() {
    for exponent in [-3, -1, 0, 1, 2, 7] {
        for x in [-1.3, 0.6] {
            let found = D::variable(x, 1).powi(exponent).slopes[1];
            assert!(
                (found - difference(|x: f64| Real::powi(x, exponent), x, 1e-3)).abs() < 1e-8,
                "{x}^{exponent}"
            );
        }
    }
    assert_eq!(D::variable(0.0, 0).powi(1).slopes, [1.0, 0.0]);
    assert_eq!(D::variable(0.0, 0).powi(2).slopes, [0.0, 0.0]);
    assert_eq!(D::variable(1.0, 0).powi(i32::MIN).slopes[0], f64::from(i32::MIN));
}

/// A root at zero, the logarithm of a negative base, a corner: constants have no slopes to spoil.
#[test]
fn what_does_not_vary_has_functions_that_do_not() {
    let zero = D::constant(0.0);
    for found in
        [zero.sqrt(), zero.hypot(zero), zero.atan2(zero), D::constant(1.0).acos(), zero.ln(), zero.cbrt()]
    {
        assert_eq!(found.slopes, [0.0; 2]);
    }
    let negative = D::variable(-2.0, 0).powf(D::constant(3.0));
    assert_eq!((negative.value, negative.slopes), (-8.0, [12.0, 0.0]));
}

#[test]
fn parts_are_the_value_and_the_slopes() {
    let x = Dual::<Dual<f64, 1>, 2> {
        value: Dual { value: 1.0, slopes: [2.0] },
        slopes: [Dual { value: 3.0, slopes: [4.0] }, Dual { value: 5.0, slopes: [6.0] }],
    };
    type T = Dual<Dual<f64, 1>, 2>;
    assert_eq!((T::PARTS, T::DEPTH, <f64 as Real>::PARTS, <f64 as Real>::DEPTH), (6, 2, 1, 0));
    let parts: [T; 6] = core::array::from_fn(|i| x.part(i));
    assert_eq!(parts.map(|part| part.value.value), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert!(parts.iter().all(|part| *part == T::constant(Dual::constant(part.value.value))));
    assert_eq!(x.largest(), 1.0);
}

#[test]
fn the_order_is_that_of_the_values() {
    let [low, high] = [D { value: 1.0, slopes: [9.0, 9.0] }, D { value: 2.0, slopes: [-9.0, -9.0] }];
    assert!(low < high && low.max(high) == high && low.min(high) == low);
    assert!(low != D::constant(1.0) && D::constant(1.0) < low);
    assert!(!D { value: 0.0, slopes: [f64::NAN, 0.0] }.is_finite() && !D::variable(0.0, 0).is_zero());
}
