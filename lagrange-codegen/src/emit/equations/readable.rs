//! Rewritings for a reader: addition theorems of sine and cosine, and products multiplied out.
//!
//! The cheapest form, such as sin a sin b + cos a cos b with four values at hand, is not that of a textbook.

use crate::calculus::rebuild;
use crate::collections::Lookup;
use crate::expr::{Exponent, Graph, Node, NodeId, Unary};
use crate::number::Number;

/// The most terms of a sum that is rewritten.
const MOST: usize = 24;

/// Expressions with addition theorems applied: cos a cos b + sin a sin b becomes cos(a − b), and so on.
pub(super) fn with_angles(graph: &mut Graph, roots: &[NodeId]) -> Vec<NodeId> {
    let mut images: Lookup<NodeId, NodeId> = Lookup::default();
    for id in graph.cone(roots.iter().copied()) {
        let image = rebuild(graph, id, |operand| images.get(&operand).copied().unwrap_or(operand));
        let image = joined(graph, image);
        images.insert(id, image);
    }
    roots.iter().map(|root| images.get(root).copied().unwrap_or(*root)).collect()
}

fn joined(graph: &mut Graph, id: NodeId) -> NodeId {
    let Node::Sum { offset, terms } = graph.node(id).clone() else { return id };
    if terms.len() < 2 || terms.len() > MOST {
        return id;
    }
    for (index, &term) in terms.iter().enumerate() {
        for (other, &partner) in terms.iter().enumerate().skip(index + 1) {
            if let Some(merged) = merged(graph, term, partner) {
                let mut rest = terms.clone();
                rest.remove(other);
                rest[index] = merged;
                let sum = graph.sum(offset, &rest);
                return joined(graph, sum);
            }
        }
    }
    id
}

/// Two terms as one by an addition theorem.
fn merged(graph: &mut Graph, left: (NodeId, Number), right: (NodeId, Number)) -> Option<(NodeId, Number)> {
    if left.1.abs() != right.1.abs() {
        return None;
    }
    let Node::Product(factors) = graph.node(left.0).clone() else { return None };
    let waves: Vec<(usize, Unary, NodeId)> = factors
        .iter()
        .enumerate()
        .filter(|(_, (_, exponent))| *exponent == Exponent(2))
        .filter_map(|(index, (factor, _))| match *graph.node(*factor) {
            Node::Unary(function @ (Unary::Sin | Unary::Cos), angle) => Some((index, function, angle)),
            _ => None,
        })
        .collect();
    for (number, &(first, one, a)) in waves.iter().enumerate() {
        for &(second, two, b) in &waves[number + 1..] {
            let rest: Vec<(NodeId, Exponent)> = factors
                .iter()
                .enumerate()
                .filter(|&(index, _)| index != first && index != second)
                .map(|(_, &factor)| factor)
                .collect();
            let (of_a, of_b) = (graph.unary(other(one), a), graph.unary(other(two), b));
            let mut partner = rest.clone();
            partner.extend([(of_a, Exponent(2)), (of_b, Exponent(2))]);
            if graph.product(&partner) != right.0 {
                continue;
            }
            let same = left.1 == right.1;
            let (function, angle, scale) = match (one, two) {
                (Unary::Sin, Unary::Sin) => (Unary::Cos, combined(graph, a, b, !same), right.1),
                (Unary::Cos, Unary::Cos) => (Unary::Cos, combined(graph, a, b, !same), left.1),
                // In sin(a ± b), the term sin a cos b has no sign of its own.
                (Unary::Sin, _) => (Unary::Sin, combined(graph, a, b, same), left.1),
                _ => (Unary::Sin, combined(graph, b, a, same), left.1),
            };
            let wave = graph.unary(function, angle);
            // An odd function may have moved its sign outside.
            let mut product = rest;
            product.push((wave, Exponent(2)));
            return Some((graph.product(&product), scale));
        }
    }
    None
}

fn other(function: Unary) -> Unary {
    if function == Unary::Sin { Unary::Cos } else { Unary::Sin }
}

/// a + b or a − b.
fn combined(graph: &mut Graph, a: NodeId, b: NodeId, add: bool) -> NodeId {
    if add { graph.add(a, b) } else { graph.sub(a, b) }
}

/// Expressions in which equal terms of a printed sum are collected.
pub(super) fn collected(graph: &mut Graph, roots: &[NodeId]) -> Vec<NodeId> {
    let mut images: Lookup<NodeId, NodeId> = Lookup::default();
    for id in graph.cone(roots.iter().copied()) {
        let mut image = rebuild(graph, id, |operand| images.get(&operand).copied().unwrap_or(operand));
        if matches!(graph.node(image), Node::Sum { .. }) {
            let mut printed = Vec::new();
            printed_terms(graph, image, Number::ONE, &mut printed);
            let count = printed.len();
            let merged = merged_terms(printed);
            if merged.len() < count {
                image = graph.sum(Number::ZERO, &merged);
            }
        }
        images.insert(id, image);
    }
    roots.iter().map(|root| images.get(root).copied().unwrap_or(*root)).collect()
}

/// The summands of one side, equal ones collected.
pub(super) fn collected_side(graph: &mut Graph, side: &[NodeId]) -> Vec<NodeId> {
    let mut printed = Vec::new();
    for &node in side {
        printed_terms(graph, node, Number::ONE, &mut printed);
    }
    let count = printed.len();
    let merged = merged_terms(printed);
    if merged.len() == count {
        return side.to_vec();
    }
    merged.into_iter().map(|(term, coefficient)| graph.scale(term, coefficient)).collect()
}

/// The terms of a node that is written as a sum.
fn printed_terms(graph: &mut Graph, node: NodeId, coefficient: Number, printed: &mut Vec<(NodeId, Number)>) {
    match graph.node(node).clone() {
        Node::Sum { offset, terms } if coefficient.abs().is_one() => {
            for (term, own) in terms {
                printed_terms(graph, term, coefficient * own, printed);
            }
            if !offset.is_zero() {
                printed.push((graph.one(), coefficient * offset));
            }
        }
        _ => printed.push((node, coefficient)),
    }
}

/// Terms with equal ones added up, at the position of the first.
fn merged_terms(terms: Vec<(NodeId, Number)>) -> Vec<(NodeId, Number)> {
    let mut merged: Vec<(NodeId, Number)> = Vec::with_capacity(terms.len());
    for (term, coefficient) in terms {
        match merged.iter_mut().find(|(other, _)| *other == term) {
            Some((_, sum)) => *sum = *sum + coefficient,
            None => merged.push((term, coefficient)),
        }
    }
    merged.retain(|(_, coefficient)| !coefficient.is_zero());
    merged
}

/// The summands of an expression. A product with one sum among its factors is multiplied out, unless that is
/// a sum of parameters.
pub(super) fn summands(graph: &mut Graph, id: NodeId) -> Vec<NodeId> {
    match graph.node(id).clone() {
        Node::Sum { offset, terms } if terms.len() <= MOST && !graph.dependence(id).is_fixed() => {
            let mut parts = Vec::new();
            for (term, coefficient) in terms {
                for part in summands(graph, term) {
                    parts.push(graph.scale(part, coefficient));
                }
            }
            if !offset.is_zero() {
                parts.push(graph.constant(offset));
            }
            parts
        }
        Node::Product(factors) => {
            let is_open = |&(factor, exponent): &(NodeId, Exponent)| {
                exponent == Exponent(2)
                    && matches!(graph.node(factor), Node::Sum { terms, .. } if terms.len() <= MOST)
                    && !graph.dependence(factor).is_fixed()
            };
            let mut open = factors.iter().copied().filter(is_open);
            let (Some((sum, _)), None) = (open.next(), open.next()) else { return vec![id] };
            let rest: Vec<_> = factors.iter().copied().filter(|&(factor, _)| factor != sum).collect();
            let rest = graph.product(&rest);
            let parts = summands(graph, sum);
            parts.into_iter().map(|part| graph.mul(rest, part)).collect()
        }
        Node::Sum { .. } | Node::Constant(_) | Node::Variable(_) | Node::Unary(..) | Node::Binary(..) => {
            vec![id]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Variable;

    #[test]
    fn equal_summands_are_printed_once() {
        let mut g = Graph::new();
        let [b0, b1, b2] = [0, 1, 2].map(|i| g.variable(Variable::Parameter(i)));
        // (b₁ + b₀ − b₂) − (b₂ + (b₀ − b₁)), which the graph keeps as the user nested it.
        let first = g.add(b1, b0);
        let first = g.sub(first, b2);
        let second = g.sub(b0, b1);
        let second = g.add(b2, second);
        let whole = g.sub(first, second);
        let [sum] = collected(&mut g, &[whole])[..] else { panic!() };
        let two = Number::integer(2);
        assert_eq!(sum, g.sum(Number::ZERO, &[(b1, two), (b2, -two)]));
        let side = collected_side(&mut g, &[b0, first, b2]);
        let twice = g.scale(b0, two);
        assert_eq!(side, [twice, b1]);
        assert_eq!(collected_side(&mut g, &[b0, b1]), [b0, b1]);
    }
}
