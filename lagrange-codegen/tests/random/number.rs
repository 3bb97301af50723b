//! The numbers of the oracle: doubles that count their roundings, and dual numbers over any number.
//!
//! `Dual<T>` is value + slope ε with ε² = 0 (Clifford 1873). Nesting gives mixed derivatives: in
//! `Dual<Dual<T>>` the slope of the slope is ∂²f/∂a∂b, which is a hyper-dual number (Fike and Alonso
//! 2011). No step size, no truncation: derivatives are exact up to rounding.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::function::{Function, Pair};

/// A kind of number in which the formulas can be evaluated.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// A number that depends on nothing.
    fn constant(value: f64) -> Self;

    /// A function of one argument.
    fn apply(self, function: Function) -> Self;

    /// A function of two arguments.
    fn combine(self, pair: Pair, other: Self) -> Self;

    /// A whole power.
    fn powi(self, power: i32) -> Self;
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
    }

    fn apply(self, function: Function) -> Self {
        function.value(self)
    }

    fn combine(self, pair: Pair, other: Self) -> Self {
        pair.value(self, other)
    }

    fn powi(self, power: i32) -> Self {
        f64::powi(self, power)
    }
}

/// A double and how many roundings of unit size its computation has gathered (a running error
/// analysis, Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed., section 3.3):
/// the value is uncertain by about `roundings` times the rounding unit.
///
/// Where terms cancel, `roundings` keeps the size of the terms. A kink (`abs` or `signum` so close
/// to zero that the side is not certain) is NaN: derivatives mean nothing there.
#[derive(Clone, Copy, Debug)]
pub struct Tracked {
    pub value: f64,
    pub roundings: f64,
}

/// Arguments of `abs` and `signum` below this share of their terms have no certain sign.
const KINK: f64 = 1e-9;

impl Number for Tracked {
    fn constant(value: f64) -> Self {
        Tracked { value, roundings: value.abs() }
    }

    fn apply(self, function: Function) -> Self {
        if matches!(function, Function::Abs | Function::Signum) && self.value.abs() <= KINK * self.roundings {
            return Tracked { value: f64::NAN, roundings: f64::NAN };
        }
        let value = function.value(self.value);
        let slope = function.slope(self.value);
        Tracked { value, roundings: value.abs() + slope.abs() * self.roundings }
    }

    fn combine(self, pair: Pair, other: Self) -> Self {
        let value = pair.value(self.value, other.value);
        let (first, second) = pair.slopes(self.value, other.value);
        let roundings = value.abs() + first.abs() * self.roundings + second.abs() * other.roundings;
        Tracked { value, roundings }
    }

    fn powi(self, power: i32) -> Self {
        let value = self.value.powi(power);
        let slope = match power {
            0 => 0.0,
            // The quotient does not underflow where the lower power would.
            _ if self.value != 0.0 => f64::from(power) * value / self.value,
            _ => f64::from(power) * self.value.powi(power - 1),
        };
        Tracked { value, roundings: value.abs() + slope.abs() * self.roundings }
    }
}

impl Add for Tracked {
    type Output = Tracked;
    fn add(self, other: Tracked) -> Tracked {
        Tracked { value: self.value + other.value, roundings: self.roundings + other.roundings }
    }
}

impl Sub for Tracked {
    type Output = Tracked;
    fn sub(self, other: Tracked) -> Tracked {
        Tracked { value: self.value - other.value, roundings: self.roundings + other.roundings }
    }
}

impl Mul for Tracked {
    type Output = Tracked;
    fn mul(self, other: Tracked) -> Tracked {
        let roundings = self.value.abs() * other.roundings + self.roundings * other.value.abs();
        Tracked { value: self.value * other.value, roundings }
    }
}

impl Div for Tracked {
    type Output = Tracked;
    fn div(self, other: Tracked) -> Tracked {
        let value = self.value / other.value;
        Tracked { value, roundings: (self.roundings + value.abs() * other.roundings) / other.value.abs() }
    }
}

impl Neg for Tracked {
    type Output = Tracked;
    fn neg(self) -> Tracked {
        Tracked { value: -self.value, ..self }
    }
}

/// A value and its derivative along one direction.
#[derive(Clone, Copy, Debug)]
pub struct Dual<T> {
    pub value: T,
    pub slope: T,
}

impl<T: Number> Dual<T> {
    /// A number that does not move along the direction.
    pub fn still(value: T) -> Self {
        Dual { value, slope: T::constant(0.0) }
    }
}

impl<T: Number> Number for Dual<T> {
    fn constant(value: f64) -> Self {
        Dual::still(T::constant(value))
    }

    fn apply(self, function: Function) -> Self {
        Dual { value: self.value.apply(function), slope: function.slope(self.value) * self.slope }
    }

    fn combine(self, pair: Pair, other: Self) -> Self {
        let (first, second) = pair.slopes(self.value, other.value);
        Dual {
            value: self.value.combine(pair, other.value),
            slope: first * self.slope + second * other.slope,
        }
    }

    fn powi(self, power: i32) -> Self {
        if power == 0 {
            return Self::constant(1.0);
        }
        let factor = T::constant(f64::from(power)) * self.value.powi(power - 1);
        Dual { value: self.value.powi(power), slope: factor * self.slope }
    }
}

impl<T: Number> Add for Dual<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Dual { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl<T: Number> Sub for Dual<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Dual { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl<T: Number> Mul for Dual<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let slope = self.slope * other.value + self.value * other.slope;
        Dual { value: self.value * other.value, slope }
    }
}

impl<T: Number> Div for Dual<T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Dual { value, slope: (self.slope - value * other.slope) / other.value }
    }
}

impl<T: Number> Neg for Dual<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Dual { value: -self.value, slope: -self.slope }
    }
}
