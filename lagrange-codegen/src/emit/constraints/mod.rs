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
pub(super) use surface::{implementations, system};

use super::{Emission, scalar};
use crate::mechanics::{LoadRow, Switched};
use crate::model::{ConstraintKind, Model};
use crate::structure::{Saddle, Sparsity};
use crate::syntax::Scalar;

/// Which constraints are holonomic.
pub(in crate::emit) fn kinds(model: &Model) -> Vec<bool> {
    model.constraints.iter().map(|constraint| constraint.kind == ConstraintKind::Holonomic).collect()
}

/// Statements that fill `name` with rows. Zeros are left as they are.
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
pub(super) fn saddle_type(emission: &Emission<'_>, method: Saddle) -> String {
    let (scalar, count, held) = (&emission.scalar, emission.count(), emission.equations.conditions.count());
    let name = match method {
        Saddle::Diagonal => "Diagonal",
        Saddle::Sparse => "Sparse",
        Saddle::Whole { .. } => "Saddle",
        Saddle::Switched { .. } => "Switched",
    };
    let sizes =
        sparsity(emission, method).map_or(String::new(), |it| format!(", {}, {}", it.entries(), it.factor()));
    format!("lagrange::saddle::{name}<{scalar}, {count}, {held}{sizes}>")
}

/// The entries of the gradients that can differ from zero, for a method that uses them.
fn sparsity<'a>(emission: &Emission<'a>, method: Saddle) -> Option<&'a Sparsity> {
    emission.solution.sparsity.as_ref().filter(|_| method == Saddle::Sparse)
}

/// The type of the gradients.
pub(super) fn gradients_type(emission: &Emission<'_>, method: Saddle) -> String {
    let scalar = &emission.scalar;
    match sparsity(emission, method) {
        Some(it) => format!("lagrange::saddle::SparseRows<{scalar}, {}>", it.entries()),
        None => format!("[[{scalar}; {}]; {}]", emission.count(), emission.equations.conditions.count()),
    }
}

/// Statements that make `gradients` of rows.
pub(super) fn gradients(emission: &Emission<'_>, method: Saddle, entries: &[Vec<String>]) -> String {
    let Some(sparsity) = sparsity(emission, method) else {
        return rows(&emission.scalar, "gradients", emission.count(), entries);
    };
    let kept: Vec<&str> = sparsity
        .order
        .iter()
        .zip(&sparsity.coordinates)
        .flat_map(|(&c, coordinates)| coordinates.iter().map(move |&i| entries[c][i].as_str()))
        .collect();
    format!(
        "let gradients = lagrange::saddle::SparseRows::new(<Self as lagrange::Surface<{}, {}, {}>>::PATTERN, [{}]);\n",
        emission.count(),
        emission.model.inputs.len(),
        emission.equations.conditions.count(),
        kept.join(", ")
    )
}

/// The item of `Surface` that lists the entries of the gradients that can differ from zero.
pub(super) fn pattern(emission: &Emission<'_>, method: Saddle) -> String {
    let Some(Sparsity { order, coordinates, coupled, earlier, later }) = sparsity(emission, method) else {
        return String::new();
    };
    let lists = |lists: &[Vec<usize>]| {
        let lists: Vec<String> = lists.iter().map(|list| format!("&{list:?}")).collect();
        format!("&[{}]", lists.join(", "))
    };
    format!(
        "const PATTERN: &'static lagrange::saddle::Pattern = &lagrange::saddle::Pattern {{\n\
         order: &{order:?},\ncoordinates: {},\ncoupled: {},\nearlier: {},\nlater: {},\n}};\n",
        lists(coordinates),
        lists(coupled),
        lists(earlier),
        lists(later)
    )
}

/// The constructor of a factorisation.
fn constructor(emission: &Emission<'_>, method: Saddle) -> &'static str {
    match method {
        Saddle::Whole { definite: true } if emission.is_over => "factor_side_by_side",
        Saddle::Whole { definite: false } | Saddle::Switched { definite: false } => "factor_indefinite",
        Saddle::Diagonal | Saddle::Sparse | Saddle::Whole { .. } | Saddle::Switched { .. } => "factor",
    }
}

/// Statements that fill `coupling`, `active` and `shares` from the values of `Conditions::switches`.
pub(super) fn filled_switches(emission: &Emission<'_>, values: &[String]) -> String {
    let conditions = &emission.equations.conditions;
    let Some(switched) = &conditions.switched else { return String::new() };
    let (scalar, count, held) = (&emission.scalar, emission.count(), conditions.count());
    let (coupling, rest) = values.split_at(count * held);
    let (active, factors) = rest.split_at(held);
    let coupling: Vec<Vec<String>> = coupling.chunks(count).map(<[String]>::to_vec).collect();
    let mut text =
        format!("{}let active = [{}];\n", rows(scalar, "coupling", count, &coupling), active.join(", "));
    if conditions.has_loads() {
        let zero = scalar::zero(scalar);
        let mut shares = vec![vec![zero; held]; held];
        let mut factors = factors.iter();
        for (row, terms) in switched.sums() {
            for (&(other, _), factor) in terms.iter().zip(&mut factors) {
                shares[row][other].clone_from(factor);
            }
        }
        text.push_str(&rows(scalar, "shares", held, &shares));
    }
    text
}

/// The rows that are loads instead of constraints.
fn loads(switched: &Switched) -> String {
    let first = switched.active.len() - switched.loads.len();
    let each = switched.loads.iter().zip(first..).map(|(load, row)| match load {
        LoadRow::Sum(_) => format!("lagrange::saddle::Load::Sum {{ row: {row} }}"),
        LoadRow::Size(parts) => format!("lagrange::saddle::Load::Size {{ row: {row}, parts: &{parts:?} }}"),
    });
    format!("&[{}]", each.collect::<Vec<_>>().join(", "))
}

/// The expression that factors `mass` and `gradients`.
pub(super) fn factored(emission: &Emission<'_>, method: Saddle) -> String {
    let own = saddle_type(emission, method).replacen('<', "::<", 1);
    if let (Saddle::Switched { definite }, Some(switched)) = (method, &emission.equations.conditions.switched)
        && !switched.loads.is_empty()
    {
        return format!(
            "{own}::factor_loaded::<{definite}>(&mass, &gradients, &coupling, &active, &shares, {})",
            loads(switched)
        );
    }
    let arguments = match method {
        Saddle::Diagonal => "mass, &gradients",
        Saddle::Sparse => "mass, gradients",
        Saddle::Whole { .. } => "&mass, &gradients",
        Saddle::Switched { .. } => "&mass, &gradients, &coupling, &active",
    };
    format!("{own}::{}({arguments})", constructor(emission, method))
}
