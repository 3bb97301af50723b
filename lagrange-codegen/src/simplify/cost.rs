//! The cost of evaluating a set of roots, in additions.
//!
//! Parts that depend on parameters alone are free, since they are computed once per run.

use crate::expr::{Binary, Exponent, Graph, Node, NodeId, Unary};

/// Weights measured on x86-64 (throughput of independent operations, rounded).
const DIVISION: u32 = 4;
const SQUARE_ROOT: u32 = 5;
const HALF_OF_SINE_AND_COSINE: u32 = 12;
const FUNCTION: u32 = 20;

/// The cost of all nodes below the roots, shared ones once.
pub fn cost(graph: &Graph, roots: &[NodeId]) -> u32 {
    graph.cone(roots.iter().copied()).into_iter().map(|id| node_cost(graph, id)).sum()
}

fn node_cost(graph: &Graph, id: NodeId) -> u32 {
    if graph.dependence(id).is_fixed() {
        return 0;
    }
    match graph.node(id) {
        Node::Constant(_) | Node::Variable(_) => 0,
        Node::Sum { offset, terms } => {
            let fixed = terms.iter().filter(|&&(term, _)| graph.dependence(term).is_fixed()).count();
            let moving = terms.len() - fixed;
            let additions = moving - 1 + usize::from(fixed > 0 || !offset.is_zero());
            let scalings = terms
                .iter()
                .filter(|&&(term, c)| {
                    !c.abs().is_one() && !graph.dependence(term).is_fixed() && !absorbs(graph, term)
                })
                .count();
            (additions + scalings) as u32
        }
        Node::Product(factors) => {
            let fixed = factors.iter().any(|&(factor, _)| graph.dependence(factor).is_fixed());
            let (mut above, mut below, mut roots) = (u32::from(fixed), 0, 0);
            for &(factor, exponent) in factors {
                if graph.dependence(factor).is_fixed() {
                    continue;
                }
                let (multiplications, root) = power_cost(exponent);
                roots += root;
                *(if exponent.0 > 0 { &mut above } else { &mut below }) += multiplications;
            }
            let division = if below > 0 { DIVISION } else { 0 };
            (above + below).saturating_sub(1) + division + roots * SQUARE_ROOT
        }
        Node::Unary(Unary::Sin | Unary::Cos, _) => HALF_OF_SINE_AND_COSINE,
        Node::Unary(Unary::Abs | Unary::Signum | Unary::PositivePart | Unary::Step | Unary::Below, _) => 1,
        Node::Binary(Binary::Pivot, ..) => 2,
        Node::Unary(..) | Node::Binary(..) => FUNCTION,
    }
}

/// Whether a coefficient of the term costs nothing because it joins a fixed factor.
fn absorbs(graph: &Graph, term: NodeId) -> bool {
    matches!(graph.node(term), Node::Product(factors) if factors.iter().any(|&(f, _)| graph.dependence(f).is_fixed()))
}

/// Factors that a power contributes to its product, and square roots.
fn power_cost(exponent: Exponent) -> (u32, u32) {
    let halves = exponent.0.unsigned_abs();
    let (whole, root) = (halves / 2, halves % 2);
    let squarings = if whole > 0 { whole.ilog2() + whole.count_ones() } else { 0 };
    (squarings + root, root)
}
