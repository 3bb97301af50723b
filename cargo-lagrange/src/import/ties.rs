//! Joints that are tied to others or to a value: which ties a description can have, and joints that stand
//! still.

use super::geometry::{Angle, Pose, Rotation, scaled};
use super::report::Sink;
use super::robot::{Action, Joint, Kind, Robot};
use super::{Following, Options};

/// Refuses ties that no description has. Joints that are tied to a value become fixed, unless ties are
/// constraints.
pub fn settle(robot: &mut Robot, options: &Options, sink: &mut Sink) -> Option<()> {
    if options.mimic == Following::Ignore {
        return Some(());
    }
    let is_tree = match options.mimic {
        Following::Eliminate => single(robot, sink) && no_circles(robot, sink),
        Following::Constrain | Following::Ignore => no_circles(robot, sink),
    };
    if is_tree && options.mimic == Following::Eliminate {
        let values: Vec<Option<f64>> = (0..robot.joints.len()).map(|joint| value(robot, joint)).collect();
        for (joint, value) in robot.joints.iter_mut().zip(values) {
            let Some(value) = value else { continue };
            sink.note(format!(
                "`{}` is tied to a value and stands still at {value}: motors, springs and friction in it have \
                 no effect",
                joint.name
            ));
            fix(joint, value, options.tolerance);
        }
    }
    is_tree.then_some(())
}

/// Without a coordinate of its own a joint is tied once: the second tie would be one between two others.
fn single(robot: &Robot, sink: &mut Sink) -> bool {
    let before = sink.problems.len();
    for joint in &robot.joints {
        let [first, others @ ..] = joint.mimics.as_slice() else { continue };
        for other in others {
            let text = format!(
                "`{}` is tied already, by {} at {}; remove one of them, let the other joint follow in one, \
                 `joint1` and `joint2` exchanged, or make both constraints with --mimic constrain",
                joint.name, first.mark.element, first.mark.position
            );
            sink.problem(&other.mark, text);
        }
    }
    sink.problems.len() == before
}

/// Ties in a circle say the same twice, or that nothing moves.
fn no_circles(robot: &Robot, sink: &mut Sink) -> bool {
    let before = sink.problems.len();
    // Joints that are tied to each other have the same group; the last one stands for all values.
    let value = robot.joints.len();
    let mut groups: Vec<usize> = (0..=value).collect();
    for (index, joint) in robot.joints.iter().enumerate() {
        for mimic in &joint.mimics {
            let [own, other] = [groups[index], groups[mimic.of.unwrap_or(value)]];
            if own != other {
                groups.iter_mut().filter(|group| **group == own).for_each(|group| *group = other);
                continue;
            }
            let to = mimic.of.map_or("a value".to_owned(), |of| format!("`{}`", robot.joints[of].name));
            let text = match mimic.of == Some(index) {
                true => "it follows itself; untie one joint of this circle".to_owned(),
                false => format!(
                    "`{}` is tied to {to} here and by other ties of the file; untie one joint of this circle",
                    joint.name
                ),
            };
            sink.problem(&mimic.mark, text);
        }
    }
    sink.problems.len() == before
}

/// The value that a joint is tied to, be it by joints that it follows.
fn value(robot: &Robot, joint: usize) -> Option<f64> {
    let (mut joint, mut multiplier, mut offset) = (joint, 1.0, 0.0);
    loop {
        let mimic = robot.joints[joint].mimics.first()?;
        offset += multiplier * mimic.offset;
        multiplier *= mimic.multiplier;
        match mimic.of {
            Some(of) => joint = of,
            None => return Some(offset + 0.0),
        }
    }
}

/// Takes the motion out of a joint, whose coordinate has a value.
fn fix(joint: &mut Joint, value: f64, tolerance: f64) {
    let way = value - joint.action.reference;
    let moved = match joint.kind {
        Kind::Turns(axis) => {
            Pose { turn: Rotation::about(axis, Angle::new(way, tolerance)), ..Pose::IDENTITY }
        }
        Kind::Slides(axis) => Pose { shift: scaled(way, axis), ..Pose::IDENTITY },
        // No others are tied.
        Kind::Fixed | Kind::Planar(_) | Kind::Ball | Kind::Free => Pose::IDENTITY,
    };
    let back = Pose { shift: joint.back, ..Pose::IDENTITY };
    joint.pose = joint.pose.compose(&moved).compose(&back);
    joint.kind = Kind::Fixed;
    joint.back = [0.0; 3];
    joint.action = Action::default();
    joint.mimics.clear();
    joint.drives.clear();
}
