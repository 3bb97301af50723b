//! A robot without its file format: links, joints between them, and what acts there.

use super::geometry::{Pose, Vector};
use super::inertia::Inertial;
use super::report::Mark;

/// A tree of links. Joints come in the order of the file.
#[derive(Debug)]
pub struct Robot {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// All links.
    pub links: Vec<Link>,
    /// All joints.
    pub joints: Vec<Joint>,
    /// The acceleration of free fall [m/s²].
    pub gravity: Vector,
}

/// A rigid part.
#[derive(Debug)]
pub struct Link {
    /// The name in the file.
    pub name: String,
    /// The element.
    pub mark: Mark,
    /// Mass and inertia; several where several parts of the file make one link.
    pub inertials: Vec<Inertial>,
    /// An inertia of it that no body has.
    pub doubtful: Option<Doubtful>,
}

/// An inertia that has a negative principal moment.
#[derive(Clone, Debug)]
pub struct Doubtful {
    /// Where it stands.
    pub mark: Mark,
    /// The least principal moment.
    pub moment: f64,
}

/// A connection of two links.
#[derive(Debug)]
pub struct Joint {
    /// The name in the file.
    pub name: String,
    /// The element.
    pub mark: Mark,
    /// The link that it stands on.
    pub parent: usize,
    /// The link that it moves.
    pub child: usize,
    /// Its frame in that of the parent.
    pub pose: Pose,
    /// The origin of the child's frame, seen from the moved frame of the joint.
    pub back: Vector,
    /// The kind of its motion.
    pub kind: Kind,
    /// The forces and inertias in it; none in fixed joints.
    pub action: Action,
    /// What its coordinate is tied to.
    pub mimics: Vec<Mimic>,
    /// The factors of the inputs that drive it, with the names of the actuators; empty for passive joints.
    pub drives: Vec<Drive>,
}

/// The kind of motion of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// It does not.
    Fixed,
    /// It turns about a unit axis.
    Turns(Vector),
    /// It slides along a unit axis.
    Slides(Vector),
    /// It slides across a unit axis and turns about it.
    Planar(Vector),
    /// It turns in all directions.
    Ball,
    /// It moves in all directions.
    Free,
}

/// The forces and inertias in a joint. Joints of several coordinates have damping and armature alone.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Action {
    /// Viscous damping [N·m·s/rad or N·s/m].
    pub damping: f64,
    /// The force of dry friction [N·m or N].
    pub friction: f64,
    /// The inertia of a rotor [kg·m² or kg].
    pub armature: f64,
    /// The stiffness of a spring [N·m/rad or N/m].
    pub stiffness: f64,
    /// Where the spring is relaxed.
    pub relaxed: f64,
    /// The value of the coordinate in the pose of the file.
    pub reference: f64,
    /// Lower and upper stop.
    pub limits: Option<[f64; 2]>,
}

/// q = multiplier · q of another joint + offset.
#[derive(Clone, Debug)]
pub struct Mimic {
    /// The element that says so.
    pub mark: Mark,
    /// The other joint; none where q is tied to a value.
    pub of: Option<usize>,
    /// The factor.
    pub multiplier: f64,
    /// The value where the other one is zero.
    pub offset: f64,
}

/// An actuator.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Its name, if it has one of its own.
    pub name: Option<String>,
    /// Force in the joint for a unit of the input.
    pub gear: f64,
    /// Its place among the actuators of the file.
    pub order: usize,
}

impl Mimic {
    /// A tie to another joint. A factor of zero ties to a value.
    pub fn new(mark: Mark, of: Option<usize>, multiplier: f64, offset: f64) -> Self {
        Mimic { mark, of: of.filter(|_| multiplier != 0.0), multiplier, offset }
    }
}

impl Kind {
    /// The number of its coordinates.
    pub fn freedom(self) -> usize {
        match self {
            Kind::Fixed => 0,
            Kind::Turns(_) | Kind::Slides(_) => 1,
            Kind::Planar(_) | Kind::Ball => 3,
            Kind::Free => 6,
        }
    }
}
