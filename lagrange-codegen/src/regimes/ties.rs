//! Switches whose argument is zero for a while.
//!
//! In `let depth = (-q.y).max(0.0); if depth > 0.0 { … }` the argument of the second switch is zero as long
//! as the first one is on one of its sides. No motion tells the side of such a zero, but Rust does: the
//! condition is false there. So the second switch is asked on each side of the first by itself, as `if q.y <
//! 0.0` with the condition inside: where its argument is a constant it disappears, and elsewhere it is a
//! function that crosses zero like any other. The same holds for flags, modes, and numbers that are compared
//! with the bound that holds them.

use super::kinks::{MOVING, kinked};
use crate::calculus::substitute;
use crate::eliminate::quantities::{self, rewrite};
use crate::expr::{Graph, Node, NodeId, Unary};
use crate::model::Model;
use crate::number::Number;

/// The most combinations of sides that are looked at for a switch. Beyond them, it stays as it is.
const MOST: usize = 256;

/// Takes the inner switches out of those whose argument they make zero for a while.
pub fn untie(model: &mut Model) {
    let roots = quantities::roots(model);
    let graph = &mut model.graph;
    let mut replacements: Vec<(NodeId, NodeId)> = Vec::new();
    // Inner ones come first.
    for id in graph.cone(roots) {
        let Node::Unary(function, argument) = *graph.node(id) else { continue };
        if kinked(graph, id).is_none() {
            continue;
        }
        let argument = substitute(graph, &[argument], &replacements)[0];
        let image = match may_tie(graph, argument, &mut { MOST }) {
            Some(true) => asked_apart(graph, function, argument),
            Some(false) | None => graph.unary(function, argument),
        };
        if image != id {
            replacements.push((id, image));
        }
    }
    if !replacements.is_empty() {
        rewrite(model, &replacements);
    }
}

/// The arguments of the switches in a node, inner ones first. A condition and its opposite differ where both
/// sides are equal, so an argument and its negative are two.
fn inner(graph: &Graph, node: NodeId) -> Vec<NodeId> {
    let mut arguments = Vec::new();
    for argument in graph.cone([node]).into_iter().filter_map(|id| kinked(graph, id)) {
        if !arguments.contains(&argument) {
            arguments.push(argument);
        }
    }
    arguments
}

/// Whether a node with switches is a constant that may be zero on some of their sides. `left` is the number
/// of combinations that may be looked at; `None` if there are more.
fn may_tie(graph: &mut Graph, node: NodeId, left: &mut usize) -> Option<bool> {
    let Some(&first) = inner(graph, node).first() else { return Some(false) };
    let mut ties = false;
    for is_above in [true, false] {
        let there = on_side(graph, node, first, is_above);
        *left = left.checked_sub(1)?;
        ties |= if graph.dependence(there).meets(MOVING) {
            may_tie(graph, there, left)?
        } else {
            graph.as_constant(there).is_none_or(Number::is_zero)
        };
    }
    Some(ties)
}

/// A function with a kink or a jump of an argument that contains others: its forms on their sides, each where
/// it holds.
fn asked_apart(graph: &mut Graph, function: Unary, argument: NodeId) -> NodeId {
    let Some(&first) = inner(graph, argument).first() else { return graph.unary(function, argument) };
    let [above, below] = [true, false].map(|is_above| {
        let there = on_side(graph, argument, first, is_above);
        asked_apart(graph, function, there)
    });
    if above == below {
        return above;
    }
    let [is_above, is_below] = graph.sides(first);
    let parts = [graph.mul(is_above, above), graph.mul(is_below, below)];
    graph.add(parts[0], parts[1])
}

/// A node on one side of the switch with an argument. At its zero a condition counts as not negative, and not
/// as that of the negative argument does.
fn on_side(graph: &mut Graph, node: NodeId, argument: NodeId, is_above: bool) -> NodeId {
    let (zero, one, opposite) = (graph.zero(), graph.one(), graph.neg(argument));
    let minus_one = graph.neg(one);
    let [holds, fails] = if is_above { [one, zero] } else { [zero, one] };
    let sign = if is_above { one } else { minus_one };
    let [own, other] = if is_above { [argument, zero] } else { [zero, opposite] };
    let other_sign = graph.neg(sign);
    let images = [
        (Unary::Step, argument, holds),
        (Unary::Below, argument, fails),
        (Unary::PositivePart, argument, own),
        (Unary::PositivePart, opposite, other),
        (Unary::Abs, argument, if is_above { argument } else { opposite }),
        (Unary::Signum, argument, sign),
        (Unary::Signum, opposite, other_sign),
    ];
    let mut replacements = Vec::new();
    for (function, argument, image) in images {
        let value = graph.unary(function, argument);
        // The sign of the argument of an even or odd function is chosen by the graph.
        if matches!(*graph.node(value), Node::Unary(own, _) if own == function) {
            replacements.push((value, image));
        }
    }
    substitute(graph, &[node], &replacements)[0]
}
