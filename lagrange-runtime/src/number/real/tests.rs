//! The defaults of [`Real`] against the functions of `f64`, on a scalar with the required functions alone.

use std::cell::Cell;

use super::*;
use crate::integrator::Rk4;
use crate::linear::{Ldlt, Lu};
use crate::{State, System};

/// A scalar with the required functions alone, which counts its operations.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Minimal(f64);

std::thread_local! {
    static OPERATIONS: Cell<usize> = const { Cell::new(0) };
}

/// Additions, subtractions, multiplications and divisions of a call.
pub fn operations<T>(call: impl FnOnce() -> T) -> usize {
    let before = OPERATIONS.get();
    call();
    OPERATIONS.get() - before
}

macro_rules! operators {
    ($($op:ident $method:ident $assign:ident $assign_method:ident $sign:tt;)*) => {$(
        impl $op for Minimal {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                OPERATIONS.set(OPERATIONS.get() + 1);
                Self(self.0 $sign other.0)
            }
        }
        impl $assign for Minimal {
            fn $assign_method(&mut self, other: Self) {
                *self = *self $sign other;
            }
        }
    )*};
}

operators! {
    Add add AddAssign add_assign +;
    Sub sub SubAssign sub_assign -;
    Mul mul MulAssign mul_assign *;
    Div div DivAssign div_assign /;
}

impl Neg for Minimal {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl core::iter::Sum for Minimal {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::zero(), |sum, term| sum + term)
    }
}

impl Zero for Minimal {
    fn zero() -> Self {
        Self(0.0)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl One for Minimal {
    fn one() -> Self {
        Self(1.0)
    }
}

impl Real for Minimal {
    type Lane = Self;
    fn splat(lane: Self) -> Self {
        lane
    }
    fn largest(self) -> Self {
        self
    }
    fn from_f64(literal: f64) -> Self {
        Self(literal)
    }
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = Real::sin_cos(self.0);
        (Self(s), Self(c))
    }
    fn atan2(self, x: Self) -> Self {
        Self(Real::atan2(self.0, x.0))
    }
    fn exp(self) -> Self {
        Self(Real::exp(self.0))
    }
    fn ln(self) -> Self {
        Self(Real::ln(self.0))
    }
    fn sqrt(self) -> Self {
        Self(Real::sqrt(self.0))
    }
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    fn signum(self) -> Self {
        Self(self.0.signum())
    }
    fn epsilon() -> Self {
        Self(f64::EPSILON)
    }
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
    fn is_positive(self) -> bool {
        self.0 > 0.0
    }
}

/// Compares functions of one argument at points, relative to a result of at least `floor`.
macro_rules! agree {
    ($points:expr, $floor:expr; $($name:ident)*) => {
        for x in $points {
            $(
                let (default, direct) = (Minimal(x).$name().0, Real::$name(x));
                let error = (default - direct).abs() / direct.abs().max($floor);
                assert!(error < 4e-15, "{}({x}): {default} against {direct}", stringify!($name));
            )*
        }
    };
}

#[test]
fn defaults_agree_with_the_functions_of_f64() {
    agree!([-3.0, -0.9, -1e-9, 1e-9, 0.3, 2.0, 20.0], 1e-300; sin cos tan atan asinh recip);
    agree!([-0.99, -0.3, -1e-9, 1e-9, 0.4, 0.999], 1e-300; asin acos atanh ln_1p);
    agree!([-30.0, -2.0, 0.1, 5.0, 700.0], 1e-300; sinh cosh tanh);
    agree!([-30.0, -1e-9, 1e-9, 0.5], 1.0; exp_m1 sinh tanh);
    agree!([1.0, 1.1, 1.5, 1e6], 1e-300; acosh);
    agree!([-8.0, -0.5, 0.0, 0.3, 27.0], 1e-300; cbrt);
    assert_eq!(Minimal(3.0).hypot(Minimal(4.0)).0, 5.0);
    assert!((Minimal(2.5).powf(Minimal(-1.5)).0 - Real::powf(2.5, -1.5)).abs() < 1e-16);
}

#[test]
fn integer_powers_of_either_sign() {
    assert_eq!(Real::powi(3.0_f64, 5), 243.0);
    assert_eq!(Real::powi(-2.0_f64, -3), -0.125);
    assert_eq!(Real::powi(0.0_f64, 0), 1.0);
    assert_eq!(Real::powi(1.0_f64, i32::MIN), 1.0);
}

#[test]
fn single_precision_is_found_digit_by_digit() {
    for value in [0.0, 1.0, 0.1, 1e-30, 6.02e23, 1e-40] {
        let error = f64::from(Minimal(value).to_single()) - value;
        assert!(error.abs() <= 1.2e-7 * value + 1.5e-45, "{value}");
    }
    assert_eq!(Minimal(1e39).to_single(), f32::INFINITY);
}

#[test]
fn positive_means_above_zero_and_a_number() {
    assert!(Real::is_positive(f64::MIN_POSITIVE));
    for x in [0.0, -0.0, -1.0, f64::NAN] {
        assert!(!Real::is_positive(x), "{x}");
    }
}

/// Free fall of a mass of 2, over any scalar. Each factorisation gives half of the acceleration.
struct Fall<R>(R);

impl<R: Real> System<1> for Fall<R> {
    type Scalar = R;
    type Method = crate::Dop853;
    type Constants = R;
    fn constants(&self) -> R {
        self.0
    }
    fn accelerations_at(&self, g: &R, _: R, _: &[R; 1], _: &[R; 1], _: &[R; 0]) -> [R; 1] {
        let two = R::from_f64(2.0);
        let (a, b) = (Ldlt::factor([[two]]).unwrap().solve([-*g]), Lu::factor([[two]]).unwrap().solve([-*g]));
        [a[0] + b[0]]
    }
    fn energy_at(&self, g: &R, _: R, q: &[R; 1], v: &[R; 1]) -> R {
        v[0] * v[0] + R::from_f64(2.0) * *g * q[0]
    }
}

#[test]
fn any_scalar_runs_through_both_integrators() {
    let (height, g) = (Minimal(0.0), Minimal(10.0));
    let fall = Fall(g);
    let mut motion = fall.simulate(State::at_rest([height])).with_tolerance(Minimal(1e-12));
    assert!((motion.advance_to(Minimal(2.0)).unwrap().q[0].0 + 20.0).abs() < 1e-13);
    let fall = Fall(10.0_f32);
    let mut motion = fall.simulate(State::at_rest([0.0]));
    assert!((motion.advance_to(2.0).unwrap().q[0] + 20.0).abs() < 1e-4);
    let mut motion = fall.stepper::<Rk4>(State::at_rest([0.0]));
    assert!((motion.step(2.0, &[]).unwrap().q[0] + 20.0).abs() < 1e-5);
}

#[test]
fn conditions_are_one_or_zero_without_derivatives() {
    for (x, step) in [(2.0, 1.0), (0.0, 1.0), (-0.0, 1.0), (-1e-300, 0.0), (f64::INFINITY, 1.0)] {
        assert_eq!((x.step(), x.below()), (step, 1.0 - step), "{x}");
        let dual = Dual::<f64, 1>::variable(x, 0);
        assert_eq!((dual.step().value, dual.step().slopes), (step, [0.0]), "{x}");
        assert_eq!((dual.below().value, dual.below().slopes), (1.0 - step, [0.0]), "{x}");
        assert_eq!((Minimal(x).step(), Minimal(x).below()), (Minimal(step), Minimal(1.0 - step)), "{x}");
    }
    assert!(f64::NAN.step().is_nan() && f64::NAN.below().is_nan());
}
