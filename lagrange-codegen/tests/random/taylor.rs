//! Truncated Taylor series as numbers of the oracle: y = f(x) has y′ = f′(x) x′, with the slope on a series
//! that is one term shorter.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::function::{Function, Pair};
use crate::number::Number;

/// The number of coefficients.
pub const TERMS: usize = 6;

/// A series, of which the first `length` coefficients are known.
#[derive(Clone, Copy, Debug)]
pub struct Taylor<T> {
    pub coefficients: [T; TERMS],
    length: usize,
}

impl<T: Number> Taylor<T> {
    /// The series with these coefficients.
    pub fn new(coefficients: [T; TERMS]) -> Self {
        Taylor { coefficients, length: TERMS }
    }

    /// The first coefficients by a rule that knows those before.
    fn made(length: usize, rule: impl Fn(&[T], usize) -> T) -> Self {
        let mut coefficients = [T::constant(0.0); TERMS];
        for k in 0..length {
            coefficients[k] = rule(&coefficients[..k], k);
        }
        Taylor { coefficients, length }
    }

    fn shorter(self) -> Self {
        Taylor { length: self.length - 1, ..self }
    }

    /// Σ j self\[j] slope\[k − j] / k.
    fn integrated(&self, slope: &Self, k: usize) -> T {
        let term = |j: usize| T::constant(j as f64) * self.coefficients[j] * slope.coefficients[k - j];
        (1..=k).map(term).fold(T::constant(0.0), Add::add) / T::constant(k as f64)
    }
}

impl<T: Number> Number for Taylor<T> {
    fn constant(value: f64) -> Self {
        let mut coefficients = [T::constant(0.0); TERMS];
        coefficients[0] = T::constant(value);
        Taylor::new(coefficients)
    }

    fn apply(self, function: Function) -> Self {
        let value = self.coefficients[0].apply(function);
        if self.length == 1 {
            return Taylor::made(1, |_, _| value);
        }
        let slope = function.slope(self.shorter());
        Taylor::made(self.length, |_, k| if k == 0 { value } else { self.integrated(&slope, k) })
    }

    fn combine(self, pair: Pair, other: Self) -> Self {
        let value = self.coefficients[0].combine(pair, other.coefficients[0]);
        let length = self.length.min(other.length);
        if length == 1 {
            return Taylor::made(1, |_, _| value);
        }
        let cut = |x: Self| Taylor { length: length - 1, ..x };
        let (first, second) = pair.slopes(cut(self), cut(other));
        Taylor::made(length, |_, k| match k {
            0 => value,
            _ => self.integrated(&first, k) + other.integrated(&second, k),
        })
    }

    fn powi(self, power: i32) -> Self {
        let product = (0..power.unsigned_abs()).fold(Self::constant(1.0), |product, _| product * self);
        if power < 0 { Self::constant(1.0) / product } else { product }
    }
}

impl<T: Number> Add for Taylor<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let length = self.length.min(other.length);
        Taylor::made(length, |_, k| self.coefficients[k] + other.coefficients[k])
    }
}

impl<T: Number> Sub for Taylor<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        let length = self.length.min(other.length);
        Taylor::made(length, |_, k| self.coefficients[k] - other.coefficients[k])
    }
}

impl<T: Number> Mul for Taylor<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let term = |j: usize, k: usize| self.coefficients[j] * other.coefficients[k - j];
        Taylor::made(self.length.min(other.length), |_, k| {
            (1..=k).fold(term(0, k), |sum, j| sum + term(j, k))
        })
    }
}

impl<T: Number> Div for Taylor<T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Taylor::made(self.length.min(other.length), |known, k| {
            let rest = |sum: T, j: usize| sum - known[j] * other.coefficients[k - j];
            (0..k).fold(self.coefficients[k], rest) / other.coefficients[0]
        })
    }
}

impl<T: Number> Neg for Taylor<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Taylor::made(self.length, |_, k| -self.coefficients[k])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The coefficients of f(0.4 + t) by their closed forms.
    #[test]
    fn series_of_functions_are_theirs() {
        let x = Taylor::new([0.4_f64, 1.0, 0.0, 0.0, 0.0, 0.0]);
        let factorial = |k: usize| (1..=k).map(|j| j as f64).product::<f64>();
        let close = |found: Taylor<f64>, expected: &dyn Fn(usize) -> f64| {
            for k in 0..TERMS {
                let expected = expected(k);
                assert!((found.coefficients[k] - expected).abs() < 1e-14 * expected.abs().max(1.0), "{k}");
            }
        };
        close(x.apply(Function::Exp), &|k| 0.4_f64.exp() / factorial(k));
        close(x.apply(Function::Sin), &|k| {
            (0.4 + k as f64 * std::f64::consts::FRAC_PI_2).sin() / factorial(k)
        });
        close(x.powi(-1), &|k| (-1.0_f64).powi(k as i32) / 0.4_f64.powi(k as i32 + 1));
        close(x.apply(Function::Ln), &|k| match k {
            0 => 0.4_f64.ln(),
            k => -(-2.5_f64).powi(k as i32) / k as f64,
        });
        let half = Taylor::constant(0.5);
        let root = x.apply(Function::Sqrt).coefficients;
        close(x.combine(Pair::Powf, half), &|k| root[k]);
        // tan² + 1 = 1 / cos².
        let (tan, cos) = (x.apply(Function::Tan), x.apply(Function::Cos));
        let inverse = Taylor::constant(1.0) / (cos * cos);
        close(tan * tan + Taylor::constant(1.0), &|k| inverse.coefficients[k]);
        // The polar angle of (sin, cos) is linear.
        let angle = x.apply(Function::Sin).combine(Pair::Atan2, cos);
        close(angle, &|k| [0.4, 1.0, 0.0, 0.0, 0.0, 0.0][k]);
    }
}
