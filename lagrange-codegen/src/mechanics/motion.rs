//! Velocities and velocity-dependent accelerations of particles and bodies.

use super::frames::Frames;
use crate::calculus::pushforward;
use crate::expr::{Graph, NodeId};
use crate::kinematics::{body_rate, turning_direction};
use crate::model::{Attitude, Body, Model, Point, Rotation};

/// The axes of the components of velocities of what rotations carry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axes {
    /// Space axes.
    Space,
    /// The axes of the carrying rotation.
    Own,
}

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
    /// Quantities whose inertia is one number: positions of particles, centres of mass, and planar angles.
    pub translations: Vec<Translation>,
    /// Spatial rotations.
    pub rotations: Vec<Turning>,
    /// The places that rotations carry, with velocities in these rotations' axes; none in space axes.
    pub carried: Vec<Carried>,
}

/// Quantities r(q, t) with inertia m: T = ½ m ṙ·ṙ.
#[derive(Clone, Debug)]
pub(super) struct Translation {
    /// Mass, or moment of inertia for an angle.
    pub mass: NodeId,
    /// r, if the components below are in space axes.
    pub position: Option<Vec<NodeId>>,
    /// ṙ.
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

/// A place that a rotation carries.
#[derive(Clone, Debug)]
pub(super) struct Carried {
    /// The place, in space axes.
    pub place: [NodeId; 3],
    /// The rotation.
    pub matrix: [[NodeId; 3]; 3],
    /// Its velocity in the axes of the rotation.
    pub velocity: [NodeId; 3],
}

impl Motion {
    /// Whether a rotation carries anything that has inertia.
    pub fn is_carried(model: &Model) -> bool {
        let spatial = |body: &Body| matches!(body.attitude, Attitude::Spatial { .. });
        let carried = |point: &Point| model.levers.carrying(&point.position).is_some();
        model.bodies.iter().any(spatial) || model.points.iter().any(carried)
    }

    /// Differentiates every position and attitude twice.
    pub fn of(model: &mut Model, axes: Axes) -> Motion {
        let count = model.coordinates.len();
        let Model { graph, hints, levers, points, bodies, turning: orientations, .. } = model;
        let direction = turning_direction(graph, count, orientations);
        let q: Vec<_> = direction[..count].iter().map(|&(q, _)| q).collect();
        let v: Vec<_> = direction[..count].iter().map(|&(_, v)| v).collect();

        let mut frames = Frames::new(levers, &direction);
        let mut translations = Vec::new();
        let mut moving: Vec<(NodeId, Vec<NodeId>)> = Vec::new();
        let mut turning = Vec::new();
        for point in points {
            match levers.carrying(&point.position) {
                Some(lever) if axes == Axes::Own => {
                    translations.push(Translation::carried(
                        graph,
                        &mut frames,
                        point.mass,
                        &lever.rotation,
                        &lever.place,
                    ));
                }
                _ => moving.push((point.mass, point.position.clone())),
            }
        }
        for body in bodies {
            let place = <[NodeId; 3]>::try_from(body.position.as_slice());
            match (&body.attitude, place) {
                (Attitude::Spatial { rotation, .. }, Ok(place)) if axes == Axes::Own => {
                    translations.push(Translation::carried(graph, &mut frames, body.mass, rotation, &place));
                }
                _ => moving.push((body.mass, body.position.clone())),
            }
            match &body.attitude {
                Attitude::Planar { angle, inertia } => moving.push((*inertia, vec![*angle])),
                Attitude::Spatial { rotation, inertia } => turning.push((rotation, *inertia, &body.name)),
            }
        }

        // One forward sweep for all positions differentiates shared parts once.
        let all: Vec<NodeId> = moving.iter().flat_map(|(_, position)| position.iter().copied()).collect();
        let velocities = pushforward(graph, &all, &direction);
        let accelerations = pushforward(graph, &velocities, &direction);
        let mut offset = 0;
        for (mass, position) in moving {
            let range = offset..offset + position.len();
            offset = range.end;
            let (velocity, acceleration) =
                (velocities[range.clone()].to_vec(), accelerations[range].to_vec());
            translations.push(Translation { mass, position: Some(position), velocity, acceleration });
        }

        let mut rotations = Vec::with_capacity(turning.len());
        for (rotation, inertia, name) in turning {
            let (rate, acceleration) = match axes {
                Axes::Own => {
                    let spin = frames.spin(graph, rotation);
                    (spin.rate, spin.change)
                }
                Axes::Space => {
                    let rate = body_rate(graph, rotation, &direction);
                    let change = pushforward(graph, &rate, &direction);
                    (rate, [change[0], change[1], change[2]])
                }
            };
            for (component, axis) in rate.iter().zip(["x", "y", "z"]) {
                hints.suggest(*component, format!("{name}_rate_{axis}"));
            }
            rotations.push(Turning { inertia, rate, acceleration });
        }
        let mut carried = Vec::new();
        if axes == Axes::Own {
            for lever in levers.iter() {
                let motion = frames.motion(graph, &lever.rotation, &lever.place);
                let (place, matrix) = (lever.place, lever.rotation.matrix);
                carried.push(Carried { place, matrix, velocity: motion.velocity });
            }
        }
        let turning = orientations.clone();
        Motion { q, v, direction, turning, translations, rotations, carried }
    }
}

impl Translation {
    /// The motion of a place in the axes of a rotation.
    fn carried(
        graph: &mut Graph,
        frames: &mut Frames<'_>,
        mass: NodeId,
        rotation: &Rotation,
        place: &[NodeId; 3],
    ) -> Translation {
        let motion = frames.motion(graph, rotation, place);
        Translation {
            mass,
            position: None,
            velocity: motion.velocity.to_vec(),
            acceleration: motion.acceleration.to_vec(),
        }
    }
}
