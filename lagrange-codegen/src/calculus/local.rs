//! Derivatives of the elementary functions, written with the value at hand where that is cheaper.

use crate::expr::{Binary, Graph, NodeId, Unary};
use crate::number::Number;

/// f′ at `argument`; `value` is f(argument).
pub fn unary(graph: &mut Graph, function: Unary, argument: NodeId, value: NodeId) -> NodeId {
    let one_plus = |graph: &mut Graph, square_of: NodeId, sign: Number| {
        let square = graph.powi(square_of, 2);
        graph.sum(Number::ONE, &[(square, sign)])
    };
    match function {
        Unary::Sin => graph.unary(Unary::Cos, argument),
        Unary::Cos => {
            let sine = graph.unary(Unary::Sin, argument);
            graph.neg(sine)
        }
        Unary::Tan => one_plus(graph, value, Number::ONE),
        Unary::Asin | Unary::Acos => {
            // (1 − x)(1 + x) keeps its accuracy at the ends of the domain.
            let below = graph.sum(Number::ONE, &[(argument, Number::MINUS_ONE)]);
            let above = graph.sum(Number::ONE, &[(argument, Number::ONE)]);
            let product = graph.mul(below, above);
            let root = graph.sqrt(product);
            let slope = graph.powi(root, -1);
            if function == Unary::Asin { slope } else { graph.neg(slope) }
        }
        Unary::Atan => {
            let denominator = one_plus(graph, argument, Number::ONE);
            graph.powi(denominator, -1)
        }
        Unary::Sinh => graph.unary(Unary::Cosh, argument),
        Unary::Cosh => graph.unary(Unary::Sinh, argument),
        Unary::Tanh => {
            // 1 − tanh² would lose all its digits where the function is saturated.
            let secant = graph.unary(Unary::Sech, argument);
            graph.powi(secant, 2)
        }
        Unary::Sech => {
            let tangent = graph.unary(Unary::Tanh, argument);
            let product = graph.mul(value, tangent);
            graph.neg(product)
        }
        Unary::Logistic => {
            // 1 − y loses its digits where y approaches 1.
            let opposite = graph.neg(argument);
            let rest = graph.unary(Unary::Logistic, opposite);
            graph.mul(value, rest)
        }
        Unary::Asinh => {
            let square = one_plus(graph, argument, Number::ONE);
            let root = graph.sqrt(square);
            graph.powi(root, -1)
        }
        Unary::Acosh => {
            let below = graph.sum(Number::MINUS_ONE, &[(argument, Number::ONE)]);
            let above = graph.sum(Number::ONE, &[(argument, Number::ONE)]);
            let product = graph.mul(below, above);
            let root = graph.sqrt(product);
            graph.powi(root, -1)
        }
        Unary::Atanh => {
            let below = graph.sum(Number::ONE, &[(argument, Number::MINUS_ONE)]);
            let above = graph.sum(Number::ONE, &[(argument, Number::ONE)]);
            let product = graph.mul(below, above);
            graph.powi(product, -1)
        }
        Unary::Exp => value,
        Unary::ExpM1 => graph.unary(Unary::Exp, argument),
        Unary::Ln => graph.powi(argument, -1),
        Unary::Ln1p => {
            let denominator = graph.sum(Number::ONE, &[(argument, Number::ONE)]);
            graph.powi(denominator, -1)
        }
        Unary::Cbrt => {
            let square = graph.powi(value, -2);
            graph.scale(square, Number::Ratio(1, 3))
        }
        Unary::Abs => graph.unary(Unary::Signum, argument),
        Unary::Signum | Unary::Step | Unary::Below => graph.zero(),
        Unary::PositivePart => {
            let half = Number::Ratio(1, 2);
            let sign = graph.unary(Unary::Signum, argument);
            graph.sum(half, &[(sign, half)])
        }
    }
}

/// The two partial derivatives at `(first, second)`.
pub fn binary(graph: &mut Graph, function: Binary, first: NodeId, second: NodeId) -> (NodeId, NodeId) {
    match function {
        Binary::Atan2 => {
            let (y2, x2) = (graph.powi(first, 2), graph.powi(second, 2));
            let square = graph.add(x2, y2);
            let by_y = graph.div(second, square);
            let by_x = graph.div(first, square);
            (by_y, graph.neg(by_x))
        }
        Binary::Powf => {
            let lowered = graph.sum(Number::MINUS_ONE, &[(second, Number::ONE)]);
            let lowered = graph.powf(first, lowered);
            let by_base = graph.mul(second, lowered);
            (by_base, graph.powf_ln(first, second))
        }
        Binary::PowfLn => {
            let lowered = graph.sum(Number::MINUS_ONE, &[(second, Number::ONE)]);
            let (power, slope) = (graph.powf(first, lowered), graph.powf_ln(first, lowered));
            let slope = graph.mul(second, slope);
            let by_base = graph.add(slope, power);
            // xʸ ln² x is the square of a function that has the limit as well.
            let half = graph.scale(second, Number::Ratio(1, 2));
            let root = graph.powf_ln(first, half);
            (by_base, graph.powi(root, 2))
        }
        Binary::Pivot => (graph.one(), graph.zero()),
    }
}
