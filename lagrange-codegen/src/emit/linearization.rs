//! The implementation of the runtime's `Linearized`, where the attribute asks for it.

use super::body::{self, Source};
use super::names::name_accelerations;
use super::{Emission, scalar};
use crate::expr::NodeId;
use crate::mechanics::Linearization;
use crate::simplify::simplify;

/// Larger matrices are filled row by row in functions of their own.
const OUTLINED: usize = 32;

/// The trait's items as text.
pub(super) fn linearization(emission: &mut Emission<'_>) -> Option<String> {
    if !emission.item.jacobians {
        return None;
    }
    name_accelerations(emission.model);
    let Linearization { residual, by_q, by_v, by_u } = Linearization::of(emission.model, emission.equations);
    let (count, inputs) = (emission.count(), emission.model.inputs.len());
    let scalar = &emission.item.scalar.to_string();
    let vector = emission.vector_type();
    let place = format!("&self, _constants: &Self::Constants, t: {scalar}, q: &{vector}, v: &{vector}");

    let residual = function(emission, &residual, |values| format!("[{}]", values.join(", ")));
    let full = |i: usize| (0..count).map(move |j| (i.max(j), i.min(j)));
    let mass: Vec<NodeId> = (0..count).flat_map(full).map(|(i, j)| emission.equations.mass[i][j]).collect();
    let roots: Vec<NodeId> =
        mass.into_iter().chain(by_q.into_iter().flatten()).chain(by_v.into_iter().flatten()).collect();
    let zero = scalar::zero(&emission.item.scalar);
    let matrices = function(emission, &roots, |values| {
        let empty = format!("[[{zero}; {count}]; {count}]");
        let mut text = format!(
            "let mut matrices = lagrange::Linearization {{ mass: {empty}, by_q: {empty}, by_v: {empty} }};\n"
        );
        for (name, entries) in ["mass", "by_q", "by_v"].into_iter().zip(values.chunks(count * count)) {
            text.push_str(&matrix(name, &zero, count, entries));
        }
        text + "matrices"
    });
    let by_u: Vec<NodeId> = by_u.into_iter().flatten().collect();
    let by_inputs = function(emission, &by_u, |values| {
        let rows = values.chunks(inputs.max(1)).map(|row| format!("[{}]", row.join(", ")));
        let rows: Vec<String> = rows.collect();
        if inputs == 0 { format!("[[]; {count}]") } else { format!("[{}]", rows.join(", ")) }
    });

    let given = format!("accelerations: &{vector}, u: &{}", emission.input_type());
    let inputs_only = format!("u: &{}", emission.input_type());
    Some(format!(
        "#[inline]\nfn residual_at({place}, {given}) -> {vector} {{\n{residual}\n}}\n\
         #[inline]\nfn linearization_at({place}, {given}) -> lagrange::Linearization<{scalar}, {count}> \
         {{\n{matrices}\n}}\n\
         #[inline]\nfn by_inputs_at({place}, {inputs_only}) -> [[{scalar}; {inputs}]; {count}] {{\n{by_inputs}\n}}\n"
    ))
}

/// A body that computes some nodes.
fn function(
    emission: &mut Emission<'_>,
    nodes: &[NodeId],
    result: impl FnOnce(&[String]) -> String,
) -> String {
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, nodes);
    body::plain(emission.model, &emission.item.scalar, &nodes, Source::Slices, result)
}

/// Statements that fill one of the matrices; what is zero stays.
fn matrix(name: &str, zero: &str, count: usize, entries: &[String]) -> String {
    let mut text = String::new();
    for (i, row) in entries.chunks(count).enumerate() {
        let filled: Vec<(usize, &String)> =
            row.iter().enumerate().filter(|(_, entry)| *entry != zero).collect();
        if count <= OUTLINED {
            for (j, entry) in filled {
                text.push_str(&format!("matrices.{name}[{i}][{j}] = {entry};\n"));
            }
            continue;
        }
        text.push_str(&format!(
            "matrices.{name}[{i}] = lagrange::solve::outlined(move || {{\nlet mut row = [{zero}; {count}];\n"
        ));
        for (j, entry) in filled {
            text.push_str(&format!("row[{j}] = {entry};\n"));
        }
        text.push_str("row\n});\n");
    }
    text
}
