//! Reverse accumulation.

use super::local;
use crate::expr::{Exponent, Graph, Node, NodeId};
use crate::number::Number;

/// `Σ seed · ∂output/∂variable` for every node of `wrt`, given `(output, seed)` pairs.
///
/// The adjoint of a shared node is one sum, so the adjoints of partial sums are partial sums
/// again and the result stays linear in the size of the graph.
pub fn pullback(graph: &mut Graph, seeds: &[(NodeId, NodeId)], wrt: &[NodeId]) -> Vec<NodeId> {
    pullback_to(graph, seeds, &[], wrt).1
}

/// The same as a function of the nodes of `held` and of those of `wrt`: what passes through the former counts
/// there alone. A node that `held` has more than once counts the first time, and a variable never.
pub fn pullback_to(
    graph: &mut Graph,
    seeds: &[(NodeId, NodeId)],
    held: &[NodeId],
    wrt: &[NodeId],
) -> (Vec<NodeId>, Vec<NodeId>) {
    let size = graph.len();
    let mut active = vec![false; size];
    for &variable in wrt {
        active[variable.index()] = true;
    }
    // Nothing passes through a variable on the way to another, so it belongs to `wrt` alone.
    let mut ends = vec![false; size];
    for &node in held.iter().filter(|node| !matches!(graph.node(**node), Node::Variable(_))) {
        ends[node.index()] = true;
    }
    let cone = graph.cone(seeds.iter().map(|&(output, _)| output));
    for &id in &cone {
        let mut reaches = active[id.index()];
        graph.operands(id, |operand| reaches |= active[operand.index()]);
        active[id.index()] = reaches;
    }
    let mut adjoints: Vec<Vec<(NodeId, Number)>> = vec![Vec::new(); size];
    for &(output, seed) in seeds {
        adjoints[output.index()].push((seed, Number::ONE));
    }
    let mut finished: Vec<Option<NodeId>> = vec![None; size];
    for &id in cone.iter().rev() {
        if !active[id.index()] || adjoints[id.index()].is_empty() {
            continue;
        }
        let terms = std::mem::take(&mut adjoints[id.index()]);
        let adjoint = graph.sum(Number::ZERO, &terms);
        if graph.is_zero(adjoint) {
            continue;
        }
        finished[id.index()] = Some(adjoint);
        if ends[id.index()] {
            continue;
        }
        distribute(graph, id, adjoint, &active, &mut adjoints);
    }
    let zero = graph.zero();
    let mut at_held = Vec::with_capacity(held.len());
    for node in held {
        let ended = ends[node.index()].then(|| finished[node.index()].take()).flatten();
        at_held.push(ended.unwrap_or(zero));
    }
    (at_held, wrt.iter().map(|variable| finished[variable.index()].unwrap_or(zero)).collect())
}

/// Adds the share of `adjoint` to the adjoints of the operands of `id`.
fn distribute(
    graph: &mut Graph,
    id: NodeId,
    adjoint: NodeId,
    active: &[bool],
    adjoints: &mut [Vec<(NodeId, Number)>],
) {
    match graph.node(id).clone() {
        Node::Constant(_) | Node::Variable(_) => {}
        Node::Sum { terms, .. } => {
            for (term, coefficient) in terms {
                if active[term.index()] {
                    adjoints[term.index()].push((adjoint, coefficient));
                }
            }
        }
        Node::Product(factors) => {
            for (index, &(factor, exponent)) in factors.iter().enumerate() {
                if !active[factor.index()] {
                    continue;
                }
                let mut others = factors.clone();
                others[index].1 = Exponent(exponent.0 - 2);
                others.push((adjoint, Exponent(2)));
                let share = graph.product(&others);
                let power = Number::halves(exponent.0);
                adjoints[factor.index()].push((share, power));
            }
        }
        Node::Unary(function, argument) => {
            if active[argument.index()] {
                let slope = local::unary(graph, function, argument, id);
                let share = graph.mul(adjoint, slope);
                adjoints[argument.index()].push((share, Number::ONE));
            }
        }
        Node::Binary(function, first, second) => {
            let (by_first, by_second) = local::binary(graph, function, first, second);
            for (slope, operand) in [(by_first, first), (by_second, second)] {
                if active[operand.index()] {
                    let share = graph.mul(adjoint, slope);
                    adjoints[operand.index()].push((share, Number::ONE));
                }
            }
        }
    }
}
