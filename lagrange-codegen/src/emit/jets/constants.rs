//! The computations of a motion that are made once: values of parameters alone, and the factorisations of
//! constant blocks.

use super::solvers::factor_type;
use crate::emit::Emission;
use crate::emit::block;
use crate::emit::body;
use crate::emit::names::Names;
use crate::orders::{By, Expansion};
use crate::schedule::Slot;

/// The type of the constants, and the body that computes them.
pub(super) fn constants(
    emission: &Emission<'_>,
    expansion: &Expansion,
    hoisted: &[Slot],
) -> (String, String) {
    let (model, scalar) = (&*emission.model, &emission.scalar);
    let constant = || {
        expansion.solvers.iter().filter_map(|solver| match &solver.by {
            By::Factors { indefinite, constant: true, entries } => {
                Some((factor_type(*indefinite, scalar, solver.coordinates.len()), solver, entries))
            }
            _ => None,
        })
    };
    let mut outputs = hoisted.to_vec();
    outputs.extend(constant().flat_map(|(_, _, entries)| entries));
    let mut names = Names::new(model);
    let block = block::write(model, scalar, &expansion.program, &outputs, &[], &mut names);
    let mut ty = format!("[{scalar}; {}]", hoisted.len());
    let mut value = block.outputs.part(0..hoisted.len()).list();
    let mut entries = &block.outputs[hoisted.len()..];
    let (mut types, mut factors) = (String::new(), String::new());
    for (name, solver, own) in constant() {
        let (texts, rest) = entries.split_at(own.len());
        entries = rest;
        let lower = body::lower_triangle(scalar, solver.coordinates.len(), texts);
        types.push_str(&format!("::core::option::Option<{name}>, "));
        factors.push_str(&format!("{{\n{lower}lagrange::solve::factor(mass)\n}}, "));
    }
    if !factors.is_empty() {
        (ty, value) = (format!("({ty}, {types})"), format!("({value}, {factors})"));
    }
    let text = format!("{}{}{value}", body::parameters(model, scalar, &block.reads), body::assemble(&block));
    (ty, body::imported(text))
}
