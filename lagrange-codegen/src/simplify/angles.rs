//! Sines and cosines of sums of angles whose own sines and cosines are needed anyway.
//!
//! cos(a − b) = cos a cos b + sin a sin b costs three operations, and a further call costs tens. The error is
//! of the order of a rounding error of the angles themselves.

use crate::calculus::substitute;
use crate::collections::Lookup;
use crate::expr::{Graph, Node, NodeId, Unary};
use crate::number::Number;

/// The roots with every sine or cosine of `±a ± b` replaced if those of a and b are at hand.
pub(super) fn add_angles(graph: &mut Graph, roots: &[NodeId]) -> Vec<NodeId> {
    let mut arguments = Vec::new();
    let mut present: Lookup<NodeId, ()> = Lookup::default();
    for id in graph.cone(roots.iter().copied()) {
        if let Node::Unary(Unary::Sin | Unary::Cos, argument) = *graph.node(id)
            && present.insert(argument, ()).is_none()
        {
            arguments.push(argument);
        }
    }
    let mut replacements = Vec::new();
    for &argument in &arguments {
        let Some([(a, sign_a), (b, sign_b)]) = pair(graph, argument) else { continue };
        if !present.contains(&a) || !present.contains(&b) {
            continue;
        }
        let (sin_a, cos_a) = (graph.unary(Unary::Sin, a), graph.unary(Unary::Cos, a));
        let (sin_b, cos_b) = (graph.unary(Unary::Sin, b), graph.unary(Unary::Cos, b));
        let (first, second) = (graph.mul(sin_a, cos_b), graph.mul(cos_a, sin_b));
        let sine = graph.sum(Number::ZERO, &[(first, sign_a), (second, sign_b)]);
        let (first, second) = (graph.mul(cos_a, cos_b), graph.mul(sin_a, sin_b));
        let cosine = graph.sum(Number::ZERO, &[(first, Number::ONE), (second, -(sign_a * sign_b))]);
        replacements.push((graph.unary(Unary::Sin, argument), sine));
        replacements.push((graph.unary(Unary::Cos, argument), cosine));
    }
    if replacements.is_empty() {
        return roots.to_vec();
    }
    // A sum may be part of a longer one, in whose replacement it then appears, so the images are replaced,
    // too.
    let mut current = roots.to_vec();
    for _ in 0..replacements.len() {
        let next = substitute(graph, &current, &replacements);
        if next == current {
            break;
        }
        current = next;
    }
    current
}

/// The two angles of `±a ± b`.
fn pair(graph: &Graph, argument: NodeId) -> Option<[(NodeId, Number); 2]> {
    match graph.node(argument) {
        Node::Sum { offset, terms } if offset.is_zero() && terms.len() == 2 => {
            let [a, b] = [terms[0], terms[1]];
            (a.1.abs().is_one() && b.1.abs().is_one()).then_some([a, b])
        }
        _ => None,
    }
}
