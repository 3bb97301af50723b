//! Physics that cannot be right. It is reported on the user's own expression, unless `allow(…)` permits it.

mod constraints;
mod exactness;
mod inertia;
mod matching;

pub(super) use constraints::constraints;
pub(super) use inertia::inertia;

use crate::calculus::beyond_degree;
use crate::diagnostics::{Diagnostics, Origin, physics};
use crate::expr::{Dependence, Graph, Node, NodeId, Variable};
use crate::mechanics::Equations;
use crate::model::{Action, Attitude, Law, Model};
use crate::number::Number;

/// Reports contributions without effect or of the wrong form. Returns whether a particle or body is among
/// them, so that a coordinate may lack the inertia that it was to have.
pub(super) fn contributions(
    model: &Model,
    allows: &dyn Fn(&str) -> bool,
    diagnostics: &mut Diagnostics,
) -> bool {
    for term in &model.kinetic {
        if let Some(node) = beyond_degree(&model.graph, term.value, 2).first() {
            let origin = model.origins.get(node).copied().unwrap_or(term.origin);
            diagnostics.at(origin, physics::kinetic_not_quadratic(&term.name));
        }
    }
    if allows("no_effect") {
        return false;
    }
    for term in &model.dissipation {
        let (graph, value) = (&model.graph, term.value);
        if graph.dependence(value).meets(Dependence::VELOCITIES) && beyond_degree(graph, value, 1).is_empty()
        {
            diagnostics.at(term.origin, physics::linear_dissipation(&term.name));
        }
    }
    let graph = &model.graph;
    let eliminated = !model.eliminated.is_empty();
    let state = Dependence::COORDINATES.union(Dependence::VELOCITIES);
    let idle = |value: NodeId, matters: Dependence| !graph.dependence(value).meets(matters);
    for (role, terms, matters) in [
        ("kinetic energy", &model.kinetic, state),
        ("potential", &model.potential, Dependence::COORDINATES),
        ("Lagrangian", &model.lagrangian, state),
        ("dissipation function", &model.dissipation, Dependence::VELOCITIES),
    ] {
        for term in terms.iter().filter(|term| idle(term.value, matters)) {
            diagnostics.at(term.origin, physics::no_effect(role, &term.name, eliminated));
        }
    }
    let changing = state.union(Dependence::TIME).union(Dependence::INPUTS);
    for event in model.events.iter().filter(|event| idle(event.value, changing)) {
        diagnostics.at(event.origin, physics::no_event(&event.name));
    }
    let mut reported: Vec<Origin> = Vec::new();
    let complain =
        |reported: &mut Vec<Origin>, origin: Origin, message: String, diagnostics: &mut Diagnostics| {
            if !reported.contains(&origin) {
                reported.push(origin);
                diagnostics.at(origin, message);
            }
        };
    let fixed = |position: &[NodeId]| position.iter().all(|&x| idle(x, Dependence::COORDINATES));
    for point in &model.points {
        if fixed(&point.position) {
            complain(
                &mut reported,
                point.origin,
                physics::fixed_in_space("point", &point.name, eliminated),
                diagnostics,
            );
        } else if graph.is_zero(point.mass) {
            complain(&mut reported, point.origin, physics::zero_mass(&point.name), diagnostics);
        } else if graph.as_constant(point.mass).is_some_and(Number::is_negative) {
            complain(&mut reported, point.origin, physics::negative_mass(&point.name), diagnostics);
        }
    }
    for body in &model.bodies {
        let (turns, inert) = match &body.attitude {
            Attitude::Planar { angle, inertia } => (!fixed(&[*angle]), graph.is_zero(*inertia)),
            Attitude::Spatial { rotation, inertia } => (
                !rotation.matrix.iter().all(|row| fixed(row)),
                inertia.iter().flatten().all(|&entry| graph.is_zero(entry)),
            ),
        };
        if graph.is_zero(body.mass) && inert {
            complain(&mut reported, body.origin, physics::zero_mass(&body.name), diagnostics);
        } else if graph.as_constant(body.mass).is_some_and(Number::is_negative) {
            complain(&mut reported, body.origin, physics::negative_mass(&body.name), diagnostics);
        }
        let moments = match &body.attitude {
            Attitude::Planar { inertia, .. } => vec![*inertia],
            Attitude::Spatial { inertia, .. } => (0..3).map(|axis| inertia[axis][axis]).collect(),
        };
        let negative = |&moment: &NodeId| graph.as_constant(moment).is_some_and(Number::is_negative);
        if moments.iter().any(negative) {
            complain(&mut reported, body.origin, physics::negative_inertia(&body.name), diagnostics);
        }
        if fixed(&body.position) && !turns {
            complain(
                &mut reported,
                body.origin,
                physics::fixed_in_space("body", &body.name, eliminated),
                diagnostics,
            );
        }
    }
    let are_inert = !reported.is_empty();
    for force in &model.forces {
        let has_effect = match &force.action {
            Action::Generalized(entries) => entries.iter().any(|&(_, value)| !graph.is_zero(value)),
            Action::AtPosition { position, force } => position
                .iter()
                .zip(force)
                .any(|(&x, &f)| !idle(x, Dependence::COORDINATES) && !graph.is_zero(f)),
            Action::PlanarTorque { angle, torque } => !fixed(&[*angle]) && !graph.is_zero(*torque),
            Action::Along(loads) => loads.iter().any(|&(_, load)| !graph.is_zero(load)),
            Action::SpatialTorque { torque, .. } => torque.iter().any(|&component| !graph.is_zero(component)),
        };
        let part_of_a_pair = model.forces.iter().filter(|other| other.origin == force.origin).count() > 1;
        if !has_effect && !part_of_a_pair {
            complain(
                &mut reported,
                force.origin,
                physics::no_effect("force", &force.name, eliminated),
                diagnostics,
            );
        }
    }
    are_inert
}

/// Reports constants that are not numbers: roots and logarithms of negative numbers, quotients by zero.
pub(super) fn constants(model: &Model, diagnostics: &mut Diagnostics) {
    let graph = &model.graph;
    let terms =
        model.kinetic.iter().chain(&model.potential).chain(&model.lagrangian).chain(&model.dissipation);
    let mut roots: Vec<(NodeId, Origin)> = terms.map(|term| (term.value, term.origin)).collect();
    for point in &model.points {
        roots.extend(point.position.iter().chain([&point.mass]).map(|&node| (node, point.origin)));
    }
    for body in &model.bodies {
        roots.extend(body.position.iter().chain([&body.mass]).map(|&node| (node, body.origin)));
    }
    roots.extend(model.constraints.iter().map(|constraint| (constraint.value, constraint.origin)));
    roots.extend(model.eliminated.iter().map(|eliminated| (eliminated.position, eliminated.quantity.origin)));
    if graph.cone(roots.iter().map(|&(root, _)| root)).into_iter().all(|id| is_number(graph, id)) {
        return;
    }
    for (root, origin) in roots {
        let broken = graph.cone([root]).into_iter().find(|&id| !is_number(graph, id));
        if let Some(node) = broken {
            let place = model.origins.get(&node).copied().unwrap_or(origin);
            diagnostics.at(place, physics::not_a_number());
        }
    }
}

/// Whether a node is no constant or has a finite value, and is no product with the root of a negative
/// constant.
fn is_number(graph: &Graph, id: NodeId) -> bool {
    if let Node::Product(factors) = graph.node(id) {
        // In a product a constant root is one factor among others.
        let negative = |node: NodeId| graph.as_constant(node).is_some_and(Number::is_negative);
        if factors.iter().any(|&(node, exponent)| exponent.as_integer().is_none() && negative(node)) {
            return false;
        }
    }
    match graph.as_constant(id) {
        Some(number) => number.value().is_finite(),
        None if graph.dependence(id) == Dependence::NONE => {
            graph.evaluate(&[id], |_| f64::NAN)[0].is_finite()
        }
        None => true,
    }
}

/// Reports inputs that appear in no equation and in no law of a contact.
pub(super) fn inputs(
    model: &Model,
    equations: &Equations,
    allows: &dyn Fn(&str) -> bool,
    diagnostics: &mut Diagnostics,
) {
    if allows("unused_input") {
        return;
    }
    let laws = model.contacts.iter().flat_map(|contact| match contact.law {
        Law::Unilateral { restitution, .. } => [restitution; 2],
        Law::Friction { kinetic, fixed, .. } => [kinetic, fixed],
    });
    // What the mass matrix depends on, the momenta do.
    let force = equations.force.iter().chain(&equations.momenta).copied();
    let roots: Vec<NodeId> = force.chain(equations.mass.entries()).chain(laws).collect();
    let used = used_inputs(&model.graph, &roots, model.inputs.len());
    for (input, used) in model.inputs.iter().zip(used) {
        if !used {
            diagnostics.at(input.origin, physics::unused_input(&input.written()));
        }
    }
}

fn used_inputs(graph: &Graph, roots: &[NodeId], count: usize) -> Vec<bool> {
    let mut used = vec![false; count];
    for id in graph.cone(roots.iter().copied()) {
        if let Node::Variable(Variable::Input(input)) = graph.node(id) {
            used[*input as usize] = true;
        }
    }
    used
}
