//! What a system with constraints has beyond others: multipliers by name, the saddle-point system,
//! projection.
//!
//! | file | what it emits |
//! | --- | --- |
//! | `surface` | `System` and the runtime's `Surface`: accelerations with multipliers, residuals, factors |
//! | `methods` | the inherent methods |
//! | `places` | forces on particles and bodies |
//! | `record` | the struct that has a field for each constraint |

mod methods;
mod places;
mod record;
mod surface;

pub(crate) use methods::METHODS;
pub(super) use methods::{balance_at, consistent, methods, of_balance};
pub(in crate::emit) use places::PREFIX;
pub(crate) use places::is_generated as is_force_on_place;
pub(super) use record::{Held, declared, held, record, record_ident};
pub(super) use surface::{Implementations, implementations, system};

use super::scalar;
use crate::structure::Saddle;
use crate::syntax::Scalar;

/// Statements that fill `name` with rows; what is zero stays.
pub(super) fn rows(scalar: &Scalar, name: &str, width: usize, rows: &[Vec<String>]) -> String {
    let zero = scalar::zero(scalar);
    let mut text = format!("let mut {name} = [[{zero}; {width}]; {}];\n", rows.len());
    for (c, row) in rows.iter().enumerate() {
        for (i, entry) in row.iter().enumerate().filter(|(_, entry)| **entry != zero) {
            text.push_str(&format!("{name}[{c}][{i}] = {entry};\n"));
        }
    }
    text
}

/// The type that factors M and A.
pub(super) fn saddle_type(method: Saddle, scalar: &Scalar, count: usize, constraints: usize) -> String {
    let name = match method {
        Saddle::Diagonal => "Diagonal",
        Saddle::Whole { .. } => "Saddle",
        Saddle::Switched { .. } => "Switched",
    };
    format!("lagrange::saddle::{name}<{scalar}, {count}, {constraints}>")
}

/// The constructor of a factorisation.
pub(super) fn constructor(method: Saddle) -> &'static str {
    match method {
        Saddle::Whole { definite: false } | Saddle::Switched { definite: false } => "factor_indefinite",
        Saddle::Diagonal | Saddle::Whole { .. } | Saddle::Switched { .. } => "factor",
    }
}

/// Statements that fill `coupling` and `active` from the values of `Conditions::switches`.
pub(super) fn filled_switches(scalar: &Scalar, count: usize, held: usize, values: &[String]) -> String {
    if values.is_empty() {
        return String::new();
    }
    let (coupling, active) = values.split_at(count * held);
    let coupling: Vec<Vec<String>> = coupling.chunks(count).map(<[String]>::to_vec).collect();
    format!("{}let active = [{}];\n", rows(scalar, "coupling", count, &coupling), active.join(", "))
}

/// The expression that factors `mass` and `gradients`.
pub(super) fn factored(method: Saddle, scalar: &Scalar, count: usize, constraints: usize) -> String {
    let (name, arguments) = match method {
        Saddle::Diagonal => ("Diagonal", "mass, &gradients"),
        Saddle::Whole { .. } => ("Saddle", "&mass, &gradients"),
        Saddle::Switched { .. } => ("Switched", "&mass, &gradients, &coupling, &active"),
    };
    let constructor = constructor(method);
    format!("lagrange::saddle::{name}::<{scalar}, {count}, {constraints}>::{constructor}({arguments})")
}
