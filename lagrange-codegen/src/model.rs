//! The mechanical system as graph nodes, made by lowering for mechanics.
//!
//! Names, shapes, loops and helper calls are resolved, and every quantity is a scalar node. Contributions of
//! several functions to one role are kept apart until mechanics adds them.

mod constraints;
mod levers;
pub mod orientation;
mod velocities;

use crate::collections::Lookup;
use crate::diagnostics::Origin;
use crate::expr::{Graph, NodeId};
pub use constraints::{
    Constraint, ConstraintKind, Contact, Eliminated, Elimination, Law, Load, Normal, Place, component_of_one,
};
pub use levers::{Lever, Levers};
pub use velocities::{Rates, Spin, Twist, Velocity};

/// A lowered description.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// The graph that all nodes below belong to.
    pub graph: Graph,
    /// Generalized coordinates without eliminated ones, arrays flattened, in declaration order.
    pub coordinates: Vec<Quantity>,
    /// The first of the three coordinates of each orientation.
    pub orientations: Vec<usize>,
    /// The same while matrices and angular velocities of orientations are variables, until
    /// [`crate::eliminate::in_parameters`] replaces them.
    pub turning: Vec<usize>,
    /// Inputs, arrays flattened, in declaration order.
    pub inputs: Vec<Quantity>,
    /// Parameters in order of their first use: `Variable::Parameter(i)` is the i-th.
    pub parameters: Vec<Parameter>,
    /// Arrays among the parameters whose length is inferred from their context.
    pub lengths: Vec<Length>,
    /// The meanings that the macro has assumed for names in the description.
    pub meanings: Vec<Meaning>,
    /// The values that the interpreter found for functions with a role and for arguments of roles.
    pub readings: Vec<Reading>,
    /// Velocities that the description uses.
    pub velocities: Vec<Velocity>,
    /// Particles.
    pub points: Vec<Point>,
    /// Rigid bodies.
    pub bodies: Vec<Body>,
    /// Kinetic energies T(q, v, t).
    pub kinetic: Vec<Term>,
    /// Potential energies V(q, t).
    pub potential: Vec<Term>,
    /// Lagrangians L(q, v, t).
    pub lagrangian: Vec<Term>,
    /// Rayleigh dissipation functions D(q, v, t).
    pub dissipation: Vec<Term>,
    /// Forces.
    pub forces: Vec<Force>,
    /// Constraints, arrays flattened, in the order of declaration.
    pub constraints: Vec<Constraint>,
    /// The constraints, at the end of the list, that hold at times only: for each the row whose reaction
    /// limits it, if it is a friction of one.
    pub at_times: Vec<Option<usize>>,
    /// Gaps and slip velocities, in the order of declaration, gaps first: rows that are constraints at times.
    pub contacts: Vec<Contact>,
    /// Loads: reactions whose common size limits friction.
    pub loads: Vec<Load>,
    /// Functions whose zeros are events.
    pub events: Vec<Term>,
    /// Particles and bodies in the order of declaration, as places where constraint forces act; empty without
    /// constraints and contacts.
    pub places: Vec<Place>,
    /// The levers by which rotations carry places.
    pub levers: Levers,
    /// Constraints that a coordinate is to be eliminated by, in the order of declaration.
    pub eliminations: Vec<Elimination>,
    /// Coordinates that constraints have eliminated, in declaration order.
    pub eliminated: Vec<Eliminated>,
    /// Parameters by which derivatives are taken, as indices into `parameters`.
    pub sensitivities: Vec<u32>,
    /// The rate of Baumgarte's stabilisation \[1/s\], if the description asks for it.
    pub baumgarte: Option<NodeId>,
    /// Names that the user gave to intermediate results.
    pub hints: Hints,
    /// The origin of the first expression that made each node.
    pub origins: Lookup<NodeId, Origin>,
    /// Names of the variables in emitted bodies, chosen when emission starts.
    pub locals: Locals,
}

impl Model {
    /// The origin of the first of some nodes that a constraint's own function wrote, or else of the
    /// function's name. An earlier function that wrote the same node would be the wrong place.
    pub fn origin_in(&self, constraint: &Constraint, nodes: &[NodeId]) -> Origin {
        let mut origins = nodes.iter().filter_map(|node| self.origins.get(node).copied());
        origins.find(|&origin| origin > constraint.origin).unwrap_or(constraint.origin)
    }
}

/// Names of the local variables in emitted bodies, by kind and index.
#[derive(Clone, Debug, Default)]
pub struct Locals {
    /// Names of the coordinates.
    pub coordinates: Vec<String>,
    /// Names of the velocities.
    pub velocities: Vec<String>,
    /// Names of the accelerations, for bodies that take them.
    pub accelerations: Vec<String>,
    /// Names of the inputs.
    pub inputs: Vec<String>,
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// Names of the entries of the matrices of orientations.
    pub entries: Vec<String>,
    /// Names of the auxiliaries of a Taylor expansion.
    pub auxiliaries: Vec<String>,
    /// Names of the multipliers.
    pub multipliers: Vec<String>,
    /// The fewest alike values that stand in an array and are computed by a loop.
    pub least: usize,
}

/// A scalar coordinate or input.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// The declared name.
    pub name: String,
    /// The index within an array.
    pub index: Option<usize>,
    /// The origin of its declaration.
    pub origin: Origin,
}

impl Quantity {
    /// As the user writes it: `theta` or `theta[0]`.
    pub fn written(&self) -> String {
        written(&self.name, self.index)
    }

    /// A name for a local variable: `theta` or `theta_0`.
    pub fn label(&self) -> String {
        label(&self.name, self.index)
    }
}

fn written(name: &str, index: Option<usize>) -> String {
    index.map_or_else(|| name.to_owned(), |index| format!("{name}[{index}]"))
}

fn label(name: &str, index: Option<usize>) -> String {
    index.map_or_else(|| name.to_owned(), |index| format!("{name}_{index}"))
}

/// A parameter: an expression that the emitted code evaluates as it stands.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Parameter {
    /// Rust text, such as `self.m[0]` or `crate::G`.
    pub path: String,
    /// A name for a local variable, such as `m_0`.
    pub label: String,
    /// The origin of its first use.
    pub origin: Origin,
}

/// A parameter array that must have a certain length.
#[derive(Clone, Debug)]
pub struct Length {
    /// Rust text, such as `self.k`.
    pub path: String,
    /// The number of its elements.
    pub length: usize,
    /// The origin of its use.
    pub origin: Origin,
}

/// Rust that compiles only if a name has the assumed meaning.
#[derive(Clone, Debug)]
pub struct Meaning {
    /// A statement or an item.
    pub statement: String,
    /// The origin of the name.
    pub origin: Origin,
}

/// The value that the interpreter found for a function of the user, or for an argument of its role.
#[derive(Clone, Debug)]
pub struct Reading {
    /// Index of the function in the description.
    pub function: usize,
    /// The argument of its role, if the value is that of an argument.
    pub argument: Option<&'static str>,
    /// All numbers of its value, in the order of the runtime's `Numbers`.
    pub nodes: Vec<NodeId>,
    /// The sizes of these numbers in the user's own form, once elimination begins.
    pub sizes: Vec<NodeId>,
}

/// A particle.
#[derive(Clone, Debug)]
pub struct Point {
    /// The user's function, with the index if it returns an array: `joints[3]`.
    pub name: String,
    /// Mass \[kg\].
    pub mass: NodeId,
    /// Cartesian position \[m\], one to three components.
    pub position: Vec<NodeId>,
    /// The function's name in the source.
    pub origin: Origin,
}

/// A rigid body.
#[derive(Clone, Debug)]
pub struct Body {
    /// The user's function, with the index if it returns an array.
    pub name: String,
    /// Mass \[kg\].
    pub mass: NodeId,
    /// Position of the centre of mass \[m\], two or three components.
    pub position: Vec<NodeId>,
    /// Orientation and moments of inertia about the centre of mass \[kg m²\].
    pub attitude: Attitude,
    /// The function's name in the source.
    pub origin: Origin,
}

/// Orientation of a body with its inertia.
#[derive(Clone, Debug)]
pub enum Attitude {
    /// A planar body.
    Planar {
        /// Angle from the x axis \[rad\].
        angle: NodeId,
        /// Moment of inertia.
        inertia: NodeId,
    },
    /// A spatial body.
    Spatial {
        /// Rotation from body axes to space axes.
        rotation: Rotation,
        /// Symmetric inertia tensor in body axes.
        inertia: [[NodeId; 3]; 3],
    },
}

/// A rotation in space with its composition. The angular velocity of a product follows from those of its
/// factors, which spares differentiating nine entries.
#[derive(Clone, Debug)]
pub struct Rotation {
    /// Entries, row by row.
    pub matrix: [[NodeId; 3]; 3],
    /// The composition.
    pub form: RotationForm,
}

/// The composition of a rotation.
#[derive(Clone, Debug)]
pub enum RotationForm {
    /// About a unit axis (the same in body and space), which may move, by an angle.
    Axis {
        /// Unit vector.
        axis: [NodeId; 3],
        /// Angle \[rad\].
        angle: NodeId,
    },
    /// v ↦ q v q* / |q|² by a quaternion of any length: w, i, j, k.
    Quaternion([NodeId; 4]),
    /// The product of two rotations; the right one applies first.
    Product(Box<Rotation>, Box<Rotation>),
    /// The inverse.
    Inverse(Box<Rotation>),
    /// That of an orientation among the coordinates, with its angular velocity in body axes: see
    /// [`orientation`].
    Turning([NodeId; 3]),
    /// Known by its entries alone.
    Entries,
}

/// A scalar contribution of one user function.
#[derive(Clone, Debug)]
pub struct Term {
    /// The user's function.
    pub name: String,
    /// Its value.
    pub value: NodeId,
    /// The function's name in the source.
    pub origin: Origin,
}

/// A force given by one user function.
#[derive(Clone, Debug)]
pub struct Force {
    /// The user's function.
    pub name: String,
    /// The place or coordinates of the force.
    pub action: Action,
    /// The function's name in the source.
    pub origin: Origin,
}

/// How a force enters the equations.
#[derive(Clone, Debug)]
pub enum Action {
    /// Generalized forces, one for each listed coordinate.
    Generalized(Vec<(usize, NodeId)>),
    /// A Cartesian force at a position: Q = Fᵀ ∂r/∂q.
    AtPosition {
        /// The position.
        position: Vec<NodeId>,
        /// Components in space axes \[N\].
        force: Vec<NodeId>,
    },
    /// A torque on a planar body: Q = τ ∂φ/∂q.
    PlanarTorque {
        /// Angle of the body.
        angle: NodeId,
        /// Torque \[N m\].
        torque: NodeId,
    },
    /// A load along scalar velocities: Q = Σ load ∂w/∂v.
    Along(Vec<(NodeId, NodeId)>),
    /// A torque on a spatial body, in space axes: Q = τᵀ ∂ω/∂v.
    SpatialTorque {
        /// Orientation of the body.
        rotation: Rotation,
        /// Components in space axes \[N m\].
        torque: [NodeId; 3],
    },
}

/// Names of intermediate results. The first name of a node stays.
#[derive(Clone, Debug, Default)]
pub struct Hints {
    names: Lookup<NodeId, String>,
}

impl Hints {
    /// Suggests a name for a node.
    pub fn suggest(&mut self, node: NodeId, name: impl Into<String>) {
        if !self.names.contains(&node) {
            self.names.insert(node, name.into());
        }
    }

    /// The name of a node.
    pub fn name(&self, node: NodeId) -> Option<&str> {
        self.names.get(&node).map(String::as_str)
    }
}
