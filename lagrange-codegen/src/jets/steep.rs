//! Functions that can hide from a Taylor series.
//!
//! An exponential, a wall ∝ r⁻¹² or a smoothed sign v/√(v² + ε²) vanishes beside other terms, or underflows,
//! a few of its widths away, and the series there does not show it. Neither does it show x²² or cos⁴⁰t from
//! near their zeros. Sines, cosines and the powers of gravitation are as large as anything else wherever a
//! series starts.

use super::sides::{Switch, forms};
use crate::collections::Lookup;
use crate::expr::{Binary, Dependence, Exponent, Graph, Node, NodeId, Unary};

/// This power, counted in halves, and those below it are steep: x⁻⁴, or s⁻⁴ of a squared distance s.
const STEEPEST: i32 = -8;

/// The lowest positive power, counted in halves, that is flat: a series from near its zero to fewer orders
/// does not show it. Of lower ones the orders of a tolerance of 1e-4 and finer see something: x⁷ as a force
/// enters the coordinate at order nine, and these are ten.
const FLATTEST: i32 = 16;

/// The most functions whose arguments are looked at in a step. Those of all pairs of hundreds of bodies would
/// cost more than the step itself.
const MOST: usize = 256;

/// What such functions depend on, along a motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hidden {
    /// The arguments of functions. Those of opposite ones are listed once.
    pub arguments: Vec<NodeId>,
    /// The bases of powers, and the largest power of each without its sign.
    pub bases: Vec<(NodeId, u32)>,
}

impl Hidden {
    /// All of them, arguments first.
    pub fn all(&self) -> Vec<NodeId> {
        self.arguments.iter().copied().chain(self.bases.iter().map(|&(base, _)| base)).collect()
    }

    /// The line in `STRUCTURE`.
    pub fn describe(&self) -> String {
        let functions = match self.all().len() {
            0 => return "steep: steps are compared with the equations".to_owned(),
            1 => "a function".to_owned(),
            count => format!("{count} functions"),
        };
        format!("steep: steps are compared with the equations, also where {functions} may be narrow")
    }
}

/// Finds what the functions in the equations depend on that can hide from a series. `None` means that no
/// function can.
pub fn hidden(graph: &mut Graph, roots: &[NodeId], switches: &[Switch]) -> Option<Hidden> {
    let mut found = Found::default();
    for id in graph.cone(roots.iter().copied()) {
        if graph.dependence(id).is_fixed() {
            continue;
        }
        match graph.node(id).clone() {
            Node::Unary(function, argument) if hides(function) => {
                let (coefficient, _) = graph.scaled(argument);
                let positive = if coefficient.is_negative() { graph.neg(argument) } else { argument };
                found.argument(graph, positive);
            }
            Node::Binary(Binary::Powf | Binary::PowfLn, base, exponent) => {
                let power = graph.as_constant(exponent).map_or(1.0, |power| power.value().abs().ceil());
                found.base(graph, base, power as u32);
            }
            Node::Binary(Binary::Atan2, y, x) => {
                let [y, x] = [y, x].map(|side| graph.powi(side, 2));
                let square = graph.add(y, x);
                found.base(graph, square, 1);
            }
            Node::Product(factors) => {
                for (base, power) in factors {
                    if is_steep_somewhere(graph, base, power, switches) {
                        found.base(graph, base, power.0.unsigned_abs().div_ceil(2));
                    }
                }
            }
            _ => {}
        }
    }
    found.hidden.arguments.truncate(MOST);
    found.hidden.bases.truncate(MOST - found.hidden.arguments.len());
    found.any.then_some(found.hidden)
}

/// Functions that have been found.
#[derive(Default)]
struct Found {
    any: bool,
    /// The places of arguments and bases in their lists.
    seen: Lookup<(NodeId, bool), usize>,
    hidden: Hidden,
}

impl Found {
    fn argument(&mut self, graph: &Graph, argument: NodeId) {
        self.any = true;
        if is_known(graph, argument) && self.seen.insert((argument, false), 0).is_none() {
            self.hidden.arguments.push(argument);
        }
    }

    fn base(&mut self, graph: &Graph, base: NodeId, power: u32) {
        self.any = true;
        let bases = &mut self.hidden.bases;
        match self.seen.get(&(base, true)) {
            Some(&place) => bases[place].1 = bases[place].1.max(power),
            None if is_known(graph, base) => {
                self.seen.insert((base, true), bases.len());
                bases.push((base, power.max(1)));
            }
            None => {}
        }
    }
}

/// Whether a node changes with the state or with time, and is known there.
fn is_known(graph: &Graph, node: NodeId) -> bool {
    let moving = Dependence::COORDINATES.union(Dependence::VELOCITIES).union(Dependence::TIME);
    let dependence = graph.dependence(node);
    dependence.meets(moving) && !dependence.meets(Dependence::MULTIPLIERS)
}

/// Whether a power is steep on some side of the switches in its base.
fn is_steep_somewhere(graph: &mut Graph, base: NodeId, exponent: Exponent, switches: &[Switch]) -> bool {
    is_steep_power(graph, base, exponent)
        && forms(graph, base, switches, &|_, _| [true; 2])
            .is_none_or(|forms| forms.into_iter().any(|form| is_steep_power(graph, form, exponent)))
}

fn hides(function: Unary) -> bool {
    match function {
        Unary::Exp
        | Unary::ExpM1
        | Unary::Sinh
        | Unary::Cosh
        | Unary::Tanh
        | Unary::Sech
        | Unary::Logistic
        | Unary::Asinh
        | Unary::Atan => true,
        Unary::Sin
        | Unary::Cos
        | Unary::Tan
        | Unary::Asin
        | Unary::Acos
        | Unary::Acosh
        | Unary::Atanh
        | Unary::Ln
        | Unary::Ln1p
        | Unary::Cbrt
        | Unary::Abs
        | Unary::Signum
        | Unary::PositivePart
        | Unary::Step
        | Unary::Below => false,
    }
}

/// Whether a power is [`STEEPEST`] or below or [`FLATTEST`] or above, or is a root or reciprocal of a sum
/// with a fixed part, which is how kinks are smoothed.
fn is_steep_power(graph: &Graph, base: NodeId, exponent: Exponent) -> bool {
    if graph.dependence(base).is_fixed() {
        return false;
    }
    let smooths = |node: &Node| match node {
        Node::Sum { offset, terms } => {
            !offset.is_zero() || terms.iter().any(|&(term, _)| graph.dependence(term).is_fixed())
        }
        _ => false,
    };
    let is_root = exponent.as_integer().is_none();
    let is_kink = if is_root { !is_difference(graph, base) } else { exponent.0 < 0 };
    exponent.0 <= STEEPEST || exponent.0 >= FLATTEST || is_kink && smooths(graph.node(base))
}

/// Whether the base is L² − y², the square of a side of a triangle. Its root is as large as anything else
/// until it vanishes.
fn is_difference(graph: &Graph, base: NodeId) -> bool {
    let Node::Sum { offset, terms } = graph.node(base) else { return false };
    let is_square =
        |node: NodeId| graph.factors(node).iter().all(|&(_, exponent)| exponent.0 > 0 && exponent.0 % 4 == 0);
    let (fixed, moving): (Vec<_>, Vec<_>) =
        terms.iter().partition(|&&(term, _)| graph.dependence(term).is_fixed());
    !offset.is_negative()
        && fixed.iter().all(|&&(term, c)| is_square(term) && !c.is_negative())
        && moving.iter().all(|&&(term, c)| is_square(term) && c.is_negative())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Variable;
    use crate::number::Number;

    #[test]
    fn walls_and_smoothed_kinks_hide() {
        let mut graph = Graph::default();
        let x = graph.variable(Variable::Coordinate(0));
        let y = graph.variable(Variable::Coordinate(1));
        let width = graph.variable(Variable::Parameter(0));
        let [xx, yy, ww] = [x, y, width].map(|node| graph.powi(node, 2));
        let square = graph.add(xx, yy);
        let distance = graph.sqrt(square);
        let smoothed = graph.sum(Number::ZERO, &[(xx, Number::ONE), (ww, Number::ONE)]);
        let side = graph.sum(Number::ZERO, &[(ww, Number::ONE), (xx, Number::MINUS_ONE)]);
        let [sine, exp] = [Unary::Sin, Unary::Exp].map(|function| graph.unary(function, x));
        for (node, expected) in [
            (graph.powi(distance, -3), false),
            (distance, false),
            (sine, false),
            (graph.powi(width, -12), false),
            (graph.powi(x, -2), false),
            (graph.powi(x, 7), false),
            (graph.powi(x, 8), true),
            (graph.powi(sine, 40), true),
            (graph.powi(distance, -12), true),
            (graph.sqrt(smoothed), true),
            (graph.sqrt(side), false),
            (graph.powi(side, -1), true),
            (graph.powi(smoothed, -1), true),
            (exp, true),
        ] {
            assert_eq!(
                hidden(&mut graph, &[node], &[]).is_some(),
                expected,
                "{}",
                graph.print(node, &|v| format!("{v:?}"))
            );
        }
    }
}
