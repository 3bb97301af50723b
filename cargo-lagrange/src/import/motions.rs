//! The coordinates that joints move by.

use super::names::{Names, alone, snake};
use super::report::Sink;
use super::robot::{Joint, Kind, Mimic, Robot};
use super::tree::Tree;
use super::{Following, Options};

/// A declared coordinate.
#[derive(Clone, Debug)]
pub struct Coordinate {
    /// The identifier.
    pub name: String,
    /// The kind of the coordinate.
    pub shape: Shape,
}

/// The kind of a declared coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A number.
    Number,
    /// An orientation.
    Rotation,
    /// A place and an orientation.
    Pose,
}

impl Shape {
    /// How many degrees of freedom it has.
    pub fn freedom(self) -> usize {
        match self {
            Shape::Number => 1,
            Shape::Rotation => 3,
            Shape::Pose => 6,
        }
    }
}

/// The coordinates of a joint.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Coordinates of its own.
    Own(Vec<usize>),
    /// multiplier · q + offset of the coordinate of another joint.
    Follows {
        /// The coordinate.
        of: usize,
        /// The factor.
        multiplier: f64,
        /// The value where the coordinate is zero.
        offset: f64,
    },
}

/// The coordinates of a robot, and how they move each joint.
pub fn motions(
    robot: &Robot,
    tree: &Tree,
    options: &Options,
    names: &mut Names,
    sink: &mut Sink,
) -> Option<(Vec<Coordinate>, Vec<Motion>)> {
    let mut coordinates = Vec::new();
    let mut motions = vec![Motion::Own(Vec::new()); robot.joints.len()];
    let follows = |joint: &Joint| joint.mimic.filter(|_| options.mimic == Following::Eliminate);
    for &index in &tree.order {
        let joint = &robot.joints[index];
        if follows(joint).is_some() {
            continue;
        }
        let is_base = joint.name.is_empty();
        let whole = if is_base { "base".to_owned() } else { snake(&joint.name) };
        let prefix = if is_base { String::new() } else { format!("{whole}_") };
        let (parts, shape): (&[&str], Shape) = match (joint.kind, options.euler) {
            (Kind::Fixed, _) => (&[], Shape::Number),
            (Kind::Turns(_) | Kind::Slides(_), _) => (&[""], Shape::Number),
            (Kind::Planar(_), _) => (&["x", "y", "angle"], Shape::Number),
            (Kind::Ball, false) => (&[""], Shape::Rotation),
            (Kind::Free, false) => (&[""], Shape::Pose),
            (Kind::Ball, true) => (&["roll", "pitch", "yaw"], Shape::Number),
            (Kind::Free, true) => (&["x", "y", "z", "roll", "pitch", "yaw"], Shape::Number),
        };
        let mut own = Vec::new();
        for part in parts {
            let wanted = if part.is_empty() { whole.clone() } else { format!("{prefix}{part}") };
            own.push(coordinates.len());
            coordinates.push(Coordinate { name: names.take(&joint.name, &alone(wanted), sink), shape });
        }
        motions[index] = Motion::Own(own);
    }
    for (index, joint) in robot.joints.iter().enumerate() {
        let Some(mut mimic) = follows(joint) else { continue };
        let mut steps = 0;
        while let Some(next) = robot.joints[mimic.of].mimic {
            let Mimic { of, multiplier, offset } = next;
            mimic.offset += mimic.multiplier * offset;
            mimic.multiplier *= multiplier;
            mimic.of = of;
            steps += 1;
            if steps > robot.joints.len() {
                sink.problem(&joint.mark, "it follows itself; untie one joint of this circle");
                return None;
            }
        }
        if let Motion::Own(own) = &motions[mimic.of] {
            motions[index] =
                Motion::Follows { of: own[0], multiplier: mimic.multiplier, offset: mimic.offset };
        }
    }
    Some((coordinates, motions))
}
