//! The reference interpreter: what the emitted program is checked against.

use super::graph::{Graph, Node, NodeId, Variable};

impl Graph {
    /// The values of some nodes in doubles.
    pub fn evaluate(&self, roots: &[NodeId], variable: impl Fn(Variable) -> f64) -> Vec<f64> {
        let mut values = vec![f64::NAN; self.len()];
        for id in self.cone(roots.iter().copied()) {
            let value = |operand: &NodeId| values[operand.index()];
            values[id.index()] = match self.node(id) {
                Node::Constant(number) => number.value(),
                Node::Variable(v) => variable(*v),
                Node::Sum { offset, terms } => {
                    terms.iter().fold(offset.value(), |sum, (term, c)| sum + c.value() * value(term))
                }
                Node::Product(factors) => factors.iter().fold(1.0, |product, (factor, exponent)| {
                    product
                        * match exponent.as_integer() {
                            Some(power) => value(factor).powi(power),
                            None => value(factor).sqrt().powi(exponent.0),
                        }
                }),
                Node::Unary(function, argument) => function.evaluate(value(argument)),
                Node::Binary(function, first, second) => function.evaluate(value(first), value(second)),
            };
        }
        roots.iter().map(|root| values[root.index()]).collect()
    }
}
