//! The sizes of the terms that a value is made of: the bound of a running error analysis (N. J. Higham,
//! Accuracy and Stability of Numerical Algorithms, 2002, section 3.3), in units of rounding and to first
//! order.

use super::local;
use crate::collections::Lookup;
use crate::expr::{Exponent, Graph, Node, NodeId, Unary};
use crate::number::Number;

/// For each node, a bound of its rounding error in units of ε: the sum of the sizes of all summands that it
/// is made of, each times the condition numbers of the functions through which it has passed.
pub fn sizes(graph: &mut Graph, nodes: &[NodeId]) -> Vec<NodeId> {
    let mut known: Lookup<NodeId, NodeId> = Lookup::default();
    for id in graph.cone(nodes.iter().copied()) {
        let size = size(graph, id, &|operand| known.get(&operand).copied().unwrap_or(operand));
        known.insert(id, size);
    }
    nodes.iter().map(|node| known.get(node).copied().unwrap_or(*node)).collect()
}

fn size(graph: &mut Graph, id: NodeId, of: &dyn Fn(NodeId) -> NodeId) -> NodeId {
    match graph.node(id).clone() {
        Node::Constant(value) => graph.constant(value.abs()),
        Node::Variable(_) => graph.unary(Unary::Abs, id),
        Node::Sum { offset, terms } => {
            let terms: Vec<(NodeId, Number)> =
                terms.iter().map(|&(term, coefficient)| (of(term), coefficient.abs())).collect();
            graph.sum(offset.abs(), &terms)
        }
        // A size is at least the value. So powers of the size bound those of the value and, up to a factor,
        // their condition numbers.
        Node::Product(factors) => {
            let mut sizes = Vec::with_capacity(factors.len());
            for (factor, exponent) in factors {
                if exponent.0 > 0 {
                    sizes.push((of(factor), exponent));
                } else {
                    let magnitude = graph.unary(Unary::Abs, factor);
                    sizes.push((magnitude, Exponent(exponent.0 - 2)));
                    sizes.push((of(factor), Exponent::whole(1)));
                }
            }
            graph.product(&sizes)
        }
        Node::Unary(function, argument) => {
            let slope = local::unary(graph, function, argument, id);
            passed(graph, id, &[(slope, of(argument))])
        }
        Node::Binary(function, first, second) => {
            let (by_first, by_second) = local::binary(graph, function, first, second);
            passed(graph, id, &[(by_first, of(first)), (by_second, of(second))])
        }
    }
}

/// |f| + Σ |∂f/∂x| size(x).
fn passed(graph: &mut Graph, value: NodeId, arguments: &[(NodeId, NodeId)]) -> NodeId {
    let mut terms = vec![(graph.unary(Unary::Abs, value), Number::ONE)];
    for &(slope, size) in arguments {
        let slope = graph.unary(Unary::Abs, slope);
        terms.push((graph.mul(slope, size), Number::ONE));
    }
    graph.sum(Number::ZERO, &terms)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Variable;

    #[test]
    fn cancelled_terms_count() {
        let mut graph = Graph::default();
        let x = graph.variable(Variable::Coordinate(0));
        let cosine = graph.unary(Unary::Cos, x);
        let rise = graph.sum(Number::ONE, &[(cosine, Number::MINUS_ONE)]);
        let [size] = sizes(&mut graph, &[rise])[..] else { panic!("one size") };
        let value = graph.evaluate(&[size], |_| 1e-9)[0];
        assert!((value - 2.0).abs() < 1e-9, "{value}");
        let inverse = graph.powi(rise, -1);
        let [size] = sizes(&mut graph, &[inverse])[..] else { panic!("one size") };
        let (of_rise, value) =
            (1.0 + 0.1_f64.cos() + 0.1 * 0.1_f64.sin(), graph.evaluate(&[size], |_| 0.1)[0]);
        let expected = of_rise / (1.0 - 0.1_f64.cos()).powi(2);
        assert!((value / expected - 1.0).abs() < 1e-9, "{value} {expected}");
    }
}
