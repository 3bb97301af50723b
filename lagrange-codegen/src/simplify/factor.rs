//! Taking a factor out of those terms of a sum that share it: `x + xy + z → x(1 + y) + z`.

use super::image_of;
use crate::calculus::rebuild;
use crate::expr::{Exponent, Graph, Node, NodeId};
use crate::number::Number;

/// Sums beyond this many terms are left alone: the search is quadratic in them.
const MOST_TERMS: usize = 64;

/// The roots with the factors of partial sums taken out, the most frequent first.
pub(super) fn factor(graph: &mut Graph, roots: &[NodeId]) -> Vec<NodeId> {
    let cone = graph.cone(roots.iter().copied());
    let mut images: Vec<NodeId> = Vec::with_capacity(cone.len());
    for &id in &cone {
        let rebuilt = rebuild(graph, id, |operand| image_of(&cone, &images, operand));
        let image = factor_sum(graph, rebuilt);
        images.push(image);
    }
    roots.iter().map(|root| image_of(&cone, &images, *root)).collect()
}

fn factor_sum(graph: &mut Graph, id: NodeId) -> NodeId {
    let Node::Sum { offset, terms } = graph.node(id).clone() else { return id };
    if terms.len() < 2 || terms.len() > MOST_TERMS {
        return id;
    }
    let Some((common, exponent)) = most_frequent_factor(graph, &terms) else { return id };
    let (mut inside, mut outside) = (Vec::new(), Vec::new());
    for &(term, coefficient) in &terms {
        if power_in(graph, term, common).is_some_and(|power| reaches(power, exponent)) {
            let rest = graph.product(&[(term, Exponent(2)), (common, Exponent(-exponent.0))]);
            inside.push((rest, coefficient));
        } else {
            outside.push((term, coefficient));
        }
    }
    let inside = graph.sum(Number::ZERO, &inside);
    let inside = factor_sum(graph, inside);
    let product = graph.product(&[(common, exponent), (inside, Exponent(2))]);
    let remaining = graph.sum(offset, &outside);
    let remaining = factor_sum(graph, remaining);
    graph.sum(Number::ZERO, &[(product, Number::ONE), (remaining, Number::ONE)])
}

/// Whether a power contains the one that is taken out.
fn reaches(power: Exponent, exponent: Exponent) -> bool {
    power.0.signum() == exponent.0.signum() && power.0.abs() >= exponent.0.abs()
}

/// The factor that most terms share (moving ones before fixed ones), with the smallest of
/// its powers, if any is shared.
fn most_frequent_factor(graph: &Graph, terms: &[(NodeId, Number)]) -> Option<(NodeId, Exponent)> {
    let mut candidates: Vec<(NodeId, Exponent, usize)> = Vec::new();
    for &(term, _) in terms {
        for (factor, exponent) in graph.factors(term) {
            let known = candidates
                .iter_mut()
                .find(|(node, shared, _)| *node == factor && shared.0.signum() == exponent.0.signum());
            match known {
                Some((_, shared, count)) => {
                    if exponent.0.abs() < shared.0.abs() {
                        *shared = exponent;
                    }
                    *count += 1;
                }
                None => candidates.push((factor, exponent, 1)),
            }
        }
    }
    candidates
        .into_iter()
        .filter(|&(_, _, count)| count >= 2)
        .max_by_key(|&(node, _, count)| (count, !graph.dependence(node).is_fixed(), std::cmp::Reverse(node)))
        .map(|(node, exponent, _)| (node, exponent))
}

fn power_in(graph: &Graph, term: NodeId, factor: NodeId) -> Option<Exponent> {
    match graph.node(term) {
        Node::Product(factors) => factors.iter().find(|&&(node, _)| node == factor).map(|&(_, e)| e),
        _ => (term == factor).then_some(Exponent(2)),
    }
}
