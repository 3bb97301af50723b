//! From the graph to formulas as a textbook has them.

use super::formula::{Application, Formula, Strength};
use super::symbols::{self, Symbol};
use crate::collections::Lookup;
use crate::expr::{Binary, Exponent, Node, NodeId, Unary, Variable};
use crate::model::Model;
use crate::number::Number;

/// Makes formulas of a model's expressions. Intermediate results stand in them by name.
pub(super) struct Writer<'a> {
    pub model: &'a Model,
    /// Names of intermediate results.
    pub names: Lookup<NodeId, Symbol>,
}

impl Writer<'_> {
    /// An expression.
    pub fn expression(&self, node: NodeId) -> Formula {
        match self.names.get(&node) {
            Some(name) => Formula::Symbol(name.clone()),
            None => self.definition(node),
        }
    }

    /// An expression without its own name: the right-hand side of its definition.
    pub fn definition(&self, node: NodeId) -> Formula {
        match self.model.graph.node(node) {
            Node::Constant(value) if value.is_negative() => {
                Formula::Sum(vec![(true, Formula::Number(value.abs()))])
            }
            Node::Constant(value) => Formula::Number(*value),
            Node::Variable(variable) => Formula::Symbol(self.variable(*variable)),
            Node::Sum { .. } => Formula::sum(self.opened(node, false)),
            Node::Product(factors) => self.fraction(factors),
            Node::Unary(function, argument) => self.application(*function, *argument, None),
            Node::Binary(function, first, second) => self.binary(*function, *first, *second),
        }
    }

    /// The summands of an expression with their signs: whether each is subtracted.
    pub fn terms(&self, node: NodeId, negated: bool) -> Vec<(bool, Formula)> {
        match self.names.get(&node) {
            Some(name) => vec![(negated, Formula::Symbol(name.clone()))],
            None => self.opened(node, negated),
        }
    }

    fn opened(&self, node: NodeId, negated: bool) -> Vec<(bool, Formula)> {
        let graph = &self.model.graph;
        match graph.node(node) {
            Node::Sum { offset, terms } => {
                let mut written = Vec::with_capacity(terms.len() + 1);
                for &(term, coefficient) in terms {
                    let negative = coefficient.is_negative() != negated;
                    let size = coefficient.abs();
                    let is_sum = matches!(graph.node(term), Node::Sum { .. });
                    if size.is_one() && is_sum {
                        written.extend(self.terms(term, negative));
                    } else {
                        let factor = self.expression(term).into_factor();
                        let scaled =
                            if size.is_one() { factor } else { Formula::Scaled(size, Box::new(factor)) };
                        written.push((negative, scaled));
                    }
                }
                if !offset.is_zero() {
                    written.push((offset.is_negative() != negated, Formula::Number(offset.abs())));
                }
                written
            }
            Node::Constant(value) => vec![(value.is_negative() != negated, Formula::Number(value.abs()))],
            Node::Variable(_) | Node::Product(_) | Node::Unary(..) | Node::Binary(..) => {
                vec![(negated, self.definition(node))]
            }
        }
    }

    fn binary(&self, function: Binary, first: NodeId, second: NodeId) -> Formula {
        let (first, second) = (self.expression(first), self.expression(second));
        let named = |name, arguments| {
            Formula::Application(Application { name, power: None, arguments, is_grouped: true })
        };
        match function {
            Binary::Powf => first.grouped().raised(second),
            Binary::Atan2 => named("atan2", vec![first, second]),
            Binary::Pivot => first,
            Binary::PowfLn => {
                let logarithm = named("ln", vec![first.clone()]);
                Formula::Product(vec![first.grouped().raised(second), logarithm])
            }
        }
    }

    fn variable(&self, variable: Variable) -> Symbol {
        let model = self.model;
        let numbered = |name, i: u32| symbols::symbol(name, &i.to_string(), 0);
        match variable {
            Variable::Coordinate(i) => symbols::coordinate(model, i, 0),
            Variable::Velocity(i) => symbols::coordinate(model, i, 1),
            Variable::Acceleration(i) => symbols::coordinate(model, i, 2),
            Variable::Input(i) => symbols::input(model, i),
            Variable::Multiplier(i) => symbols::multiplier(model, i),
            Variable::Parameter(i) => symbols::parameter(&model.parameters[i as usize]),
            Variable::Time => symbols::symbol("t", "", 0),
            Variable::Auxiliary(i) => numbered("u", i),
            Variable::Entry(i) => numbered("R", i),
            Variable::Position(i) => numbered("r", i),
        }
    }

    /// The position of a factor in a product: numbers, parameters, sums, coordinates and time, inputs,
    /// velocities, accelerations and multipliers, functions.
    fn rank(&self, node: NodeId) -> u32 {
        match self.model.graph.node(node) {
            Node::Constant(_) => 0,
            Node::Variable(Variable::Parameter(_)) => 1,
            Node::Sum { .. } | Node::Product(_) => 2,
            Node::Variable(
                Variable::Time | Variable::Coordinate(_) | Variable::Entry(_) | Variable::Position(_),
            ) => 3,
            Node::Variable(Variable::Input(_) | Variable::Auxiliary(_)) => 4,
            Node::Variable(Variable::Velocity(_)) => 5,
            Node::Variable(Variable::Acceleration(_) | Variable::Multiplier(_)) => 6,
            Node::Unary(..) | Node::Binary(..) => 7,
        }
    }

    fn fraction(&self, factors: &[(NodeId, Exponent)]) -> Formula {
        let mut sorted = factors.to_vec();
        sorted.sort_by_key(|&(factor, _)| self.rank(factor));
        let side = |is_above: bool| {
            let of_side = sorted.iter().filter(|(_, exponent)| (exponent.0 > 0) == is_above);
            let factors: Vec<Formula> =
                of_side.map(|&(factor, exponent)| self.power(factor, Exponent(exponent.0.abs()))).collect();
            (!factors.is_empty()).then(|| Formula::product(factors))
        };
        let above = side(true).unwrap_or(Formula::Number(Number::ONE));
        match side(false) {
            None => above,
            Some(below) => Formula::Fraction(Box::new(above), Box::new(below)),
        }
    }

    /// A positive power.
    fn power(&self, base: NodeId, exponent: Exponent) -> Formula {
        let power = match exponent.as_integer() {
            Some(1) => return self.expression(base).into_factor(),
            _ if exponent.0 == 1 => return Formula::Root(Box::new(self.expression(base))),
            Some(power) => Number::Ratio(power.into(), 1),
            None => Number::Ratio(exponent.0.into(), 2),
        };
        if let Node::Unary(function, argument) = self.model.graph.node(base)
            && self.names.get(&base).is_none()
            && exponent.as_integer().is_some()
            && is_trigonometric(*function)
        {
            return self.application(*function, *argument, Some(power));
        }
        self.expression(base).into_atom().raised(Formula::Number(power))
    }

    fn application(&self, function: Unary, argument: NodeId, power: Option<Number>) -> Formula {
        if function == Unary::Below {
            let arguments = vec![Formula::sum(self.terms(argument, true))];
            return Formula::Application(Application { name: "step", power, arguments, is_grouped: true });
        }
        let inner = self.expression(argument);
        let name = match function {
            Unary::Abs => return Formula::Absolute(Box::new(inner)),
            Unary::PositivePart => "max",
            Unary::Asin => "arcsin",
            Unary::Acos => "arccos",
            Unary::Atan => "arctan",
            Unary::Asinh => "arsinh",
            Unary::Acosh => "arcosh",
            Unary::Atanh => "artanh",
            Unary::ExpM1 => "expm1",
            Unary::Ln1p => "ln1p",
            Unary::Signum => "sgn",
            Unary::Step | Unary::Below => "step",
            Unary::Sin | Unary::Cos | Unary::Tan | Unary::Sinh | Unary::Cosh | Unary::Tanh => function.name(),
            Unary::Sech | Unary::Logistic | Unary::Exp | Unary::Ln | Unary::Cbrt => function.name(),
        };
        let is_grouped = !is_trigonometric(function) || inner.strength() < Strength::Power;
        let zero = (function == Unary::PositivePart).then_some(Formula::Number(Number::ZERO));
        let arguments = zero.into_iter().chain([inner]).collect();
        Formula::Application(Application { name, power, arguments, is_grouped })
    }
}

fn is_trigonometric(function: Unary) -> bool {
    use Unary::{Cos, Cosh, Sech, Sin, Sinh, Tan, Tanh};
    matches!(function, Sin | Cos | Tan | Sinh | Cosh | Tanh | Sech)
}

#[cfg(test)]
mod tests {
    use quote::quote;

    use crate::{Settings, expand_with};

    #[test]
    fn a_power_of_a_power_has_parentheses() {
        let item = quote! {
            impl Spring {
                #[kinetic] fn motion(&self, v: &Velocities) -> f64 { 0.5 * v.x * v.x }
                #[force(on = x)] fn push(&self, q: &Coordinates) -> f64 { q.x.powf(1.3).powi(2) }
            }
        };
        let settings = Settings { formulas: true, ..Settings::default() };
        let found = expand_with(quote!(coordinates = [x]), item, "::lagrangian", settings).to_string();
        for power in ["((x)^(1.3))²", r"{\\left({\\left(x\\right)}^{1.3}\\right)}^{2}"] {
            assert!(found.contains(power), "{found}");
        }
    }
}
