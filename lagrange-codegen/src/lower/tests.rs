//! Lowering of whole descriptions.

mod branches;
mod constraints;
mod form;
mod jumps;
mod language;
mod meaning;
mod mechanisms;
mod nalgebra;
mod whole;

use proc_macro2::TokenStream;

use crate::diagnostics::Diagnostics;
use crate::expr::{NodeId, Variable};
use crate::model::Model;
use crate::syntax;

/// The model of a description, or the messages about it.
pub fn lowered(args: TokenStream, item: TokenStream) -> Result<Model, Vec<String>> {
    let mut diagnostics = Diagnostics::new();
    let messages = |diagnostics: &Diagnostics| diagnostics.messages().map(String::from).collect();
    let item = syntax::parse(args, item, "::lagrange_runtime", &mut diagnostics);
    let Some(item) = item.filter(|item| item.incomplete.is_none()) else {
        return Err(messages(&diagnostics));
    };
    let model = super::lower(&item, &mut diagnostics);
    match diagnostics.has_errors() {
        true => Err(messages(&diagnostics)),
        false => Ok(model),
    }
}

/// Values of the variables in tests: q = 0.3, 0.7, …; v = −0.4, 0.1, …; t = 0.9; u = 1.5, 2.5, …;
/// parameters by the function.
pub fn value(model: &Model, node: NodeId, parameter: impl Fn(&str) -> f64) -> f64 {
    let variable = |variable: Variable| match variable {
        Variable::Coordinate(i) => 0.3 + 0.4 * f64::from(i),
        Variable::Velocity(i) => -0.4 + 0.5 * f64::from(i),
        Variable::Acceleration(_)
        | Variable::Auxiliary(_)
        | Variable::Entry(_)
        | Variable::Multiplier(_)
        | Variable::Position(_)
        | Variable::Time => 0.9,
        Variable::Input(i) => 1.5 + f64::from(i),
        Variable::Parameter(i) => parameter(&model.parameters[i as usize].path),
    };
    model.graph.evaluate(&[node], variable)[0]
}

/// The value at given coordinates.
pub fn value_at(model: &Model, node: NodeId, coordinates: &[f64]) -> f64 {
    let variable = |variable: Variable| match variable {
        Variable::Coordinate(i) => coordinates[i as usize],
        other => panic!("{other:?}"),
    };
    model.graph.evaluate(&[node], variable)[0]
}

/// The one message about a description starts as given.
pub fn refused(args: TokenStream, item: TokenStream, start: &str) {
    let messages = match lowered(args, item.clone()) {
        Ok(_) => panic!("accepted: {item}"),
        Err(messages) => messages,
    };
    assert!(
        messages.len() == 1 && messages[0].starts_with(start),
        "{item}\n{messages:#?}\ninstead of {start}"
    );
}
