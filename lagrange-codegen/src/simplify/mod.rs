//! Rewritings that lower the cost of a set of roots and keep their accuracy.
//!
//! Sums of angles are rewritten wherever that spares a call. Every other pass proposes, and [`mod@cost`]
//! decides. A proposal is kept only if the whole set of roots gets cheaper, so expressions cannot swell.

mod accuracy;
mod angles;
pub mod cost;
mod expand;
mod factor;

use crate::expr::{Graph, NodeId};
use crate::model::Hints;
use cost::cost;

/// The most nodes for which products are multiplied out. Whether that is kept is decided for each root by the
/// cost of all, which takes time in proportion to roots × nodes. Larger systems are chains, which nest well.
const COMPARABLE: usize = 4_000;

/// Cheaper roots of equal value.
pub fn simplify(graph: &mut Graph, hints: &mut Hints, roots: &[NodeId]) -> Vec<NodeId> {
    let mut best = angles::add_angles(graph, roots);
    carry_hints(graph, hints, roots, &best);
    let comparable = graph.cone(best.iter().copied()).len() <= COMPARABLE;
    if comparable {
        let expanded = expand::expand(graph, &best);
        best = cheaper_of_each(graph, best, &expanded);
    }
    let factored = factor::factor(graph, &best);
    if cost(graph, &factored) < cost(graph, &best) {
        carry_hints(graph, hints, &best, &factored);
        best = factored;
    }
    best
}

/// The cost of the roots: simplified if cancellations are searched for, else as they are.
pub fn price(graph: &mut Graph, hints: &mut Hints, roots: &[NodeId]) -> u32 {
    if graph.cone(roots.iter().copied()).len() > COMPARABLE {
        return cost(graph, roots);
    }
    let simpler = simplify(graph, hints, roots);
    cost(graph, &simpler)
}

/// Takes a proposal as a whole if that is cheaper, else root by root what lowers the cost of all roots.
fn cheaper_of_each(graph: &Graph, mut roots: Vec<NodeId>, proposal: &[NodeId]) -> Vec<NodeId> {
    let mut lowest = cost(graph, &roots);
    let all = cost(graph, proposal);
    if all < lowest {
        roots = proposal.to_vec();
        return roots;
    }
    for index in 0..roots.len() {
        if proposal[index] == roots[index] {
            continue;
        }
        let kept = std::mem::replace(&mut roots[index], proposal[index]);
        let tried = cost(graph, &roots);
        if tried < lowest {
            lowest = tried;
        } else {
            roots[index] = kept;
        }
    }
    roots
}

/// The image of a node of an ascending cone whose nodes are rewritten in order.
fn image_of(cone: &[NodeId], images: &[NodeId], node: NodeId) -> NodeId {
    cone.binary_search(&node).map_or(node, |index| images[index])
}

/// Roots keep the names they had before they were rewritten.
fn carry_hints(graph: &Graph, hints: &mut Hints, before: &[NodeId], after: &[NodeId]) {
    for (&old, &new) in before.iter().zip(after) {
        if let Some(name) = hints.name(old).map(str::to_owned)
            && old != new
            && graph.as_constant(new).is_none()
        {
            hints.suggest(new, name);
        }
    }
}

#[cfg(test)]
mod tests;
