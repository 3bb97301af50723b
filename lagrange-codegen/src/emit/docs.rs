//! Doc comments of generated items: what an item computes, with its equation if that is short.

use crate::expr::{NodeId, Variable};
use crate::model::Model;

/// The most characters of an equation in a doc comment.
const WIDEST: usize = 120;

/// An equation for each of several nodes, as a list; empty if one of them is too long.
pub(super) fn equations(model: &Model, symbol: &str, nodes: &[NodeId]) -> String {
    let mut lines = String::new();
    for (quantity, &node) in model.coordinates.iter().zip(nodes) {
        let Some(text) = expression(model, node) else { return String::new() };
        let index = quantity.index.map_or(String::new(), |index| format!("[{index}]"));
        lines.push_str(&format!("\n- `{symbol}({}{index}) = {text}`", quantity.name));
    }
    format!("\n{lines}")
}

/// An equation for each constraint, as a list; empty if one of them is too long.
pub(super) fn constraints(model: &Model, symbol: &str, nodes: &[NodeId]) -> String {
    let mut lines = String::new();
    for (constraint, &node) in model.constraints.iter().zip(nodes) {
        let Some(text) = expression(model, node) else { return String::new() };
        lines.push_str(&format!("\n- `{symbol}({}) = {text}`", constraint.written()));
    }
    format!("\n{lines}")
}

/// `symbol = expression`; empty if that is too long.
pub(super) fn equation(model: &Model, symbol: &str, node: NodeId) -> String {
    expression(model, node).map_or(String::new(), |text| format!("\n\n`{symbol} = {text}`"))
}

/// An equation for each of several named nodes, as a list; those that are too long are left out.
pub(super) fn named(model: &Model, nodes: impl Iterator<Item = (String, NodeId)>) -> String {
    let lines: String = nodes
        .filter_map(|(name, node)| expression(model, node).map(|text| format!("\n- `{name} = {text}`")))
        .collect();
    format!("\n{lines}")
}

/// A short expression in the user's names.
fn expression(model: &Model, node: NodeId) -> Option<String> {
    // Shared parts are printed at each use, so the size is checked first.
    if model.graph.cone([node]).len() > WIDEST / 2 || model.graph.tree_size(node) > WIDEST as u64 {
        return None;
    }
    let text = model.graph.print(node, &|variable| name(model, variable));
    (text.chars().count() <= WIDEST && !text.contains('`')).then_some(text)
}

/// A variable as the user wrote it; velocities with a prime.
fn name(model: &Model, variable: Variable) -> String {
    let indexed = |name: &str, index: Option<usize>, mark: &str| match index {
        Some(index) => format!("{name}{mark}[{index}]"),
        None => format!("{name}{mark}"),
    };
    match variable {
        Variable::Coordinate(i) => {
            let quantity = &model.coordinates[i as usize];
            indexed(&quantity.name, quantity.index, "")
        }
        Variable::Velocity(i) => {
            let quantity = &model.coordinates[i as usize];
            indexed(&quantity.name, quantity.index, "′")
        }
        Variable::Acceleration(i) => {
            let quantity = &model.coordinates[i as usize];
            indexed(&quantity.name, quantity.index, "″")
        }
        Variable::Time => "t".to_owned(),
        Variable::Input(i) => {
            let quantity = &model.inputs[i as usize];
            indexed(&quantity.name, quantity.index, "")
        }
        Variable::Auxiliary(i) => model.locals.auxiliaries[i as usize].clone(),
        Variable::Entry(i) => model.locals.entries[i as usize].clone(),
        Variable::Position(i) => format!("r[{i}]"),
        Variable::Multiplier(i) => model.locals.multipliers[i as usize].clone(),
        Variable::Parameter(i) => {
            let path = &model.parameters[i as usize].path;
            path.strip_prefix("self.").unwrap_or(path).to_owned()
        }
    }
}
