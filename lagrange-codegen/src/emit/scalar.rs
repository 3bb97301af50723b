//! Numbers and functions of the scalar type as text.

use crate::number::Number;
use crate::syntax::Scalar;

/// A nonnegative constant as an expression of the scalar type, exact to the last bit. With `typed` nothing is
/// left to inference, for which the compiler takes quadratic time in long functions. Zero has one text either
/// way, because zeros are recognised by it. A type parameter may have bounds beside `Real`, so calls name the
/// trait.
pub(super) fn literal(scalar: &Scalar, number: Number, typed: bool) -> String {
    let value = number.value();
    let name = if value.is_nan() { "NAN" } else { "INFINITY" };
    match scalar {
        Scalar::F64 if !value.is_finite() => format!("f64::{name}"),
        Scalar::F32 if !value.is_finite() => format!("f32::{name}"),
        Scalar::F64 if typed && !number.is_zero() => format!("{value:?}_f64"),
        Scalar::F64 => format!("{value:?}"),
        // The suffix keeps inference from an open float type in a trait call.
        Scalar::F32 => format!("{value:?}_f32"),
        Scalar::Generic(ident) if number.is_one() => format!("<{ident} as lagrange::One>::one()"),
        Scalar::Generic(ident) if number.is_zero() => format!("<{ident} as lagrange::Zero>::zero()"),
        Scalar::Generic(ident) if !value.is_finite() => {
            format!("<{ident} as lagrange::Real>::from_f64(f64::{name})")
        }
        Scalar::Generic(ident) => match number.parts() {
            (_, 0.0) => format!("<{ident} as lagrange::Real>::from_f64({value:?})"),
            (_, rest) => format!("<{ident} as lagrange::Real>::from_parts({value:?}, {rest:?})"),
        },
    }
}

/// Zero of the scalar type.
pub(super) fn zero(scalar: &Scalar) -> String {
    literal(scalar, Number::ZERO, false)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_are_not_finite_have_names() {
        for (value, name) in [(f64::NAN, "NAN"), (f64::INFINITY, "INFINITY")] {
            let number = Number::Float(value, 0.0);
            let texts = [Scalar::F64, Scalar::F32, generic()].map(|scalar| literal(&scalar, number, true));
            let of_generic = format!("<R as lagrange::Real>::from_f64(f64::{name})");
            assert_eq!(texts, [format!("f64::{name}"), format!("f32::{name}"), of_generic]);
        }
    }

    fn generic() -> Scalar {
        Scalar::Generic(proc_macro2::Ident::new("R", proc_macro2::Span::call_site()))
    }

    #[test]
    fn zero_is_known_by_its_text() {
        let generic = generic();
        for scalar in [Scalar::F64, Scalar::F32, generic] {
            for typed in [false, true] {
                assert_eq!(literal(&scalar, Number::ZERO, typed), zero(&scalar));
            }
        }
    }
}
