//! Expressions as polynomials in the parameters. No parameter appears in a coefficient.

use std::collections::BTreeMap;

use crate::expr::{Dependence, Exponent, Graph, Node, NodeId};
use crate::number::Number;

/// Coefficient by monomial; both are nodes. A factor of parameters alone that is no power of one counts as a
/// parameter.
pub(super) type Polynomial = BTreeMap<NodeId, NodeId>;

/// The most monomials of an expression. Longer ones are not taken apart.
const MOST: usize = 96;

/// Writes an expression as a polynomial; `None` if it is none, or one with too many terms.
pub(super) fn polynomial(graph: &mut Graph, root: NodeId) -> Option<Polynomial> {
    let mut images: BTreeMap<NodeId, Polynomial> = BTreeMap::new();
    for id in graph.cone([root]) {
        // A function of parameters and variables has no image, nor has any node above it.
        if let Some(image) = of_node(graph, id, &images)
            && image.len() <= MOST
        {
            images.insert(id, image);
        }
    }
    images.remove(&root)
}

fn of_node(graph: &mut Graph, id: NodeId, images: &BTreeMap<NodeId, Polynomial>) -> Option<Polynomial> {
    let one = graph.one();
    let dependence = graph.dependence(id);
    if !dependence.meets(Dependence::PARAMETERS) {
        return Some(BTreeMap::from([(one, id)]));
    }
    match graph.node(id).clone() {
        Node::Sum { offset, terms } => {
            let mut sum: BTreeMap<NodeId, Vec<(NodeId, Number)>> = BTreeMap::new();
            if !offset.is_zero() {
                sum.entry(one).or_default().push((one, offset));
            }
            for (term, scale) in terms {
                for (&monomial, &coefficient) in images.get(&term)? {
                    sum.entry(monomial).or_default().push((coefficient, scale));
                }
            }
            Some(collected(graph, sum))
        }
        Node::Product(factors) => {
            let mut product = BTreeMap::from([(one, one)]);
            for (factor, exponent) in factors {
                let factor = power(graph, factor, exponent, images)?;
                product = times(graph, &product, &factor)?;
            }
            Some(product)
        }
        Node::Constant(_) | Node::Variable(_) | Node::Unary(..) | Node::Binary(..) => {
            dependence.is_fixed().then(|| BTreeMap::from([(id, one)]))
        }
    }
}

fn power(
    graph: &mut Graph,
    base: NodeId,
    exponent: Exponent,
    images: &BTreeMap<NodeId, Polynomial>,
) -> Option<Polynomial> {
    let image = images.get(&base)?;
    if image.len() == 1 {
        let (&monomial, &coefficient) = image.first_key_value()?;
        let monomial = graph.product(&[(monomial, exponent)]);
        return Some(BTreeMap::from([(monomial, graph.product(&[(coefficient, exponent)]))]));
    }
    match exponent.as_integer() {
        Some(whole @ 1..) => {
            let mut product = image.clone();
            for _ in 1..whole {
                product = times(graph, &product, image)?;
            }
            Some(product)
        }
        _ if graph.dependence(base).is_fixed() => {
            let one = graph.one();
            Some(BTreeMap::from([(graph.product(&[(base, exponent)]), one)]))
        }
        _ => None,
    }
}

fn times(graph: &mut Graph, left: &Polynomial, right: &Polynomial) -> Option<Polynomial> {
    let mut product: BTreeMap<NodeId, Vec<(NodeId, Number)>> = BTreeMap::new();
    for (&a, &by_a) in left {
        for (&b, &by_b) in right {
            let monomial = graph.mul(a, b);
            let coefficient = graph.mul(by_a, by_b);
            product.entry(monomial).or_default().push((coefficient, Number::ONE));
        }
    }
    (product.len() <= MOST).then(|| collected(graph, product))
}

fn collected(graph: &mut Graph, terms: BTreeMap<NodeId, Vec<(NodeId, Number)>>) -> Polynomial {
    let summed = terms.into_iter().map(|(monomial, terms)| (monomial, graph.sum(Number::ZERO, &terms)));
    let summed: Vec<_> = summed.collect();
    summed.into_iter().filter(|&(_, coefficient)| !graph.is_zero(coefficient)).collect()
}
