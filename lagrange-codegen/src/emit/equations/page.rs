//! The documentation of the generated block: what a teacher would print.

use super::fold::folded;
use super::{Equations, Writer, readable, symbols, unicode};
use crate::collections::Lookup;
use crate::emit::Emission;
use crate::expr::NodeId;
use crate::schedule::Operations;

/// The most nodes, written out, of an expression on the page.
const LONGEST: u64 = 240;

/// The page as markdown.
pub(in crate::emit) fn page(emission: &mut Emission<'_>, equations: &Equations, after: Operations) -> String {
    let plain = equations.text(emission.model);
    let mut text = format!("# Model\n\n{}", states(emission));
    text.push_str(&energies(emission));
    text.push_str(&format!("\nEquations of motion:\n\n```text\n{}```\n", folded(&plain)));
    text.push_str(&findings(emission, after));
    text
}

/// The table of the state.
fn states(emission: &Emission<'_>) -> String {
    const MOST: usize = 24;
    let mut text = "| place | coordinate | velocity | |\n| --- | --- | --- | --- |\n".to_owned();
    let model = &*emission.model;
    for (i, quantity) in model.coordinates.iter().enumerate().take(MOST) {
        let symbol = |dots| unicode::symbol(&symbols::coordinate(model, i as u32, dots));
        let cyclic = if emission.facts.cyclic.contains(&i) { "cyclic" } else { "" };
        let (symbol, velocity, written) = (symbol(0), symbol(1), quantity.written());
        let code = if symbol == written { String::new() } else { format!(" `{written}`") };
        text.push_str(&format!("| {i} | {symbol}{code} | {velocity} | {cyclic} |\n"));
    }
    if emission.count() > MOST {
        text.push_str(&format!("| … | {} in all | | |\n", emission.count()));
    }
    if !model.inputs.is_empty() {
        let inputs: Vec<String> =
            model.inputs.iter().take(MOST).map(|input| format!("`{}`", input.written())).collect();
        text.push_str(&format!("\nInputs: {}\n", inputs.join(", ")));
    }
    text
}

/// T, V, Lagrangians, dissipation functions and constraints.
fn energies(emission: &mut Emission<'_>) -> String {
    let energies = [emission.equations.kinetic_energy, emission.equations.potential_energy];
    let [kinetic, potential] = energies.map(|node| {
        let graph = &mut emission.model.graph;
        if graph.tree_size(node) <= 2 * LONGEST { readable::with_angles(graph, &[node])[0] } else { node }
    });
    let model = &*emission.model;
    let writer = Writer { model, names: Lookup::default() };
    let written = |symbol: &str, node: NodeId| {
        (model.graph.tree_size(node) <= LONGEST)
            .then(|| format!("{symbol} = {}\n", unicode::formula(&writer.expression(node))))
    };
    let mut lines = String::new();
    for (symbol, node) in [("T", kinetic), ("V", potential)] {
        lines.extend(written(symbol, node));
    }
    for term in &model.lagrangian {
        lines.extend(written("L", term.value));
    }
    for term in &model.dissipation {
        lines.extend(written("D", term.value));
    }
    for constraint in &model.constraints {
        lines.extend(written(&format!("0 = {}", constraint.written()), constraint.value));
    }
    if lines.is_empty() {
        lines
    } else {
        format!("\nEnergies and constraints:\n\n```text\n{}```\n", folded(&lines))
    }
}

/// Structure and operation counts.
fn findings(emission: &Emission<'_>, after: Operations) -> String {
    let matrix = emission.solution.describe();
    let mut text = format!("\n* mass matrix: {matrix}\n");
    for fact in emission.facts.found(emission.model) {
        text.push_str(&format!("* {fact}\n"));
    }
    let Operations { additions, multiplications, divisions, square_roots, functions } = after;
    let counts = [
        (additions, "additions"),
        (multiplications, "multiplications"),
        (divisions, "divisions"),
        (square_roots, "square roots"),
        (functions, "elementary functions"),
    ];
    let counts: Vec<String> = counts
        .into_iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| {
            format!("{count} {}", if count == 1 { what.trim_end_matches('s') } else { what })
        })
        .collect();
    text.push_str(&format!("* operations of one evaluation: {}\n", counts.join(", ")));
    text
}
