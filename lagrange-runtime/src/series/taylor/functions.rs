//! Functions of polynomials.

use num_traits::One;

use super::Taylor;
use crate::number::real::{Ordered, Real};

impl<R: Ordered, const T: usize> Taylor<R, T> {
    /// A series whose coefficients follow from those of lower order, the first of which is a value. `slope` bounds the
    /// derivative by this number, whose roundings it carries on.
    fn series(&self, value: R, mut next: impl FnMut(usize, &[R]) -> R) -> Self {
        let mut series = Self { orders: self.orders, is_whole: self.is_whole, ..Self::constant(value) };
        if self.degree > 0 && self.orders > 0 {
            for order in 1..=self.orders {
                let term = next(order, series.coefficients.get(..order).unwrap_or_default());
                if let Some(to) = series.coefficients.get_mut(order) {
                    *to = term;
                }
            }
            (series.degree, series.is_whole) = (self.orders, false);
        }
        series
    }

    /// The bound of the roundings of a function of this number whose slope is no more than that: those of the number
    /// carried on, of sums with as many terms as the order, and of the function itself.
    fn following(&self, mut series: Self, slope: R) -> Self {
        let summed = R::from_f64(series.degree as f64 + 1.0) * R::epsilon();
        let moved = self.extent() - self.start().abs();
        series.error = slope * (self.error + summed * moved) + summed * series.extent();
        series
    }

    /// Σ j xⱼ sₖ₋ⱼ / k: coefficient k of the integral of x′ s.
    fn integral(&self, order: usize, slope: &[R]) -> R {
        let mut sum = R::zero();
        for (j, &x) in self.terms().iter().enumerate().take(order + 1).skip(1) {
            if let Some(&s) = slope.get(order - j) {
                sum = R::mul_add(R::from_f64(j as f64) * x, s, sum);
            }
        }
        sum / R::from_f64(order as f64)
    }

    /// A function with this value at the start and this derivative.
    fn with_slope(&self, value: R, slope: &Self) -> Self {
        let series = self.series(value, |order, _| self.integral(order, slope.terms()));
        self.following(series, slope.extent())
    }

    /// The power with an exponent that does not change, from its value at the start.
    fn power(&self, value: R, exponent: R) -> Self {
        let base = self.start();
        self.series(value, |order, known| {
            let mut sum = R::zero();
            for (j, &x) in self.terms().iter().enumerate().take(order + 1).skip(1) {
                if let Some(&y) = known.get(order - j) {
                    let weight = exponent * R::from_f64(j as f64) - R::from_f64((order - j) as f64);
                    sum = R::mul_add(weight * x, y, sum);
                }
            }
            sum / (R::from_f64(order as f64) * base)
        })
    }

    /// The value and the derivative of a function with f″ = ± f, together.
    fn pair(&self, value: R, slope: R, sign: R) -> (Self, Self) {
        let mut first = self.series(value, |_, _| R::zero());
        let mut second = self.series(slope, |_, _| R::zero());
        for order in 1..=first.degree {
            let (a, b) = (self.integral(order, second.terms()), self.integral(order, first.terms()));
            (first.coefficients[order], second.coefficients[order]) = (a, sign * b);
        }
        let (by_first, by_second) = (second.extent(), first.extent());
        (self.following(first, by_first), self.following(second, by_second))
    }

    /// The square root of what leaves zero with a fixed acceleration: the polynomial divided by θ², its root times θ.
    fn root_from_zero(&self) -> Self {
        let mut rest = *self;
        rest.coefficients.rotate_left(2.min(T));
        rest.degree = self.degree.saturating_sub(2);
        let mut root = rest.sqrt();
        root.coefficients.rotate_right(1.min(T));
        if let Some(first) = root.coefficients.first_mut() {
            *first = R::zero();
        }
        root.degree = (root.degree + 1).min(self.orders);
        root
    }
}

impl<R: Ordered, const T: usize> Real for Taylor<R, T> {
    type Lane = R::Lane;

    fn splat(lane: R::Lane) -> Self {
        Self::constant(R::splat(lane))
    }
    fn largest(self) -> R::Lane {
        self.start().largest()
    }
    fn from_f64(literal: f64) -> Self {
        Self::constant(R::from_f64(literal))
    }
    fn from_parts(high: f64, low: f64) -> Self {
        Self::constant(R::from_parts(high, low))
    }
    fn epsilon() -> Self {
        Self::constant(R::epsilon())
    }
    fn is_finite(self) -> bool {
        self.terms().iter().all(|term| term.is_finite())
    }
    fn is_positive(self) -> bool {
        self.start().is_positive()
    }
    fn signum(self) -> Self {
        Self { orders: self.orders, ..Self::constant(self.start().signum()) }
    }
    fn abs(self) -> Self {
        if self.start() < R::zero() { -self } else { self }
    }
    fn recip(self) -> Self {
        let reciprocal = self.power(self.start().recip(), -R::one());
        let slope = reciprocal.extent() * reciprocal.extent();
        self.following(reciprocal, slope)
    }
    fn sqrt(self) -> Self {
        let zero = R::zero();
        let value = self.start();
        if value == zero
            && let [_, rate, bend, ..] = *self.terms()
            && rate == zero
            && bend > zero
        {
            return self.root_from_zero();
        }
        let half = R::from_f64(0.5);
        let root = self.power(value.sqrt(), half);
        if root.degree == 0 {
            // A root of roundings is known no better than by their root.
            let by_slope = half * self.error / root.start();
            let error = if by_slope < self.error.sqrt() { by_slope } else { self.error.sqrt() };
            return Self { error: error + R::epsilon() * root.start(), ..root };
        }
        let slope = half * root.extent() / value;
        self.following(root, slope)
    }
    fn cbrt(self) -> Self {
        let third = R::one() / R::from_f64(3.0);
        let root = self.power(self.start().cbrt(), third);
        let slope = (third * root.extent() / self.start()).abs();
        self.following(root, slope)
    }
    fn powf(self, exponent: Self) -> Self {
        if exponent.degree > 0 {
            return (exponent * self.ln()).exp();
        }
        let exponent = exponent.start();
        let power = self.power(self.start().powf(exponent), exponent);
        let slope = (exponent * power.extent() / self.start()).abs();
        self.following(power, slope)
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.start().sin_cos();
        self.pair(sin, cos, -R::one())
    }
    fn sinh(self) -> Self {
        let x = self.start();
        self.pair(x.sinh(), x.cosh(), R::one()).0
    }
    fn cosh(self) -> Self {
        let x = self.start();
        self.pair(x.sinh(), x.cosh(), R::one()).1
    }
    fn tanh(self) -> Self {
        let mut slope = Self::constant(R::zero());
        let (x, degree) = (self.start(), if self.degree > 0 { self.orders } else { 0 });
        let decay = x.sech();
        // y′ = s x′ with s = 1 − y², whose value would cancel where y is near one.
        let mut squares = decay * decay;
        let mut tanh = Self { orders: self.orders, is_whole: self.is_whole, ..Self::constant(x.tanh()) };
        for order in 0..=degree {
            if order > 0 {
                tanh.coefficients[order] = self.integral(order, slope.terms());
                squares = R::zero();
                for j in 0..=order {
                    squares -= tanh.coefficients[j] * tanh.coefficients[order - j];
                }
                (tanh.degree, tanh.is_whole) = (order, false);
            }
            (slope.coefficients[order], slope.degree) = (squares, order);
        }
        self.following(tanh, slope.extent())
    }
    fn sech(self) -> Self {
        // y′ = −y tanh(x) x′.
        let tangent = self.tanh();
        let mut slope = [R::zero(); T];
        let secant = self.series(self.start().sech(), |order, known| {
            if let Some(last) = slope.get_mut(order - 1) {
                for (&y, &z) in known.iter().zip(tangent.terms().iter().take(order).rev()) {
                    *last -= y * z;
                }
            }
            self.integral(order, slope.get(..order).unwrap_or_default())
        });
        self.following(secant, secant.extent())
    }
    fn exp(self) -> Self {
        let exp = self.series(self.start().exp(), |order, known| self.integral(order, known));
        self.following(exp, exp.extent())
    }
    fn exp_m1(self) -> Self {
        let slope = self.exp();
        self.with_slope(self.start().exp_m1(), &slope)
    }
    fn ln(self) -> Self {
        self.with_slope(self.start().ln(), &self.recip())
    }
    fn ln_1p(self) -> Self {
        self.with_slope(self.start().ln_1p(), &(Self::one() + self).recip())
    }
    fn atan2(self, x: Self) -> Self {
        let weight = (self * self + x * x).recip();
        let (by_y, by_x) = (x * weight, -(self * weight));
        let first = self.with_slope(self.start().atan2(x.start()), &by_y);
        first + x.with_slope(R::zero(), &by_x)
    }
    fn atan(self) -> Self {
        self.with_slope(self.start().atan(), &(Self::one() + self * self).recip())
    }
    fn asin(self) -> Self {
        let slope = ((Self::one() - self) * (Self::one() + self)).sqrt().recip();
        self.with_slope(self.start().asin(), &slope)
    }
    fn acos(self) -> Self {
        let slope = -((Self::one() - self) * (Self::one() + self)).sqrt().recip();
        self.with_slope(self.start().acos(), &slope)
    }
    fn asinh(self) -> Self {
        let slope = (Self::one() + self * self).sqrt().recip();
        self.with_slope(self.start().asinh(), &slope)
    }
    fn acosh(self) -> Self {
        let slope = ((self - Self::one()) * (self + Self::one())).sqrt().recip();
        self.with_slope(self.start().acosh(), &slope)
    }
    fn atanh(self) -> Self {
        let slope = ((Self::one() - self) * (Self::one() + self)).recip();
        self.with_slope(self.start().atanh(), &slope)
    }
}
