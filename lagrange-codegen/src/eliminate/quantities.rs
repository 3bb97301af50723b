//! Every quantity of a model, for a rewriting of all of them at once.

use crate::calculus::substitute;
use crate::expr::{Node, NodeId};
use crate::model::{Action, Attitude, Contact, Eliminated, Law, Lever, Model, Rotation, RotationForm};

/// All quantities of a model.
pub(crate) fn roots(model: &mut Model) -> Vec<NodeId> {
    let mut roots = Vec::new();
    visit(model, &mut |node| roots.push(*node));
    roots
}

/// Replaces nodes in all quantities of a model. Names and origins go with them.
pub(crate) fn rewrite(model: &mut Model, replacements: &[(NodeId, NodeId)]) {
    let roots = roots(model);
    let cone = model.graph.cone(roots);
    let images = substitute(&mut model.graph, &cone, replacements);
    for (&node, &image) in cone.iter().zip(&images) {
        if node == image || matches!(model.graph.node(image), Node::Constant(_) | Node::Variable(_)) {
            continue;
        }
        if let Some(name) = model.hints.name(node).map(str::to_owned) {
            model.hints.suggest(image, name);
        }
        if let Some(&origin) = model.origins.get(&node)
            && !model.origins.contains(&image)
        {
            model.origins.insert(image, origin);
        }
    }
    visit(model, &mut |node| {
        if let Ok(index) = cone.binary_search(node) {
            *node = images[index];
        }
    });
}

/// Calls a function with every quantity that may depend on coordinates. What contacts are written through
/// serves lowering alone and stays.
fn visit(model: &mut Model, each: &mut dyn FnMut(&mut NodeId)) {
    // The fields are listed, so that a new field of the model does not compile until it is handled here.
    let Model {
        graph: _,
        coordinates: _,
        orientations: _,
        turning: _,
        inputs: _,
        parameters: _,
        lengths: _,
        meanings: _,
        readings,
        // Velocities are functions of all declared coordinates.
        velocities: _,
        points,
        bodies,
        kinetic,
        potential,
        lagrangian,
        dissipation,
        forces,
        constraints,
        at_times: _,
        contacts,
        loads,
        events,
        places,
        levers,
        eliminations: _,
        eliminated,
        sensitivities: _,
        baumgarte: _,
        hints: _,
        origins: _,
        locals: _,
    } = model;
    for reading in readings {
        reading.nodes.iter_mut().chain(&mut reading.sizes).for_each(&mut *each);
    }
    for point in points {
        point.position.iter_mut().for_each(&mut *each);
    }
    for body in bodies {
        body.position.iter_mut().for_each(&mut *each);
        match &mut body.attitude {
            Attitude::Planar { angle, inertia: _ } => each(angle),
            Attitude::Spatial { rotation: turn, inertia: _ } => rotation(turn, each),
        }
    }
    for term in [kinetic, potential, lagrangian, dissipation, events].into_iter().flatten() {
        each(&mut term.value);
    }
    for force in forces {
        match &mut force.action {
            Action::Generalized(entries) => entries.iter_mut().for_each(|(_, load)| each(load)),
            Action::AtPosition { position, force } => {
                position.iter_mut().chain(force).for_each(&mut *each);
            }
            Action::PlanarTorque { angle, torque } => {
                each(angle);
                each(torque);
            }
            Action::Along(loads) => {
                for (velocity, load) in loads {
                    each(velocity);
                    each(load);
                }
            }
            Action::SpatialTorque { rotation: turn, torque } => {
                rotation(turn, each);
                torque.iter_mut().for_each(&mut *each);
            }
        }
    }
    for Contact { constraint, law } in contacts {
        each(&mut constraint.value);
        match law {
            Law::Unilateral { restitution, poisson: _ } => each(restitution),
            Law::Friction { kinetic, fixed, normal: _, pair: _ } => {
                each(kinetic);
                each(fixed);
            }
        }
    }
    for (_, factor) in loads.iter_mut().flat_map(|load| &mut load.force).flatten() {
        each(factor);
    }
    for constraint in constraints {
        each(&mut constraint.value);
        constraint.through.iter_mut().for_each(&mut *each);
    }
    for place in places {
        place.position.iter_mut().for_each(&mut *each);
    }
    for mut lever in levers.take() {
        let Lever { place, base, rotation: turn, arm } = &mut lever;
        place.iter_mut().chain(base).chain(arm).for_each(&mut *each);
        rotation(turn, each);
        levers.insert(lever);
    }
    for Eliminated { quantity: _, declared_index: _, position, velocity } in eliminated {
        each(position);
        each(velocity);
    }
}

fn rotation(turn: &mut Rotation, each: &mut dyn FnMut(&mut NodeId)) {
    turn.matrix.as_flattened_mut().iter_mut().for_each(&mut *each);
    match &mut turn.form {
        RotationForm::Axis { axis, angle } => {
            axis.iter_mut().for_each(&mut *each);
            each(angle);
        }
        RotationForm::Quaternion(parts) => parts.iter_mut().for_each(&mut *each),
        RotationForm::Product(left, right) => {
            rotation(left, each);
            rotation(right, each);
        }
        RotationForm::Inverse(inner) => rotation(inner, each),
        RotationForm::Turning(rate) => rate.iter_mut().for_each(each),
        RotationForm::Entries => {}
    }
}
