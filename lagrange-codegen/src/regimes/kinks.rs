//! Kinks and jumps: functions that are smooth on either side of a zero of their argument.

use crate::calculus::substitute;
use crate::eliminate::quantities::rewrite;
use crate::expr::{Dependence, Graph, Node, NodeId, Unary};
use crate::mechanics::Equations;
use crate::model::{Action, Contact, Law, Model, orientation};
use crate::number::Number;

/// The variables that change during a step.
pub(super) const MOVING: Dependence = Dependence::COORDINATES
    .union(Dependence::VELOCITIES)
    .union(Dependence::TIME)
    .union(Dependence::MULTIPLIERS);

/// The arguments of all functions with a kink or a jump in some equations and in the laws of friction, inner
/// ones first.
pub(super) fn of(model: &mut Model, equations: &Equations, contacts: &[Contact]) -> Vec<NodeId> {
    let conditions = &equations.conditions;
    let roots = equations.momenta.iter().chain(&equations.momentum_rates).chain(&equations.force);
    let rows = conditions.rates.iter().chain(&conditions.positions).chain([&equations.energy]);
    let laws = contacts.iter().filter_map(laws).flatten();
    arguments(&mut model.graph, roots.chain(rows).copied().chain(laws))
}

/// The kinetic and the static coefficient of a friction.
pub(super) fn laws(contact: &Contact) -> Option<[NodeId; 2]> {
    match contact.law {
        Law::Friction { kinetic, fixed, .. } => Some([kinetic, fixed]),
        Law::Unilateral { .. } => None,
    }
}

/// The arguments of all functions with a kink or a jump in some nodes, inner ones first.
pub(super) fn arguments(graph: &mut Graph, nodes: impl IntoIterator<Item = NodeId>) -> Vec<NodeId> {
    let mut arguments: Vec<NodeId> = Vec::new();
    for id in graph.cone(nodes) {
        let Some(argument) = kinked(graph, id) else { continue };
        // An argument and its opposite, as of the larger and the smaller of two numbers, share one switch.
        let opposite = graph.neg(argument);
        if !arguments.contains(&argument) && !arguments.contains(&opposite) {
            arguments.push(argument);
        }
    }
    arguments
}

/// The arguments `kinks` where matrices of orientations are variables: from the graph `before`, or from the
/// laws of frictions; `None` if one of them is not found.
pub(super) fn described(
    before: &Graph,
    model: &mut Model,
    kinks: &[NodeId],
    contacts: &[Contact],
) -> Option<Vec<NodeId>> {
    let mut all: Vec<NodeId> = before.nodes().filter_map(|id| kinked(before, id)).collect();
    all.extend(arguments(&mut model.graph, contacts.iter().filter_map(laws).flatten()));
    all.dedup();
    let known = orientation::of_parameters(&mut model.graph, &model.turning);
    let images = substitute(&mut model.graph, &all, &known);
    let of = |kink: &NodeId| {
        let opposite = model.graph.neg(*kink);
        let index = images.iter().position(|image| image == kink || *image == opposite)?;
        Some(all[index])
    };
    kinks.iter().map(of).collect()
}

/// Whether a node contains a function with a kink or a jump.
pub(super) fn are_in(model: &Model, node: NodeId) -> bool {
    model.graph.cone([node]).into_iter().any(|id| kinked(&model.graph, id).is_some())
}

/// The argument of a function with a kink or a jump, if the argument moves.
pub(super) fn kinked(graph: &Graph, id: NodeId) -> Option<NodeId> {
    match *graph.node(id) {
        Node::Unary(
            Unary::Abs | Unary::Signum | Unary::PositivePart | Unary::Step | Unary::Below,
            argument,
        ) if graph.dependence(argument).meets(MOVING) => Some(argument),
        _ => None,
    }
}

/// The gain of the energy when the argument of each kink passes zero upwards. It is zero unless the energy
/// contains a function that jumps.
pub(super) fn jumps(model: &mut Model, equations: &Equations, kinks: &[NodeId]) -> Vec<NodeId> {
    kinks.iter().map(|&argument| across(&mut model.graph, argument, &[equations.energy])[0]).collect()
}

/// A function of the motion with two values at a kink: a momentum, or the rate of a constraint.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    /// The kink.
    pub kink: usize,
    /// The gain of the function when the argument of the kink passes zero upwards.
    pub gain: NodeId,
    /// The function.
    pub function: NodeId,
}

/// The corners at each kink. Velocities are continuous at a kink, so momenta and the rates of constraints
/// must be.
pub(super) fn corners(
    model: &mut Model,
    equations: &Equations,
    held: usize,
    kinks: &[NodeId],
) -> Vec<Corner> {
    let functions: Vec<NodeId> =
        equations.momenta.iter().chain(equations.conditions.rates.iter().take(held)).copied().collect();
    let graph = &mut model.graph;
    let mut corners = Vec::new();
    for (kink, &argument) in kinks.iter().enumerate() {
        let gains = across(graph, argument, &functions);
        let both = gains.into_iter().zip(&functions).filter(|&(gain, _)| !graph.is_zero(gain));
        corners.extend(both.map(|(gain, &function)| Corner { kink, gain, function }));
    }
    corners
}

/// A contact or constraint whose function has two values at a kink.
#[derive(Clone, Copy, Debug)]
pub struct Jump {
    /// The kink.
    pub kink: usize,
    /// The row.
    pub row: usize,
    /// The gain of its function when the argument of the kink passes zero upwards.
    pub gain: NodeId,
}

/// The gaps and constraints that jump at each kink.
pub(super) fn breaks(model: &mut Model, equations: &Equations, kinks: &[NodeId]) -> Vec<Jump> {
    let graph = &mut model.graph;
    let mut breaks = Vec::new();
    for (kink, &argument) in kinks.iter().enumerate() {
        let gains = across(graph, argument, &equations.conditions.positions);
        let jumps = gains.into_iter().enumerate().filter(|&(_, gain)| !graph.is_zero(gain));
        breaks.extend(jumps.map(|(row, gain)| Jump { kink, row, gain }));
    }
    breaks
}

/// The gains of some functions when the argument of a kink passes zero upwards.
fn across(graph: &mut Graph, argument: NodeId, functions: &[NodeId]) -> Vec<NodeId> {
    let one = graph.one();
    let minus_one = graph.neg(one);
    let [above, below] = [one, minus_one].map(|side| {
        let replacements = on_side(graph, argument, side);
        substitute(graph, functions, &replacements)
    });
    above.into_iter().zip(below).map(|(above, below)| graph.sub(above, below)).collect()
}

/// A function of the user that contains each kink, with forces before all others; an empty name if none is
/// known.
pub(super) fn names(model: &mut Model, kinks: &[NodeId], contacts: &[Contact]) -> Vec<String> {
    let zero = model.graph.zero();
    let mut functions: Vec<(String, Vec<NodeId>)> = Vec::new();
    for force in &model.forces {
        let nodes = match &force.action {
            Action::Generalized(entries) => entries.iter().map(|&(_, load)| load).collect(),
            Action::Along(loads) => loads.iter().map(|&(_, load)| load).collect(),
            Action::AtPosition { force, .. } => force.clone(),
            Action::PlanarTorque { torque, .. } => vec![*torque],
            Action::SpatialTorque { torque, .. } => torque.to_vec(),
        };
        functions.push((force.name.clone(), nodes));
    }
    for terms in [&model.kinetic, &model.potential, &model.lagrangian, &model.dissipation] {
        functions.extend(terms.iter().map(|term| (term.name.clone(), vec![term.value])));
    }
    functions.extend(model.constraints.iter().map(|row| (row.written(), vec![row.value])));
    let frictions = contacts.iter().map(|contact| (contact, laws(contact).unwrap_or([zero; 2])));
    functions.extend(frictions.map(|(contact, laws)| (contact.constraint.written(), laws.to_vec())));
    functions.extend(model.points.iter().map(|point| (point.name.clone(), point.position.clone())));
    let graph = &mut model.graph;
    let owner = |&argument: &NodeId| {
        let opposite = graph.neg(argument);
        let has_it = |nodes: &Vec<NodeId>| {
            let cone = graph.cone(nodes.iter().copied());
            cone.into_iter().any(|id| kinked(graph, id).is_some_and(|own| own == argument || own == opposite))
        };
        functions.iter().find(|(_, nodes)| has_it(nodes)).map(|(name, _)| name.clone()).unwrap_or_default()
    };
    kinks.iter().map(owner).collect()
}

/// Replaces these functions by their forms on the side that each switch gives. Returns the arguments after
/// the replacement.
pub(super) fn replace(model: &mut Model, kinks: &[NodeId], sides: &[NodeId]) -> Vec<NodeId> {
    let mut arguments = kinks.to_vec();
    // Outer ones come first, since the argument of one may contain another.
    for (&argument, &side) in kinks.iter().zip(sides).rev() {
        let replacements = on_side(&mut model.graph, argument, side);
        rewrite(model, &replacements);
        arguments = substitute(&mut model.graph, &arguments, &replacements);
    }
    arguments
}

/// The functions with a kink at the zero of an argument, and their forms on a side of it, one or minus one.
pub(super) fn on_side(graph: &mut Graph, argument: NodeId, side: NodeId) -> Vec<(NodeId, NodeId)> {
    let (opposite, other_side) = (graph.neg(argument), graph.neg(side));
    let mut replacements = Vec::new();
    for (argument, side) in [(argument, side), (opposite, other_side)] {
        let half = graph.sum(Number::HALF, &[(side, Number::HALF)]);
        let other_half = graph.sum(Number::ONE, &[(half, Number::MINUS_ONE)]);
        let images = [
            (Unary::Abs, graph.mul(side, argument)),
            (Unary::Signum, side),
            (Unary::PositivePart, graph.mul(half, argument)),
            (Unary::Step, half),
            (Unary::Below, other_half),
        ];
        for (function, image) in images {
            let node = graph.unary(function, argument);
            // An even or odd function has one node for both signs of its argument.
            if *graph.node(node) == Node::Unary(function, argument) {
                replacements.push((node, image));
            }
        }
    }
    replacements
}
