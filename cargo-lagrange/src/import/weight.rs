//! Whether gravity does work: a potential that depends on no coordinate would be refused.

use super::geometry::{Angle, Pose, Rotation, Vector, add, cross, dot, scaled};
use super::motions::Motion;
use super::plan::Plan;
use super::robot::Kind;

/// Whether the weight of the bodies has a potential that changes with the coordinates.
pub fn does_work(plan: &Plan) -> bool {
    let samples = [[0.0; 3], [0.7, 0.3, 0.9], [-1.1, 0.8, 0.4], [0.5, -0.6, 1.3]];
    let coordinates = |[a, b, c]: [f64; 3]| -> Vec<Vec<f64>> {
        // Numbers without a pattern suffice: what is constant is constant for all of them.
        let spread = |i: usize| a + b * (i as f64 * 1.7 + c).sin();
        let all = plan.coordinates.iter().enumerate();
        all.map(|(i, one)| (0..one.shape.freedom()).map(|part| spread(6 * i + part)).collect()).collect()
    };
    let works: Vec<(f64, f64)> = samples.map(|sample| potential(plan, &coordinates(sample))).to_vec();
    let size = works.iter().map(|(_, size)| *size).fold(0.0, f64::max);
    let rounding = 64.0 * plan.robot.joints.len() as f64 * f64::EPSILON * size;
    works.iter().any(|(value, _)| (value - works[0].0).abs() > rounding)
}

/// Σ m g·r, and the sum of the sizes of what it consists of.
fn potential(plan: &Plan, coordinates: &[Vec<f64>]) -> (f64, f64) {
    let robot = &plan.robot;
    let mut poses = vec![Pose::IDENTITY; robot.links.len()];
    let mut reach = vec![0.0; robot.links.len()];
    for &index in &plan.tree.order {
        let joint = &robot.joints[index];
        let own: Vec<f64> = match &plan.motions[index] {
            Motion::Own(own) => own.iter().flat_map(|&own| coordinates[own].clone()).collect(),
            Motion::Follows { of, multiplier, offset } => vec![multiplier * coordinates[*of][0] + offset],
        };
        let moved = moved(joint.kind, &own, joint.action.reference);
        let back = Pose { shift: joint.back, turn: Rotation::IDENTITY };
        poses[joint.child] = poses[joint.parent].compose(&joint.pose).compose(&moved).compose(&back);
        let lengths = [joint.pose.shift, moved.shift, joint.back];
        let length: f64 = lengths.iter().flatten().map(|entry| entry.abs()).sum();
        reach[joint.child] = reach[joint.parent] + length;
    }
    let mut total = (0.0, 0.0);
    for body in &plan.bodies {
        let pose = &poses[body.link];
        let centre = add(pose.shift, pose.turn.turn(body.inertial.centre));
        let arm: f64 = body.inertial.centre.iter().map(|entry| entry.abs()).sum();
        total.0 += body.inertial.mass * dot(robot.gravity, centre);
        let gravity: f64 = robot.gravity.iter().map(|entry| entry.abs()).sum();
        total.1 += body.inertial.mass * gravity * (reach[body.link] + arm);
    }
    total
}

/// The pose that the numbers of a joint give. An orientation is three angles here: any three numbers that
/// turn will do.
fn moved(kind: Kind, own: &[f64], reference: f64) -> Pose {
    let turn = |axis: Vector, angle: f64| Rotation::about(axis, Angle::Radians(angle));
    match kind {
        Kind::Fixed => Pose::IDENTITY,
        Kind::Turns(axis) => Pose { shift: [0.0; 3], turn: turn(axis, own[0] - reference) },
        Kind::Slides(axis) => Pose { shift: scaled(own[0] - reference, axis), turn: Rotation::IDENTITY },
        Kind::Planar(axis) => {
            // The direction across the axis is arbitrary.
            let first = cross(axis, if axis[0].abs() < 0.7 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] });
            let shift = add(scaled(own[0], first), scaled(own[1], cross(axis, first)));
            Pose { shift, turn: turn(axis, own[2]) }
        }
        Kind::Ball => Pose { shift: [0.0; 3], turn: euler(own) },
        Kind::Free => Pose { shift: [own[0], own[1], own[2]], turn: euler(&own[3..]) },
    }
}

fn euler(angles: &[f64]) -> Rotation {
    Rotation::of_angles([angles[0], angles[1], angles[2]].map(Angle::Radians))
}
