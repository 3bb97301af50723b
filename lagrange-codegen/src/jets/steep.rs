//! Functions that can hide from a Taylor series.
//!
//! An exponential, a wall ∝ r⁻¹² or a smoothed sign v/√(v² + ε²) vanishes beside other terms, or underflows,
//! a few of its widths away, and the series there does not show it. Sines, cosines and the powers of
//! gravitation are as large as anything else wherever a series starts.

use super::sides::{Switch, forms};
use crate::expr::{Binary, Exponent, Graph, Node, NodeId, Unary};

/// This power, counted in halves, and those below it are steep: x⁻⁴, or s⁻⁴ of a squared distance s.
const STEEPEST: i32 = -8;

/// Whether the equations contain such a function.
pub(super) fn is_steep(graph: &mut Graph, roots: &[NodeId], switches: &[Switch]) -> bool {
    graph.cone(roots.iter().copied()).into_iter().any(|id| {
        !graph.dependence(id).is_fixed()
            && match graph.node(id).clone() {
                Node::Unary(function, _) => hides(function),
                Node::Binary(function, ..) => match function {
                    Binary::Powf | Binary::PowfLn | Binary::Atan2 => true,
                    Binary::Pivot => false,
                },
                Node::Product(factors) => {
                    factors.into_iter().any(|(base, power)| is_steep_somewhere(graph, base, power, switches))
                }
                Node::Constant(_) | Node::Variable(_) | Node::Sum { .. } => false,
            }
    })
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

/// Whether a power is [`STEEPEST`] or below, or is a root or reciprocal of a sum with a fixed part, which is
/// how kinks are smoothed.
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
    exponent.0 <= STEEPEST || is_kink && smooths(graph.node(base))
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
            (graph.powi(distance, -12), true),
            (graph.sqrt(smoothed), true),
            (graph.sqrt(side), false),
            (graph.powi(side, -1), true),
            (graph.powi(smoothed, -1), true),
            (exp, true),
        ] {
            assert_eq!(
                is_steep(&mut graph, &[node], &[]),
                expected,
                "{}",
                graph.print(node, &|v| format!("{v:?}"))
            );
        }
    }
}
