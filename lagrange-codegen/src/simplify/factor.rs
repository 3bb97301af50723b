//! Taking a factor out of those terms of a sum that share it: `x + xy + z → x(1 + y) + z`.

use super::cost::cost;
use super::image_of;
use crate::calculus::rebuild;
use crate::expr::{Exponent, Graph, Node, NodeId};
use crate::number::Number;

/// The most terms of a sum that is factored, since the search is quadratic in them.
const MOST_TERMS: usize = 64;

/// The most terms of a sum that is factored in several ways, of which the cheapest is kept.
const FEW_TERMS: usize = 8;

/// The number of these ways.
const TRIES: usize = 4;

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

/// The sum with factors of partial sums taken out. The first factor decides what remains for the others, so
/// the most promising ones are tried in turn.
fn factor_sum(graph: &mut Graph, id: NodeId) -> NodeId {
    let Node::Sum { offset, terms } = graph.node(id).clone() else { return id };
    if terms.len() < 2 || terms.len() > MOST_TERMS {
        return id;
    }
    let candidates = shared_factors(graph, &terms);
    let tries = if terms.len() <= FEW_TERMS { TRIES } else { 1 };
    let mut best: Option<(u32, NodeId)> = None;
    for (common, exponent) in candidates.into_iter().take(tries) {
        let factored = take_out(graph, offset, &terms, common, exponent);
        let cost = cost(graph, &[factored]);
        if best.is_none_or(|(lowest, _)| cost < lowest) {
            best = Some((cost, factored));
        }
    }
    best.map_or(id, |(_, factored)| factored)
}

/// The sum with one factor taken out of the terms that have it, and further ones out of the rest.
fn take_out(
    graph: &mut Graph,
    offset: Number,
    terms: &[(NodeId, Number)],
    common: NodeId,
    exponent: Exponent,
) -> NodeId {
    let (mut inside, mut outside) = (Vec::new(), Vec::new());
    for &(term, coefficient) in terms {
        if power_in(graph, term, common).is_some_and(|power| reaches(power, exponent)) {
            let rest = graph.without(term, &[(common, exponent)]);
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

/// The factors that at least two terms share, with the smallest of their powers: the most frequent
/// first, moving ones before fixed ones.
fn shared_factors(graph: &Graph, terms: &[(NodeId, Number)]) -> Vec<(NodeId, Exponent)> {
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
    candidates.retain(|&(_, _, count)| count >= 2);
    candidates
        .sort_by_key(|&(node, _, count)| (std::cmp::Reverse(count), graph.dependence(node).is_fixed(), node));
    candidates.into_iter().map(|(node, exponent, _)| (node, exponent)).collect()
}

fn power_in(graph: &Graph, term: NodeId, factor: NodeId) -> Option<Exponent> {
    match graph.node(term) {
        Node::Product(factors) => factors.iter().find(|&&(node, _)| node == factor).map(|&(_, e)| e),
        _ => (term == factor).then_some(Exponent(2)),
    }
}
