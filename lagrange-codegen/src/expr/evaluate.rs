//! Values of nodes in doubles: for decisions at sample points, and for tests of emitted programs.

use super::graph::{Graph, Node, NodeId, Variable};
use super::op::Unary;

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

/// A value and a bound of its rounding error, to first order.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rounded {
    /// The value.
    pub value: f64,
    /// The bound of its rounding error.
    pub error: f64,
}

impl Rounded {
    /// A function of this value that rounds once. Its error follows from the ends of the value's bounds,
    /// without a derivative.
    fn through(self, f: impl Fn(f64) -> f64) -> Rounded {
        let value = f(self.value);
        let change = |x: f64| (f(x) - value).abs();
        let error = if self.error == 0.0 {
            0.0
        } else {
            change(self.value + self.error).max(change(self.value - self.error))
        };
        Rounded { value, error: error + f64::EPSILON * value.abs() }
    }

    fn times(self, other: Rounded) -> Rounded {
        let value = self.value * other.value;
        let error = self.value.abs() * other.error + other.value.abs() * self.error;
        Rounded { value, error: error + f64::EPSILON * value.abs() }
    }
}

impl Graph {
    /// The values of some nodes with their rounding errors, with each function that has a kink continued from
    /// one side of it: `side` tells for each argument whether it counts as positive. What holds on all sides
    /// holds at any kink.
    pub fn evaluate_on_sides(
        &self,
        roots: &[NodeId],
        variable: impl Fn(Variable) -> f64,
        side: impl Fn(NodeId) -> bool,
    ) -> Vec<Rounded> {
        let mut values = vec![Rounded::default(); self.len()];
        for id in self.cone(roots.iter().copied()) {
            let value = |operand: &NodeId| values[operand.index()];
            let exact = |value: f64| Rounded { value, error: 0.0 };
            values[id.index()] = match self.node(id) {
                Node::Constant(number) => exact(number.value()).through(|x| x),
                Node::Variable(v) => exact(variable(*v)),
                Node::Sum { offset, terms } => {
                    let mut sum = exact(offset.value());
                    sum.error = f64::EPSILON * sum.value.abs();
                    for (term, coefficient) in terms {
                        let term = value(term).times(exact(coefficient.value()));
                        sum.value += term.value;
                        sum.error += term.error + f64::EPSILON * term.value.abs();
                    }
                    sum
                }
                Node::Product(factors) => factors.iter().fold(exact(1.0), |product, (factor, exponent)| {
                    product.times(value(factor).through(|x| match exponent.as_integer() {
                        Some(power) => x.powi(power),
                        None => x.sqrt().powi(exponent.0),
                    }))
                }),
                Node::Unary(function, argument) => {
                    let sign = if side(*argument) { 1.0 } else { -1.0 };
                    match function {
                        Unary::Abs => value(argument).through(|x| sign * x),
                        Unary::Signum => exact(sign),
                        Unary::Step => exact(if sign > 0.0 { 1.0 } else { 0.0 }),
                        Unary::Below => exact(if sign > 0.0 { 0.0 } else { 1.0 }),
                        Unary::PositivePart => value(argument).through(|x| if sign > 0.0 { x } else { 0.0 }),
                        Unary::Sin
                        | Unary::Cos
                        | Unary::Tan
                        | Unary::Asin
                        | Unary::Acos
                        | Unary::Atan
                        | Unary::Sinh
                        | Unary::Cosh
                        | Unary::Tanh
                        | Unary::Sech
                        | Unary::Logistic
                        | Unary::Asinh
                        | Unary::Acosh
                        | Unary::Atanh
                        | Unary::Exp
                        | Unary::ExpM1
                        | Unary::Ln
                        | Unary::Ln1p
                        | Unary::Cbrt => value(argument).through(|x| function.evaluate(x)),
                    }
                }
                Node::Binary(function, first, second) => {
                    let (first, second) = (value(first), value(second));
                    let by_first = first.through(|x| function.evaluate(x, second.value));
                    let by_second = second.through(|y| function.evaluate(first.value, y));
                    Rounded { value: by_first.value, error: by_first.error + by_second.error }
                }
            };
        }
        roots.iter().map(|root| values[root.index()]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roundings_are_bounded_and_kinks_have_two_sides() {
        let mut g = Graph::new();
        let x = g.variable(Variable::Coordinate(0));
        let (sin, cos) = (g.unary(Unary::Sin, x), g.unary(Unary::Cos, x));
        let double = g.scale(x, crate::number::Number::integer(2));
        let (product, double) = (g.mul(sin, cos), g.unary(Unary::Sin, double));
        let zero = g.sum(
            crate::number::Number::ZERO,
            &[(product, crate::number::Number::integer(2)), (double, crate::number::Number::MINUS_ONE)],
        );
        for x in [0.3, 1.5, 7.0] {
            let [Rounded { value, error }] = g.evaluate_on_sides(&[zero], |_| x, |_| true)[..] else {
                panic!()
            };
            assert!(value.abs() <= error && error < 1e-14, "{value} ± {error}");
        }
        let (size, part) = (g.unary(Unary::Abs, x), g.unary(Unary::PositivePart, x));
        let on = |side| g.evaluate_on_sides(&[size, part], |_| -2.0, |_| side);
        assert_eq!([on(true)[0].value, on(true)[1].value], [-2.0, -2.0]);
        assert_eq!([on(false)[0].value, on(false)[1].value], [2.0, 0.0]);
    }
}
