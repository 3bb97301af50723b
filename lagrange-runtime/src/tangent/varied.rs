//! Numbers that carry their derivatives by the start of a motion and by parameters.

use core::cmp::Ordering;
use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

use crate::real::{Ordered, Real};

/// A number with its derivatives by `N` initial coordinates, `N` initial velocities and `P` parameters.
///
/// This is the scalar that an integrator sees in [`Variational`](super::Variational): sums and products are
/// differentiated, while functions such as roots and absolute values, from which integrators find the lengths of steps,
/// give plain numbers, so that the derivative is that of the motion by the steps taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Varied<R, const N: usize, const P: usize = 0> {
    /// The number.
    pub value: R,
    /// Its derivatives by the initial coordinates.
    pub by_q: [R; N],
    /// By the initial velocities.
    pub by_v: [R; N],
    /// By the parameters.
    pub by_p: [R; P],
}

impl<R: Real, const N: usize, const P: usize> Varied<R, N, P> {
    /// A number that does not vary.
    #[inline]
    #[must_use]
    pub fn constant(value: R) -> Self {
        Self { value, by_q: [R::zero(); N], by_v: [R::zero(); N], by_p: [R::zero(); P] }
    }

    /// `value`, and derivatives made from those of two numbers.
    #[inline(always)]
    fn with(self, other: Self, value: R, slope: impl Fn(R, R) -> R) -> Self {
        Self {
            value,
            by_q: core::array::from_fn(|i| slope(self.by_q[i], other.by_q[i])),
            by_v: core::array::from_fn(|i| slope(self.by_v[i], other.by_v[i])),
            by_p: core::array::from_fn(|i| slope(self.by_p[i], other.by_p[i])),
        }
    }

    #[inline(always)]
    fn product(self, other: Self) -> Self {
        self.with(other, self.value * other.value, |a, b| a * other.value + self.value * b)
    }

    #[inline(always)]
    fn quotient(self, other: Self) -> Self {
        let value = self.value / other.value;
        self.with(other, value, |a, b| (a - value * b) / other.value)
    }

    /// All derivatives: by coordinates, velocities, parameters.
    #[inline]
    pub(super) fn slopes(&self) -> impl Iterator<Item = R> + '_ {
        self.by_q.iter().chain(&self.by_v).chain(&self.by_p).copied()
    }

    /// The same, to be changed.
    #[inline]
    pub(super) fn slopes_mut(&mut self) -> impl Iterator<Item = &mut R> + '_ {
        self.by_q.iter_mut().chain(&mut self.by_v).chain(&mut self.by_p)
    }
}

impl<R: Ordered, const N: usize, const P: usize> PartialOrd for Varied<R, N, P> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<R: Real, const N: usize, const P: usize> Add for Varied<R, N, P> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        self.with(other, self.value + other.value, |a, b| a + b)
    }
}

impl<R: Real, const N: usize, const P: usize> Sub for Varied<R, N, P> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self.with(other, self.value - other.value, |a, b| a - b)
    }
}

impl<R: Real, const N: usize, const P: usize> Mul for Varied<R, N, P> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        self.product(other)
    }
}

impl<R: Real, const N: usize, const P: usize> Div for Varied<R, N, P> {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        self.quotient(other)
    }
}

impl<R: Real, const N: usize, const P: usize> Neg for Varied<R, N, P> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self.with(self, -self.value, |a, _| -a)
    }
}

macro_rules! assign {
    ($($trait:ident $method:ident $operator:tt;)*) => {$(
        impl<R: Real, const N: usize, const P: usize> $trait for Varied<R, N, P> {
            #[inline]
            fn $method(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )*};
}

assign! { AddAssign add_assign +; SubAssign sub_assign -; MulAssign mul_assign *; DivAssign div_assign /; }

impl<R: Real, const N: usize, const P: usize> Sum for Varied<R, N, P> {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::zero(), |sum, term| sum + term)
    }
}

impl<R: Real, const N: usize, const P: usize> Zero for Varied<R, N, P> {
    #[inline]
    fn zero() -> Self {
        Self::constant(R::zero())
    }
    #[inline]
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl<R: Real, const N: usize, const P: usize> One for Varied<R, N, P> {
    #[inline]
    fn one() -> Self {
        Self::constant(R::one())
    }
}

/// Functions of the value alone.
macro_rules! plain {
    ($($name:ident($($other:ident)?);)*) => {$(
        #[inline]
        fn $name(self $(, $other: Self)?) -> Self {
            Self::constant(self.value.$name($($other.value)?))
        }
    )*};
}

impl<R: Ordered, const N: usize, const P: usize> Real for Varied<R, N, P> {
    type Lane = Self;

    #[inline]
    fn splat(lane: Self) -> Self {
        lane
    }
    #[inline]
    fn largest(self) -> Self {
        self
    }
    #[inline]
    fn from_f64(literal: f64) -> Self {
        Self::constant(R::from_f64(literal))
    }
    #[inline]
    fn from_parts(high: f64, low: f64) -> Self {
        Self::constant(R::from_parts(high, low))
    }
    #[inline]
    fn pi() -> Self {
        Self::constant(R::pi())
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (Self::constant(sin), Self::constant(cos))
    }
    plain! { atan2(x); exp(); ln(); sqrt(); abs(); signum(); max(other); min(other); }
    #[inline]
    fn epsilon() -> Self {
        Self::constant(R::epsilon())
    }
    #[inline]
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.slopes().all(|slope| slope.is_finite())
    }
    #[inline]
    fn is_positive(self) -> bool {
        self.value.is_positive()
    }
}
