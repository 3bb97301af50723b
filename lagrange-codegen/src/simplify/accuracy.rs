//! Whether a rewriting keeps the digits: a running error analysis at a few fixed points.
//!
//! Multiplied out, (a − b)² is a sum whose terms cancel where a is near b, and no way to evaluate it is as
//! accurate as the square. Every value is computed with the rounding errors that it gathers (Higham,
//! "Accuracy and Stability of Numerical Algorithms", 2nd ed., section 3.3). Variables and functions, which
//! rewriting does not touch, count as exact up to one rounding error. Near a cancellation the loss of digits
//! is unbounded, but it shows at ordinary points too.

use crate::expr::{Graph, Node, NodeId, Variable};

const POINTS: u32 = 8;

/// The largest acceptable growth of the rounding errors by a rewriting.
const MOST_LOSS: f64 = 4.0;

/// Whether `after`, which equals `before`, gathers about as few rounding errors.
pub(super) fn keeps_digits(graph: &Graph, before: NodeId, after: NodeId) -> bool {
    let ratio = |point| {
        let [old, new] = roundings(graph, [before, after], point);
        new / old
    };
    let ratios: Vec<f64> = (0..POINTS).map(ratio).filter(|ratio| ratio.is_finite()).collect();
    !ratios.is_empty() && ratios.iter().all(|&ratio| ratio <= MOST_LOSS)
}

/// The rounding errors of two nodes at a point, in units of ε.
fn roundings(graph: &Graph, roots: [NodeId; 2], point: u32) -> [f64; 2] {
    let cone = graph.cone(roots);
    let values = graph.evaluate(&cone, |variable| sample(variable, point));
    let mut gathered: Vec<f64> = Vec::with_capacity(cone.len());
    let at = |id: NodeId| cone.binary_search(&id).expect("accuracy: an operand outside the cone");
    for (&id, &value) in cone.iter().zip(&values) {
        let own = value.abs();
        let carried: f64 = match graph.node(id) {
            Node::Constant(_) | Node::Variable(_) | Node::Unary(..) | Node::Binary(..) => 0.0,
            Node::Sum { terms, .. } => {
                terms.iter().map(|&(term, c)| c.value().abs() * gathered[at(term)]).sum()
            }
            Node::Product(factors) => {
                let relative = |&(factor, exponent): &(NodeId, crate::expr::Exponent)| {
                    let i = at(factor);
                    f64::from(exponent.0).abs() / 2.0 * gathered[i] / values[i].abs()
                };
                own * factors.iter().map(relative).sum::<f64>()
            }
        };
        gathered.push(own + carried);
    }
    roots.map(|root| gathered[at(root)])
}

/// The value of a variable: for parameters between 0.3 and 1.7, for others between −1.5 and 1.5.
fn sample(variable: Variable, point: u32) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let (kind, index) = match variable {
        Variable::Coordinate(index) => (1, index),
        Variable::Velocity(index) => (2, index),
        Variable::Time => (3, 0),
        Variable::Input(index) => (4, index),
        Variable::Auxiliary(index) => (5, index),
        Variable::Acceleration(index) => (6, index),
        Variable::Multiplier(index) => (7, index),
        Variable::Position(index) => (8, index),
        Variable::Entry(index) => (9, index),
        Variable::Parameter(index) => {
            return 0.3 + 1.4 * (GOLDEN * f64::from(7 * index + 3 * point + 1)).fract();
        }
    };
    3.0 * (GOLDEN * f64::from(11 * index + 5 * point + kind)).fract() - 1.5
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Number;

    #[test]
    fn squares_of_differences_lose_digits_when_multiplied_out() {
        let mut g = Graph::new();
        let (x, y) = (g.variable(Variable::Coordinate(0)), g.variable(Variable::Coordinate(1)));
        let difference = g.sub(x, y);
        let square = g.powi(difference, 2);
        let (xx, xy, yy) = (g.powi(x, 2), g.mul(x, y), g.powi(y, 2));
        let terms = [(xx, Number::ONE), (xy, Number::integer(-2)), (yy, Number::ONE)];
        let sum = g.sum(Number::ZERO, &terms);
        assert!(!keeps_digits(&g, square, sum));
        assert!(keeps_digits(&g, sum, square));
    }
}
