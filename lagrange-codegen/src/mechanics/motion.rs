//! Velocities and velocity-dependent accelerations of particles and bodies.

use super::axes::{InAxes, in_axes};
use crate::calculus::pushforward;
use crate::expr::{NodeId, Variable};
use crate::kinematics::{body_rate, turning_direction};
use crate::model::{Attitude, Model};

/// Kinematics of a model at a = 0, with the nodes of its variables.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    /// Nodes of the coordinates.
    pub q: Vec<NodeId>,
    /// Nodes of the velocities.
    pub v: Vec<NodeId>,
    /// The direction of total time derivatives at a = 0.
    pub direction: Vec<(NodeId, NodeId)>,
    /// Orientations whose matrices and angular velocities are variables.
    pub turning: Vec<usize>,
    /// What moves in straight lines: particles, centres of mass, and planar angles.
    pub translations: Vec<Translation>,
    /// Spatial rotations.
    pub rotations: Vec<Turning>,
}

/// Quantities r(q, t) with inertia m: T = ½ m ṙ·ṙ.
#[derive(Clone, Debug)]
pub(super) struct Translation {
    /// Mass, or moment of inertia for an angle.
    pub mass: NodeId,
    /// r; of one that an orientation carries, nothing.
    pub position: Option<Vec<NodeId>>,
    /// ṙ, in the axes of the orientation that carries it.
    pub velocity: Vec<NodeId>,
    /// r̈ at a = 0, in the same axes.
    pub acceleration: Vec<NodeId>,
}

/// A body that turns in space: T = ½ ω·I ω, in body axes.
#[derive(Clone, Debug)]
pub(super) struct Turning {
    /// I.
    pub inertia: [[NodeId; 3]; 3],
    /// ω.
    pub rate: [NodeId; 3],
    /// ω̇ at a = 0.
    pub acceleration: [NodeId; 3],
}

impl Motion {
    /// Differentiates every position and attitude twice.
    pub fn of(model: &mut Model) -> Motion {
        let count = model.coordinates.len();
        let graph = &mut model.graph;
        let direction = turning_direction(graph, count, &model.turning, Variable::Spin);
        let q: Vec<_> = direction[..count].iter().map(|&(q, _)| q).collect();
        let v: Vec<_> = direction[..count].iter().map(|&(_, v)| v).collect();

        let mut moving: Vec<(NodeId, Vec<NodeId>, String)> = Vec::new();
        for point in &model.points {
            moving.push((point.mass, point.position.clone(), point.name.clone()));
        }
        let mut turning = Vec::new();
        for body in &model.bodies {
            moving.push((body.mass, body.position.clone(), body.name.clone()));
            match &body.attitude {
                Attitude::Planar { angle, inertia } => {
                    moving.push((*inertia, vec![*angle], body.name.clone()))
                }
                Attitude::Spatial { rotation, inertia } => {
                    turning.push((rotation.clone(), *inertia, body.name.clone()))
                }
            }
        }

        let carried: Vec<Option<InAxes>> =
            moving.iter().map(|(_, position, _)| in_axes(graph, position, &model.turning)).collect();
        for ((_, position, _), carried) in moving.iter_mut().zip(&carried) {
            if let Some(InAxes { arm, .. }) = carried {
                *position = arm.to_vec();
            }
        }

        // One forward sweep for all positions, so that shared parts are differentiated once.
        let all: Vec<NodeId> = moving.iter().flat_map(|(_, position, _)| position.iter().copied()).collect();
        let velocities = pushforward(graph, &all, &direction);
        let accelerations = pushforward(graph, &velocities, &direction);
        let mut offset = 0;
        let mut translations = Vec::with_capacity(moving.len());
        for ((mass, position, _), carried) in moving.into_iter().zip(carried) {
            let range = offset..offset + position.len();
            offset = range.end;
            let (velocity, acceleration) =
                (velocities[range.clone()].to_vec(), accelerations[range].to_vec());
            translations.push(match carried {
                None => Translation { mass, velocity, acceleration, position: Some(position) },
                Some(carried) => {
                    let (velocity, acceleration) = carried.motion(graph, &direction, &velocity);
                    Translation { mass, velocity, acceleration, position: None }
                }
            });
        }

        let mut rotations = Vec::with_capacity(turning.len());
        for (rotation, inertia, name) in turning {
            let rate = body_rate(graph, &rotation, &direction);
            let acceleration = pushforward(graph, &rate, &direction);
            for (component, axis) in rate.iter().zip(["x", "y", "z"]) {
                model.hints.suggest(*component, format!("{name}_rate_{axis}"));
            }
            rotations.push(Turning {
                inertia,
                rate,
                acceleration: [acceleration[0], acceleration[1], acceleration[2]],
            });
        }
        Motion { q, v, direction, turning: model.turning.clone(), translations, rotations }
    }
}
