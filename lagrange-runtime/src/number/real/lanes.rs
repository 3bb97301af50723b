//! Vectors of the `wide` crate as scalars: the same generated code for several motions at once.

use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};
use wide::{f32x4, f32x8, f64x2, f64x4, f64x8};

use super::{Real, Vector};
use crate::number::elements::{Each, array};

/// A SIMD vector as a scalar: `Lanes<f64x4>`, `Lanes<f64x8>`, `Lanes<f32x8>`, …
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Lanes<V>(pub V);

macro_rules! lanes {
    ($($vector:ident of $count:literal $lane:ident;)*) => {$(
        impl From<[$lane; $count]> for Lanes<$vector> {
            #[inline]
            fn from(lanes: [$lane; $count]) -> Self {
                Self($vector::from(lanes))
            }
        }

        impl From<Lanes<$vector>> for [$lane; $count] {
            #[inline]
            fn from(lanes: Lanes<$vector>) -> Self {
                lanes.0.into()
            }
        }

        impl Vector for Lanes<$vector> {
            const COUNT: usize = $count;

            #[inline(always)]
            fn lanes(&self) -> &[$lane] {
                self.0.as_array()
            }

            #[inline(always)]
            fn lanes_mut(&mut self) -> &mut [$lane] {
                self.0.as_mut_array()
            }
        }

        lanes!(@binary $vector Add add, Sub sub, Mul mul, Div div);
        lanes!(@assign $vector AddAssign add_assign +, SubAssign sub_assign -, MulAssign mul_assign *, DivAssign div_assign /);

        impl Neg for Lanes<$vector> {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl Zero for Lanes<$vector> {
            #[inline(always)]
            fn zero() -> Self {
                Self($vector::splat(0.0))
            }

            #[inline]
            fn is_zero(&self) -> bool {
                *self == Self::zero()
            }
        }

        impl One for Lanes<$vector> {
            #[inline(always)]
            fn one() -> Self {
                Self($vector::splat(1.0))
            }
        }

        impl Sum for Lanes<$vector> {
            #[inline]
            fn sum<I: Iterator<Item = Self>>(items: I) -> Self {
                items.fold(Self::zero(), Add::add)
            }
        }

        impl Real for Lanes<$vector> {
            type Lane = $lane;

            #[inline(always)]
            fn splat(lane: $lane) -> Self {
                Self($vector::splat(lane))
            }

            #[inline]
            fn largest(self) -> $lane {
                let lanes: [$lane; $count] = self.0.into();
                lanes.into_iter().fold($lane::NEG_INFINITY, $lane::max)
            }

            #[inline(always)]
            fn from_f64(literal: f64) -> Self {
                Self($vector::splat(literal as $lane))
            }

            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                let (sin, cos) = self.0.sin_cos();
                (Self(sin), Self(cos))
            }

            #[inline]
            fn signum(self) -> Self {
                let lanes: [$lane; $count] = self.0.into();
                Self($vector::from(lanes.each($lane::signum)))
            }

            #[inline]
            fn epsilon() -> Self {
                Self($vector::splat($lane::EPSILON))
            }

            #[inline]
            fn is_finite(self) -> bool {
                self.0.is_finite().all()
            }

            #[inline]
            fn is_positive(self) -> bool {
                let lanes: [$lane; $count] = self.0.into();
                lanes.into_iter().all(|lane| lane > 0.0)
            }

            #[inline]
            fn where_positive(self, sign: Self, other: Self) -> Self {
                let [sign, this, other] = [sign, self, other].each(<[$lane; $count]>::from);
                let lane = |k: usize| if sign[k] > 0.0 { this[k] } else { other[k] };
                Self($vector::from(array::<$lane, $count>(lane)))
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, summand: Self) -> Self {
                Self(self.0.mul_add(factor.0, summand.0))
            }

            #[inline]
            fn atan2(self, x: Self) -> Self {
                Self(self.0.atan2(x.0))
            }

            #[inline]
            fn max(self, other: Self) -> Self {
                Self(self.0.fast_max(other.0))
            }

            #[inline]
            fn min(self, other: Self) -> Self {
                Self(self.0.fast_min(other.0))
            }

            #[inline]
            fn powf(self, exponent: Self) -> Self {
                Self(self.0.powf_simd(exponent.0))
            }

            #[inline]
            fn powf_ln(self, exponent: Self) -> Self {
                let powers: [$lane; $count] = self.powf(exponent).0.into();
                let logarithms: [$lane; $count] = self.0.ln().into();
                let lane = |k: usize| if powers[k] == 0.0 { 0.0 } else { powers[k] * logarithms[k] };
                Self($vector::from(array::<$lane, $count>(lane)))
            }

            lanes!(@forward exp ln sqrt abs asin acos atan sinh cosh tanh exp_m1 ln_1p cbrt);
        }
    )*};
    (@binary $vector:ident $($trait:ident $function:ident),*) => {$(
        impl $trait for Lanes<$vector> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self($trait::$function(self.0, other.0))
            }
        }
    )*};
    (@assign $vector:ident $($trait:ident $function:ident $operator:tt),*) => {$(
        impl $trait for Lanes<$vector> {
            #[inline(always)]
            fn $function(&mut self, other: Self) {
                self.0 = self.0 $operator other.0;
            }
        }
    )*};
    (@forward $($function:ident)*) => {$(
        #[inline]
        fn $function(self) -> Self {
            Self(self.0.$function())
        }
    )*};
}

lanes! {
    f64x2 of 2 f64;
    f64x4 of 4 f64;
    f64x8 of 8 f64;
    f32x4 of 4 f32;
    f32x8 of 8 f32;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Common numbers, and those at the ends of the domains of functions.
    const NUMBERS: [f64; 22] = [
        0.3,
        1.0,
        -0.7,
        2.5,
        0.0,
        -0.0,
        1e-9,
        -1e-300,
        5e-324,
        40.0,
        -37.5,
        710.0,
        -745.0,
        1e5,
        3e15,
        -1e300,
        1.5,
        100.0,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        -1.0,
    ];

    /// The function of a number has the same bits in vectors of any length, whatever the other lanes hold.
    fn alone(
        name: &str,
        two: impl Fn(Lanes<f64x2>, Lanes<f64x2>) -> Lanes<f64x2>,
        four: impl Fn(Lanes<f64x4>, Lanes<f64x4>) -> Lanes<f64x4>,
        eight: impl Fn(Lanes<f64x8>, Lanes<f64x8>) -> Lanes<f64x8>,
    ) {
        // All NaN count as one.
        let bits = |x: f64| if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() };
        for x in NUMBERS {
            for y in [0.5, -3.0, 0.0, 1e200] {
                let expected = bits(four(Lanes::splat(x), Lanes::splat(y)).lane(0));
                assert_eq!(bits(two(Lanes::splat(x), Lanes::splat(y)).lane(1)), expected, "{name}({x}, {y})");
                for other in NUMBERS {
                    for lane in 0..8 {
                        let beside = |count| (0..count).map(move |k| if k == lane { x } else { other });
                        let (mut few, mut many) =
                            (Lanes::<f64x4>::splat(other), Lanes::<f64x8>::splat(other));
                        beside(4).enumerate().for_each(|(k, x)| few.set_lane(k, x));
                        beside(8).enumerate().for_each(|(k, x)| many.set_lane(k, x));
                        if lane < 4 {
                            let found = four(few, Lanes::splat(y)).lane(lane);
                            assert_eq!(bits(found), expected, "{name}({x}, {y}) beside {other}");
                        }
                        let found = eight(many, Lanes::splat(y)).lane(lane);
                        assert_eq!(bits(found), expected, "{name}({x}, {y}) beside {other}, of eight");
                    }
                }
            }
        }
    }

    macro_rules! alone {
        ($($name:ident($($other:ident)?);)*) => {$(
            alone(
                stringify!($name),
                |x, _y| x.$name($(alone!(@ $other _y))?),
                |x, _y| x.$name($(alone!(@ $other _y))?),
                |x, _y| x.$name($(alone!(@ $other _y))?),
            );
        )*};
        (@ y $y:ident) => { $y };
    }

    /// The property that ensembles in lanes rely on.
    #[test]
    fn a_lane_has_the_same_bits_beside_any_others() {
        alone! {
            sin(); cos(); tan(); exp(); ln(); sqrt(); abs(); asin(); acos(); atan(); sinh(); cosh(); tanh(); exp_m1();
            ln_1p(); cbrt(); asinh(); acosh(); atanh(); signum(); recip();
            atan2(y); powf(y); max(y); min(y); hypot(y); add(y); mul(y); div(y);
        }
    }

    #[test]
    fn each_lane_is_chosen_by_its_own_sign() {
        let sign = Lanes::<f64x4>::from([1e-300, 0.0, -1.0, f64::NAN]);
        let chosen = Lanes::<f64x4>::splat(-0.0).where_positive(sign, Lanes::splat(f64::INFINITY));
        assert_eq!(<[f64; 4]>::from(chosen), [-0.0, f64::INFINITY, f64::INFINITY, f64::INFINITY]);
        assert_eq!(2.0.where_positive(1.0, 3.0), 2.0);
        assert_eq!(2.0.where_positive(f64::NAN, 3.0), 3.0);
    }
}
