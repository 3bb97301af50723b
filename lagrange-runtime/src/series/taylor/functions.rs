//! Functions of polynomials.

use num_traits::One;

use super::Taylor;
use crate::number::real::{Ordered, Real};

/// Where majorants are looked at, in steps: the further, the less is left of high orders, if they converge.
const WIDER: [f64; 2] = [3.0, 1.5];

impl<R: Ordered, const T: usize> Taylor<R, T> {
    /// A constant to whose terms [`Self::push`] leads, if this number changes.
    fn begun(&self, value: R) -> Self {
        let mut series = Self { orders: self.orders, is_whole: self.is_whole, ..Self::constant(value) };
        if self.degree > 0 && self.orders > 0 {
            (series.degree, series.is_whole) = (self.orders, false);
        }
        series
    }

    /// The terms j xⱼ of the derivative, each at the index of its own term.
    fn rates(&self) -> [R; T] {
        let mut rates = self.coefficients;
        for (order, rate) in rates.iter_mut().enumerate().take(self.degree + 1) {
            *rate *= R::from_f64(order as f64);
        }
        rates
    }

    /// Adds what coefficient `known` of one factor gives to the sums Σ factorⱼ knownₖ₋ⱼ of all higher orders
    /// k. None of these waits for another, as terms of one sum would.
    #[inline]
    fn push(&self, sums: &mut [R; T], factor: &[R; T], order: usize, known: R) {
        let sums = sums.get_mut(order + 1..=self.orders).unwrap_or_default();
        for (sum, &x) in sums.iter_mut().zip(factor.get(1..=self.degree).unwrap_or_default()) {
            *sum = R::mul_add(x, known, *sum);
        }
    }

    /// The bound of the roundings of a function of this number whose slope is no more than that: those of the
    /// number carried on, of sums with as many terms as the order, and of the function itself.
    fn following(&self, mut series: Self, slope: R) -> Self {
        let summed = R::from_f64(series.degree as f64 + 1.0) * R::epsilon();
        let moved = self.extent() - self.start().abs();
        series.error = slope * (self.error + summed * moved) + summed * series.extent();
        // An error that is no rounding may lead to where the slope is another.
        series.is_whole = series.is_whole && (!Self::IS_BOUND || self.error.is_zero());
        series
    }

    /// The same of a function that changes from its value at the start by no more than `majorant` of what its
    /// argument does: of a first look, with what the series leaves away. A majorant has a power series
    /// without negative terms. With Σ |xₖ| sᵏ in it, s ≥ 1, its terms from order n on add up to no more than
    /// the whole over sⁿ (Cauchy).
    fn bounded(&self, series: Self, slope: R, majorant: impl Fn(R) -> R) -> Self {
        if !Self::IS_BOUND {
            return self.following(series, slope);
        }
        let exact = Self { error: R::zero(), ..*self };
        let rounded = exact.following(series, slope).error;
        let grown = |s: R| {
            let terms = self.terms().iter().skip(1).rev();
            terms.fold(R::zero(), |sum, term| R::mul_add(sum, s, term.abs())) * s
        };
        let moved = grown(R::one());
        let by_error = majorant(moved + self.error) - majorant(moved);
        let left = WIDER.map(|s| majorant(grown(R::from_f64(s))) * R::from_f64(s).powi(-(T as i32)));
        let left = if left[0] < left[1] { left[0] } else { left[1] };
        let error = rounded + by_error + left;
        Self { error, is_whole: self.is_whole && error.is_finite(), ..series }
    }

    /// A function with this value at the start and this derivative: its coefficients are Σ j xⱼ sₖ₋ⱼ / k.
    fn with_slope(&self, value: R, slope: &Self) -> Self {
        let mut series = self.begun(value);
        let (rates, mut sums) = (self.rates(), [R::zero(); T]);
        for (order, &slope) in slope.terms().iter().enumerate().take(series.degree) {
            self.push(&mut sums, &rates, order, slope);
        }
        let places = series.coefficients.iter_mut().zip(sums).enumerate();
        for (order, (to, sum)) in places.skip(1).take(series.degree) {
            *to = sum / R::from_f64(order as f64);
        }
        if !Self::IS_BOUND {
            return self.following(series, slope.extent());
        }
        let exact = Self { error: R::zero(), ..*self };
        let (steepest, moved) = (slope.extent() + slope.error, self.extent() - self.start().abs());
        let error = exact.following(series, slope.extent()).error
            + self.error * steepest
            + moved * slope.error
            + self.left(slope);
        Self { error, is_whole: self.is_whole && slope.is_whole && error.is_finite(), ..series }
    }

    /// The power with an exponent that does not change, from its value at the start.
    fn power(&self, value: R, exponent: R) -> Self {
        let mut series = self.begun(value);
        let (rates, mut sums) = (self.rates(), [R::zero(); T]);
        let base = self.start();
        let mut known = value;
        for order in 1..=series.degree {
            let before = R::from_f64(order as f64 - 1.0);
            let places = sums.get_mut(order..=self.orders).unwrap_or_default().iter_mut();
            let factors = rates.iter().zip(&self.coefficients).skip(1).take(self.degree);
            for (sum, (&rate, &x)) in places.zip(factors) {
                *sum = R::mul_add(exponent * rate - before * x, known, *sum);
            }
            known = sums[order] / (R::from_f64(order as f64) * base);
            series.coefficients[order] = known;
        }
        series
    }

    /// The majorant of a power that is `value` at the start, with an exponent of this size: the coefficients
    /// of (1 + u)ᵖ are no larger than those of (1 − u) to the power −|p|.
    fn of_power(&self, value: R, exponent: R) -> impl Fn(R) -> R {
        let base = self.start().abs();
        move |moved: R| {
            let left = R::one() - moved / base;
            let grown = if left > R::zero() { left.powf(-exponent) } else { R::from_f64(f64::INFINITY) };
            value.abs() * (grown - R::one())
        }
    }

    /// The value and the derivative of a function with f″ = ± f, together.
    fn pair(&self, value: R, slope: R, sign: R) -> (Self, Self) {
        let (mut first, mut second) = (self.begun(value), self.begun(slope));
        let (rates, mut sums) = (self.rates(), [[R::zero(); T]; 2]);
        for order in 1..=first.degree {
            let [by_first, by_second] = &mut sums;
            self.push(by_first, &rates, order - 1, second.coefficients[order - 1]);
            self.push(by_second, &rates, order - 1, sign * first.coefficients[order - 1]);
            let k = R::from_f64(order as f64);
            (first.coefficients[order], second.coefficients[order]) =
                (sums[0][order] / k, sums[1][order] / k);
        }
        let (by_first, by_second) = (second.extent(), first.extent());
        // Their derivatives at the start are these two.
        let largest = if value.abs() > slope.abs() { value.abs() } else { slope.abs() };
        let majorant = |moved: R| largest * moved.exp_m1();
        (self.bounded(first, by_first, majorant), self.bounded(second, by_second, majorant))
    }

    /// The square root of what leaves zero with a fixed acceleration: the polynomial divided by θ², its root
    /// times θ.
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
        self.bounded(reciprocal, slope, self.of_power(reciprocal.start(), R::one()))
    }
    fn sqrt(self) -> Self {
        let zero = R::zero();
        let value = self.start();
        if !Self::IS_BOUND
            && value == zero
            && let [_, rate, bend, ..] = *self.terms()
            && rate == zero
            && bend > zero
        {
            return self.root_from_zero();
        }
        let half = R::from_f64(0.5);
        let root = self.power(value.sqrt(), half);
        if root.degree == 0 && !Self::IS_BOUND {
            // A root of roundings is known no better than by their root.
            let by_slope = half * self.error / root.start();
            let error = if by_slope < self.error.sqrt() { by_slope } else { self.error.sqrt() };
            return Self { error: error + R::epsilon() * root.start(), ..root };
        }
        let slope = half * root.extent() / value;
        self.bounded(root, slope, self.of_power(root.start(), half))
    }
    fn cbrt(self) -> Self {
        let third = R::one() / R::from_f64(3.0);
        let root = self.power(self.start().cbrt(), third);
        let slope = (third * root.extent() / self.start()).abs();
        self.bounded(root, slope, self.of_power(root.start(), third))
    }
    fn powf(self, exponent: Self) -> Self {
        if exponent.degree > 0 || Self::IS_BOUND && !exponent.error.is_zero() {
            return (exponent * self.ln()).exp();
        }
        let exponent = exponent.start();
        let power = self.power(self.start().powf(exponent), exponent);
        let slope = (exponent * power.extent() / self.start()).abs();
        self.bounded(power, slope, self.of_power(power.start(), exponent.abs()))
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
        let x = self.start();
        let decay = x.sech();
        // y′ = s x′ with s = 1 − y², whose value would cancel where y is near one.
        let mut square = decay * decay;
        let mut tanh = self.begun(x.tanh());
        let (rates, mut sums, mut extent) = (self.rates(), [R::zero(); T], square);
        for order in 1..=tanh.degree {
            self.push(&mut sums, &rates, order - 1, square);
            tanh.coefficients[order] = sums[order] / R::from_f64(order as f64);
            square = R::zero();
            for j in 0..=order {
                square -= tanh.coefficients[j] * tanh.coefficients[order - j];
            }
            extent += square.abs();
        }
        self.following(tanh, extent)
    }
    fn sech(self) -> Self {
        // y′ = −y tanh(x) x′.
        let tangent = self.tanh();
        let mut sech = self.begun(self.start().sech());
        let (rates, mut sums) = (self.rates(), [R::zero(); T]);
        for order in 1..=sech.degree {
            let mut slope = R::zero();
            for j in 0..order {
                slope -= sech.coefficients[j] * tangent.coefficients[order - 1 - j];
            }
            self.push(&mut sums, &rates, order - 1, slope);
            sech.coefficients[order] = sums[order] / R::from_f64(order as f64);
        }
        self.following(sech, sech.extent())
    }
    fn exp(self) -> Self {
        let mut exp = self.begun(self.start().exp());
        let (rates, mut sums) = (self.rates(), [R::zero(); T]);
        for order in 1..=exp.degree {
            self.push(&mut sums, &rates, order - 1, exp.coefficients[order - 1]);
            exp.coefficients[order] = sums[order] / R::from_f64(order as f64);
        }
        self.bounded(exp, exp.extent(), |moved: R| exp.start() * moved.exp_m1())
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
