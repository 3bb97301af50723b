//! Applied forces: given forces by virtual power, and Rayleigh dissipation −∂D/∂v.

use super::equations::Loads;
use super::motion::Motion;
use crate::kinematics::{body_rate, transposed_times};
use crate::model::{Action, Model};
use crate::number::Number;

/// The seeds of all applied forces.
pub(super) fn loads(model: &mut Model, motion: &Motion) -> Loads {
    let mut loads = Loads::default();
    let graph = &mut model.graph;
    for force in &model.forces {
        match &force.action {
            Action::Generalized(entries) => loads.direct.extend(entries.iter().copied()),
            Action::AtPosition { position, force } => {
                loads.through_q.extend(position.iter().copied().zip(force.iter().copied()));
            }
            Action::PlanarTorque { angle, torque } => loads.through_q.push((*angle, *torque)),
            Action::Along(along) => loads.through_v.extend(along.iter().copied()),
            Action::SpatialTorque { rotation, torque } => {
                // The torque is turned into body axes, where the angular velocity is known.
                let rate = body_rate(graph, rotation, &motion.direction);
                let torque = transposed_times(graph, &rotation.matrix, torque);
                loads.through_v.extend(rate.into_iter().zip(torque));
            }
        }
    }
    let minus_one = graph.constant(Number::MINUS_ONE);
    for term in &model.dissipation {
        loads.through_v.push((term.value, minus_one));
    }
    loads
}
