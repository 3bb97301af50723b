//! Replacement of nodes by others, everything above them rebuilt in normal form.

use crate::expr::{Exponent, Graph, Node, NodeId};
use crate::number::Number;

/// The roots with every node of `replacements` replaced.
pub fn substitute(graph: &mut Graph, roots: &[NodeId], replacements: &[(NodeId, NodeId)]) -> Vec<NodeId> {
    if replacements.is_empty() {
        return roots.to_vec();
    }
    let mut images: Vec<Option<NodeId>> = vec![None; graph.len()];
    for &(node, image) in replacements {
        images[node.index()] = Some(image);
    }
    for id in graph.cone(roots.iter().copied()) {
        if images[id.index()].is_none() {
            images[id.index()] =
                Some(rebuild(graph, id, |operand| images[operand.index()].unwrap_or(operand)));
        }
    }
    roots.iter().map(|root| images[root.index()].unwrap_or(*root)).collect()
}

/// A node with its operands mapped.
pub fn rebuild(graph: &mut Graph, id: NodeId, image: impl Fn(NodeId) -> NodeId) -> NodeId {
    let mut changed = false;
    graph.operands(id, |operand| changed |= image(operand) != operand);
    if !changed {
        return id;
    }
    match graph.node(id).clone() {
        Node::Constant(_) | Node::Variable(_) => id,
        Node::Sum { offset, terms } => {
            let terms: Vec<(NodeId, Number)> = terms.iter().map(|&(t, c)| (image(t), c)).collect();
            graph.sum(offset, &terms)
        }
        Node::Product(factors) => {
            let factors: Vec<(NodeId, Exponent)> = factors.iter().map(|&(f, e)| (image(f), e)).collect();
            graph.product(&factors)
        }
        Node::Unary(function, argument) => graph.unary(function, image(argument)),
        Node::Binary(function, first, second) => graph.binary(function, image(first), image(second)),
    }
}
