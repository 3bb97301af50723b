//! Facts about single expressions.

use quote::ToTokens;
use syn::{Expr, Lit};

use super::value::{Run, Value, unknown};

/// `self`, or a field or an element of it.
pub fn rooted_in_self(expr: &Expr) -> bool {
    match expr {
        Expr::Path(path) => path.path.is_ident("self"),
        Expr::Field(field) => rooted_in_self(&field.base),
        Expr::Index(index) => rooted_in_self(&index.expr),
        _ => false,
    }
}

pub fn literal_value(literal: &Lit) -> Run<Value> {
    match literal {
        // Zero, one and powers of ten can lack the decimal point of a float, not its suffix.
        Lit::Float(float) => match float.base10_parse() {
            Ok(value) => Ok(Value::Number(value)),
            Err(error) => unknown(error.to_string()),
        },
        Lit::Int(integer) => match integer.base10_parse() {
            Ok(value) => Ok(Value::Integer(value)),
            Err(error) => unknown(error.to_string()),
        },
        Lit::Bool(boolean) => Ok(Value::Truth(boolean.value)),
        _ => unknown(text(literal)),
    }
}

/// The segments of a path without the arguments of types.
pub fn path_of(function: &Expr) -> String {
    match function {
        Expr::Path(path) => {
            path.path.segments.iter().map(|segment| segment.ident.to_string()).collect::<Vec<_>>().join("::")
        }
        other => text(other),
    }
}

/// Tokens without blanks.
pub fn text(tokens: &impl ToTokens) -> String {
    tokens.to_token_stream().to_string().split_whitespace().collect()
}
