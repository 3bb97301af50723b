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
) -> (Vec<Coordinate>, Vec<Motion>) {
    let mut coordinates = Vec::new();
    let mut motions = vec![Motion::Own(Vec::new()); robot.joints.len()];
    let follows = |joint: &Joint| -> Option<(usize, f64, f64)> {
        let Mimic { of, multiplier, offset, .. } = joint.mimics.first()?;
        of.filter(|_| options.mimic == Following::Eliminate).map(|of| (of, *multiplier, *offset))
    };
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
        let Some((mut of, mut multiplier, mut offset)) = follows(joint) else { continue };
        // There are no circles: `ties` refuses them.
        while let Some(next) = follows(&robot.joints[of]) {
            offset += multiplier * next.2;
            multiplier *= next.1;
            of = next.0;
        }
        if let Motion::Own(own) = &motions[of] {
            motions[index] = Motion::Follows { of: own[0], multiplier, offset };
        }
    }
    (coordinates, motions)
}
