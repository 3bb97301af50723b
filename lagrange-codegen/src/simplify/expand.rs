//! Multiplying out where terms then cancel.
//!
//! `c₀(A s₀ + B s₁) − s₀(A c₀ + B c₁)` becomes `B(c₀ s₁ − s₀ c₁)`. A node is replaced only by something
//! cheaper. Multiplying out alone makes nothing cheaper, so terms must have cancelled or merged. The
//! replacement must keep the digits as well: the terms of (a − b)², multiplied out, cancel near a = b.

use super::accuracy::keeps_digits;
use super::cost::cost;
use super::{factor, image_of};
use crate::calculus::rebuild;
use crate::expr::{Dependence, Exponent, Graph, Node, NodeId};
use crate::number::Number;

/// The most monomials of an expansion that is tried.
const MOST_MONOMIALS: u32 = 48;

/// The roots with every sum and product that gets cheaper multiplied out.
pub(super) fn expand(graph: &mut Graph, roots: &[NodeId]) -> Vec<NodeId> {
    let cone = graph.cone(roots.iter().copied());
    let mut images: Vec<NodeId> = Vec::with_capacity(cone.len());
    for &id in &cone {
        let rebuilt = rebuild(graph, id, |operand| image_of(&cone, &images, operand));
        let image = cheaper(graph, rebuilt);
        images.push(image);
    }
    roots.iter().map(|root| image_of(&cone, &images, *root)).collect()
}

/// The node itself, or its expansion if that is cheaper and as accurate.
fn cheaper(graph: &mut Graph, id: NodeId) -> NodeId {
    if !is_nested(graph, id) || monomials(graph, id, 0) > MOST_MONOMIALS {
        return id;
    }
    let mut polynomial = Polynomial { offset: Number::ZERO, terms: Vec::new() };
    collect(graph, id, Number::ONE, &[], &mut polynomial);
    let terms: Vec<(NodeId, Number)> = polynomial.terms;
    let flat = graph.sum(polynomial.offset, &terms);
    let candidate = factor::factor(graph, &[flat])[0];
    let cheaper = cost(graph, &[candidate]) < cost(graph, &[id]);
    if cheaper && keeps_digits(graph, id, candidate) { candidate } else { id }
}

/// Whether a node that moves with coordinates is a product with a sum that opens, or a sum of which a term is
/// such a product or a sum.
fn is_nested(graph: &Graph, id: NodeId) -> bool {
    if graph.dependence(id).is_fixed() || !graph.dependence(id).meets(Dependence::COORDINATES) {
        return false;
    }
    let has_sum = |factors: &[(NodeId, Exponent)]| factors.iter().any(|&(f, e)| opens(graph, f, e));
    match graph.node(id) {
        Node::Product(factors) => has_sum(factors),
        Node::Sum { terms, .. } => terms.iter().any(|&(term, _)| match graph.node(term) {
            Node::Product(factors) => has_sum(factors),
            Node::Sum { .. } => true,
            _ => false,
        }),
        _ => false,
    }
}

/// Whether a factor is a sum to a power that can be multiplied out.
fn opens(graph: &Graph, factor: NodeId, exponent: Exponent) -> bool {
    matches!(exponent.0, 2 | 4)
        && matches!(graph.node(factor), Node::Sum { .. })
        && !graph.dependence(factor).is_fixed()
}

/// The number of monomials, saturating above the limit.
fn monomials(graph: &Graph, id: NodeId, depth: u32) -> u32 {
    if depth > 8 {
        return MOST_MONOMIALS + 1;
    }
    let capped = |count: u32| count.min(MOST_MONOMIALS + 1);
    match graph.node(id) {
        Node::Sum { offset, terms } if !graph.dependence(id).is_fixed() => {
            let start = u32::from(!offset.is_zero());
            let mut sum = start;
            for &(term, _) in terms {
                sum = capped(sum + monomials(graph, term, depth + 1));
                if sum > MOST_MONOMIALS {
                    break;
                }
            }
            sum
        }
        Node::Product(factors) => {
            factors.iter().filter(|&&(f, e)| opens(graph, f, e)).fold(1, |product, &(f, e)| {
                let count = monomials(graph, f, depth + 1);
                capped(product * if e.0 == 4 { count * count } else { count })
            })
        }
        _ => 1,
    }
}

struct Polynomial {
    offset: Number,
    terms: Vec<(NodeId, Number)>,
}

/// Adds `coefficient · Π factors · id`, multiplied out.
fn collect(
    graph: &mut Graph,
    id: NodeId,
    coefficient: Number,
    factors: &[(NodeId, Exponent)],
    polynomial: &mut Polynomial,
) {
    let fixed = graph.dependence(id).is_fixed();
    match graph.node(id).clone() {
        Node::Sum { offset, terms } if !fixed => {
            if !offset.is_zero() {
                finish(graph, coefficient * offset, factors, polynomial);
            }
            for (term, c) in terms {
                collect(graph, term, coefficient * c, factors, polynomial);
            }
        }
        Node::Product(own) => {
            let mut closed = factors.to_vec();
            let mut open = Vec::new();
            for (factor, exponent) in own {
                if opens(graph, factor, exponent) {
                    open.extend(std::iter::repeat_n(factor, exponent.0 as usize / 2));
                } else {
                    closed.push((factor, exponent));
                }
            }
            multiply(graph, &open, coefficient, &closed, polynomial);
        }
        _ => {
            let mut all = factors.to_vec();
            all.push((id, Exponent(2)));
            finish(graph, coefficient, &all, polynomial);
        }
    }
}

/// Adds `coefficient · Π factors · Π open`, the open factors being sums.
fn multiply(
    graph: &mut Graph,
    open: &[NodeId],
    coefficient: Number,
    factors: &[(NodeId, Exponent)],
    polynomial: &mut Polynomial,
) {
    let Some((&first, rest)) = open.split_first() else {
        finish(graph, coefficient, factors, polynomial);
        return;
    };
    let mut inner = Polynomial { offset: Number::ZERO, terms: Vec::new() };
    collect(graph, first, Number::ONE, &[], &mut inner);
    if !inner.offset.is_zero() {
        multiply(graph, rest, coefficient * inner.offset, factors, polynomial);
    }
    for (term, c) in inner.terms {
        let mut all = factors.to_vec();
        all.push((term, Exponent(2)));
        multiply(graph, rest, coefficient * c, &all, polynomial);
    }
}

fn finish(
    graph: &mut Graph,
    coefficient: Number,
    factors: &[(NodeId, Exponent)],
    polynomial: &mut Polynomial,
) {
    let product = graph.product(factors);
    match graph.as_constant(product) {
        Some(value) => polynomial.offset = polynomial.offset + coefficient * value,
        None => polynomial.terms.push((product, coefficient)),
    }
}
