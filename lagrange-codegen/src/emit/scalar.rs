//! Numbers and functions of the scalar type as text.

use crate::number::Number;
use crate::syntax::Scalar;

/// A nonnegative constant as an expression of the scalar type, exact to the last bit. With `typed` nothing is
/// left to inference, for which the compiler takes quadratic time in long functions. Zero has one text either
/// way, because zeros are recognised by it. A type parameter may have bounds beside `Real`, so calls name the
/// trait.
pub(super) fn literal(scalar: &Scalar, number: Number, typed: bool) -> String {
    let value = number.value();
    match scalar {
        Scalar::F64 if value.is_infinite() => "f64::INFINITY".to_owned(),
        Scalar::F32 if value.is_infinite() => "f32::INFINITY".to_owned(),
        Scalar::F64 if typed && !number.is_zero() => format!("{value:?}_f64"),
        Scalar::F64 => format!("{value:?}"),
        // The suffix keeps inference from an open float type in a trait call.
        Scalar::F32 => format!("{value:?}_f32"),
        Scalar::Generic(ident) if number.is_one() => format!("<{ident} as lagrange::One>::one()"),
        Scalar::Generic(ident) if number.is_zero() => format!("<{ident} as lagrange::Zero>::zero()"),
        Scalar::Generic(ident) if value.is_infinite() => {
            format!("<{ident} as lagrange::Real>::from_f64(f64::INFINITY)")
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
    fn zero_is_known_by_its_text() {
        let generic = Scalar::Generic(proc_macro2::Ident::new("R", proc_macro2::Span::call_site()));
        for scalar in [Scalar::F64, Scalar::F32, generic] {
            for typed in [false, true] {
                assert_eq!(literal(&scalar, Number::ZERO, typed), zero(&scalar));
            }
        }
    }
}
