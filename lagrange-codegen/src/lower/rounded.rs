//! Constants as Rust rounds them.
//!
//! The graph is exact: 0.1 + 0.2 is three tenths. A comparison of constants decides which branch exists at
//! all, so it must be decided as Rust decides it, where 0.1 + 0.2 exceeds 0.3. Each constant of the scalar
//! type therefore carries what its expression gives in doubles and in singles. What went through a function
//! that IEEE 754 does not determine carries nothing.

use crate::number::Number;
use crate::syntax::Scalar;
use crate::syntax::body::BinaryOperator;

/// A constant in both precisions.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rounded {
    double: Option<f64>,
    single: Option<f32>,
}

impl Rounded {
    /// Nothing is known.
    pub const UNKNOWN: Rounded = Rounded { double: None, single: None };

    /// A literal.
    pub fn literal(number: Number) -> Rounded {
        Rounded::of(number.value())
    }

    /// A double, and what it becomes as a single.
    pub fn of(value: f64) -> Rounded {
        // The bits of a double that a single lacks. Halfway between two singles the decimal decides, which
        // the double no longer shows.
        const TAIL: u64 = (1 << 29) - 1;
        let tie = value.to_bits() & TAIL == 1 << 28;
        Rounded { double: Some(value), single: (!tie).then_some(value as f32) }
    }

    /// An integer.
    pub fn integer(value: i128) -> Rounded {
        Rounded { double: Some(value as f64), single: Some(value as f32) }
    }

    /// The value after a conversion from a double.
    pub fn converted(self) -> Rounded {
        Rounded { double: self.double, single: self.double.map(|value| value as f32) }
    }

    /// The value in the precision of the scalar; of a generic scalar in both, if they are equal.
    pub fn value(self, scalar: &Scalar) -> Option<f64> {
        let single = self.single.map(f64::from);
        match scalar {
            Scalar::F64 => self.double,
            Scalar::F32 => single,
            Scalar::Generic(_) => self.double.filter(|double| single == Some(*double)),
        }
    }

    fn map(self, double: impl Fn(f64) -> f64, single: impl Fn(f32) -> f32) -> Rounded {
        Rounded { double: self.double.map(double), single: self.single.map(single) }
    }

    fn zip(
        self,
        other: Rounded,
        double: impl Fn(f64, f64) -> f64,
        single: impl Fn(f32, f32) -> f32,
    ) -> Rounded {
        Rounded {
            double: self.double.zip(other.double).map(|(a, b)| double(a, b)),
            single: self.single.zip(other.single).map(|(a, b)| single(a, b)),
        }
    }

    /// `-x`.
    pub fn negated(self) -> Rounded {
        self.map(|x| -x, |x| -x)
    }

    /// `a + b` and the like.
    pub fn arithmetic(self, operator: BinaryOperator, other: Rounded) -> Rounded {
        match operator {
            BinaryOperator::Add => self.zip(other, |a, b| a + b, |a, b| a + b),
            BinaryOperator::Subtract => self.zip(other, |a, b| a - b, |a, b| a - b),
            BinaryOperator::Multiply => self.zip(other, |a, b| a * b, |a, b| a * b),
            BinaryOperator::Divide => self.zip(other, |a, b| a / b, |a, b| a / b),
            BinaryOperator::Remainder => self.function("%", &[other]),
            _ => Rounded::UNKNOWN,
        }
    }

    /// A function that IEEE 754 determines.
    pub fn function(self, name: &str, others: &[Rounded]) -> Rounded {
        match (name, others) {
            ("abs", []) => self.map(f64::abs, f32::abs),
            ("sqrt", []) => self.map(f64::sqrt, f32::sqrt),
            ("recip", []) => self.map(f64::recip, f32::recip),
            ("floor", []) => self.map(f64::floor, f32::floor),
            ("ceil", []) => self.map(f64::ceil, f32::ceil),
            ("round", []) => self.map(f64::round, f32::round),
            ("trunc", []) => self.map(f64::trunc, f32::trunc),
            ("fract", []) => self.map(f64::fract, f32::fract),
            ("signum", []) => self.map(f64::signum, f32::signum),
            ("%", [other]) => self.zip(*other, |a, b| a % b, |a, b| a % b),
            ("rem_euclid", [other]) => self.zip(*other, f64::rem_euclid, f32::rem_euclid),
            ("div_euclid", [other]) => self.zip(*other, f64::div_euclid, f32::div_euclid),
            ("copysign", [other]) => self.zip(*other, f64::copysign, f32::copysign),
            ("min", [other]) => self.zip(*other, f64::min, f32::min),
            ("max", [other]) => self.zip(*other, f64::max, f32::max),
            _ => Rounded::UNKNOWN,
        }
    }

    /// The whole number that decides a function that jumps: the value of `floor`, how often b fits into a for
    /// `a % b`, the sign of b for `a.copysign(b)`.
    pub fn whole(self, name: &str, others: &[Rounded]) -> Rounded {
        // A remainder has no rounding error, or one that is small beside `b`: what it leaves of `a` is a
        // multiple of `b`.
        let times = |a: f64, b: f64, remainder: f64| ((a - remainder) / b).round();
        let as_single = |whole: f64| Some(whole as f32).filter(|single| f64::from(*single) == whole);
        match (name, others) {
            ("fract", []) => self.function("trunc", &[]),
            ("%", [other]) | ("rem_euclid", [other]) => {
                let remainder = self.function(name, &[*other]);
                let double = self.double.zip(other.double).zip(remainder.double);
                let single = self.single.zip(other.single).zip(remainder.single);
                Rounded {
                    double: double.map(|((a, b), remainder)| times(a, b, remainder)),
                    single: single.and_then(|((a, b), remainder)| {
                        as_single(times(a.into(), b.into(), remainder.into()))
                    }),
                }
            }
            ("copysign", [other]) => other.function("signum", &[]),
            _ => self.function(name, others),
        }
    }

    /// A comparison; `None` where it is not known how Rust decides it.
    pub fn compare(self, operator: BinaryOperator, other: Rounded, scalar: &Scalar) -> Option<bool> {
        let double = self.double.zip(other.double).map(|(a, b)| holds(operator, a, b));
        let single = self.single.zip(other.single).map(|(a, b)| holds(operator, a, b));
        match scalar {
            Scalar::F64 => double,
            Scalar::F32 => single,
            Scalar::Generic(_) => double.filter(|_| double == single),
        }
    }

    /// Numbers that tell this constant from others.
    pub fn bits(self) -> [u64; 2] {
        let single = self.single.map_or(u64::MAX, |value| u64::from(value.to_bits()));
        [self.double.map_or(u64::MAX, f64::to_bits), single]
    }
}

/// Whether a comparison holds.
pub fn holds<T: PartialOrd>(operator: BinaryOperator, a: T, b: T) -> bool {
    match operator {
        BinaryOperator::Equal => a == b,
        BinaryOperator::NotEqual => a != b,
        BinaryOperator::Less => a < b,
        BinaryOperator::LessEqual => a <= b,
        BinaryOperator::Greater => a > b,
        BinaryOperator::GreaterEqual => a >= b,
        BinaryOperator::Add
        | BinaryOperator::Subtract
        | BinaryOperator::Multiply
        | BinaryOperator::Divide
        | BinaryOperator::Remainder
        | BinaryOperator::And
        | BinaryOperator::Or => false,
    }
}
