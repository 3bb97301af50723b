//! Kinks and jumps: functions that are smooth on either side of a zero of their argument.

use crate::calculus::substitute;
use crate::eliminate::quantities::rewrite;
use crate::expr::{Dependence, Graph, Node, NodeId, Unary};
use crate::mechanics::Equations;
use crate::model::Model;
use crate::number::Number;

/// What changes in the course of a step.
const MOVING: Dependence = Dependence::COORDINATES
    .union(Dependence::VELOCITIES)
    .union(Dependence::TIME)
    .union(Dependence::MULTIPLIERS);

/// The arguments of all functions with a kink or a jump in some equations, inner ones first.
pub(super) fn of(model: &Model, equations: &Equations) -> Vec<NodeId> {
    let conditions = &equations.conditions;
    let roots = equations.momenta.iter().chain(&equations.momentum_rates).chain(&equations.force);
    let rows = conditions.rates.iter().chain(&conditions.positions).chain([&equations.energy]);
    let mut arguments: Vec<NodeId> = Vec::new();
    for id in model.graph.cone(roots.chain(rows).copied()) {
        if let Some(argument) = kinked(&model.graph, id)
            && !arguments.contains(&argument)
        {
            arguments.push(argument);
        }
    }
    arguments
}

/// Whether there is one in a node.
pub(super) fn are_in(model: &Model, node: NodeId) -> bool {
    model.graph.cone([node]).into_iter().any(|id| kinked(&model.graph, id).is_some())
}

/// The argument of a function with a kink, where it moves.
fn kinked(graph: &Graph, id: NodeId) -> Option<NodeId> {
    match *graph.node(id) {
        Node::Unary(Unary::Abs | Unary::Signum | Unary::PositivePart, argument)
            if graph.dependence(argument).meets(MOVING) =>
        {
            Some(argument)
        }
        _ => None,
    }
}

/// What the energy gains where the argument of each kink passes zero upwards: nothing, unless a function of the
/// energy jumps.
pub(super) fn jumps(model: &mut Model, equations: &Equations, kinks: &[NodeId]) -> Vec<NodeId> {
    let graph = &mut model.graph;
    let (one, zero) = (graph.one(), graph.zero());
    let mut jumps = Vec::with_capacity(kinks.len());
    for &argument in kinks {
        let minus = graph.neg(argument);
        let minus_one = graph.neg(one);
        let functions = [Unary::Abs, Unary::Signum, Unary::PositivePart];
        let nodes = functions.map(|function| graph.unary(function, argument));
        let mut on = |images: [NodeId; 3]| {
            let replacements: Vec<(NodeId, NodeId)> = nodes.into_iter().zip(images).collect();
            substitute(graph, &[equations.energy], &replacements)[0]
        };
        let (above, below) = (on([argument, one, argument]), on([minus, minus_one, zero]));
        jumps.push(graph.sub(above, below));
    }
    jumps
}

/// Replaces these functions by what they are on the side that each switch names.
pub(super) fn replace(model: &mut Model, kinks: &[NodeId], sides: &[NodeId]) {
    // Outer ones first: the argument of one may hold another.
    for (&argument, &side) in kinks.iter().zip(sides).rev() {
        let graph = &mut model.graph;
        let half = graph.sum(Number::HALF, &[(side, Number::HALF)]);
        let images = [
            (Unary::Abs, graph.mul(side, argument)),
            (Unary::Signum, side),
            (Unary::PositivePart, graph.mul(half, argument)),
        ];
        let replacements: Vec<(NodeId, NodeId)> =
            images.map(|(function, image)| (graph.unary(function, argument), image)).to_vec();
        rewrite(model, &replacements);
    }
}
