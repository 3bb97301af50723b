//! Restrictions of a motion: constraints, contacts, and coordinates that constraints give.

use super::{Quantity, label, written};
use crate::diagnostics::Origin;
use crate::expr::NodeId;

/// A constraint given by one user function.
#[derive(Clone, Debug)]
pub struct Constraint {
    /// The user's function.
    pub name: String,
    /// The index within an array.
    pub index: Option<usize>,
    /// f(q, t) or g(q, v, t), which stays zero.
    pub value: NodeId,
    /// f as a function of the positions of places, where it is known; g if it uses the velocity of a place.
    pub through: Option<NodeId>,
    /// Whether it is one on coordinates or on velocities.
    pub kind: ConstraintKind,
    /// The function's name in the source.
    pub origin: Origin,
}

/// The variables of a constraint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConstraintKind {
    /// f(q, t) = 0.
    Holonomic,
    /// g(q, v, t) = 0.
    Nonholonomic {
        /// Not necessarily affine in v: Chetaev's rule.
        chetaev: bool,
    },
}

impl Constraint {
    /// As the user writes it: `rolling` or `rolling[0]`.
    pub fn written(&self) -> String {
        written(&self.name, self.index)
    }

    /// A name for a local variable: `rolling` or `rolling_0`.
    pub fn label(&self) -> String {
        label(&self.name, self.index)
    }
}

/// A row that is a constraint at times.
#[derive(Clone, Debug)]
pub struct Contact {
    /// The gap as a holonomic constraint, or the slip velocity as a nonholonomic one.
    pub constraint: Constraint,
    /// The conditions under which it holds, and its force otherwise.
    pub law: Law,
}

/// The law of a row that is a constraint at times.
#[derive(Clone, Debug)]
pub enum Law {
    /// The reaction only pushes.
    Unilateral {
        /// The coefficient of restitution.
        restitution: NodeId,
        /// Whether that is Poisson's, of impulses, instead of Newton's, of velocities.
        poisson: bool,
    },
    /// Dry friction.
    Friction {
        /// The coefficient while slipping, or the largest force itself.
        kinetic: NodeId,
        /// The same while sticking.
        fixed: NodeId,
        /// The reaction that the coefficients multiply.
        normal: Option<Normal>,
        /// The row of the other component of a slip in two directions, counted as in [`Normal::Row`].
        pair: Option<usize>,
    },
}

impl Law {
    /// The row whose reaction limits a friction, if it is a single one.
    pub fn normal(&self) -> Option<usize> {
        match *self {
            Self::Friction { normal: Some(Normal::Row(row)), .. } => Some(row),
            Self::Friction { .. } | Self::Unilateral { .. } => None,
        }
    }
}

/// The force that the coefficient of a friction multiplies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normal {
    /// The reaction of a row. Rows are all constraints, then all contacts.
    Row(usize),
    /// One of [`Model::loads`](super::Model::loads).
    Load(usize),
}

/// The size of the force that several constraints exert on one place.
#[derive(Clone, Debug)]
pub struct Load {
    /// The friction that it limits.
    pub friction: String,
    /// The components of the force. Each is a list of constraints, by their rows, with the component of the
    /// force that a unit multiplier exerts.
    pub force: Vec<Vec<(usize, NodeId)>>,
    /// The friction's name in the source.
    pub origin: Origin,
}

/// A particle or a body as a place where forces act.
#[derive(Clone, Debug)]
pub struct Place {
    /// The user's function.
    pub name: String,
    /// The index within an array.
    pub index: Option<usize>,
    /// Its position, or that of its centre of mass.
    pub position: Vec<NodeId>,
    /// The variables that stand for the components of the position in [`Constraint::through`].
    pub variables: Vec<NodeId>,
    /// The variables that stand for the components of its velocity in a constraint on velocities.
    pub rates: Vec<NodeId>,
    /// Whether it is a body, on which a constraint may also exert a torque.
    pub turns: bool,
    /// The function's name in the source.
    pub origin: Origin,
}

/// A holonomic constraint that is to give a coordinate as a function of the others and of time.
#[derive(Clone, Debug)]
pub struct Elimination {
    /// The constraint.
    pub constraint: Constraint,
    /// The coordinate, if the user names it.
    pub coordinate: Option<usize>,
    /// The origin of the request.
    pub origin: Origin,
}

/// A coordinate that a constraint has eliminated.
#[derive(Clone, Debug)]
pub struct Eliminated {
    /// As it was declared.
    pub quantity: Quantity,
    /// Its index among all declared coordinates.
    pub declared_index: usize,
    /// Its value, a function of the remaining coordinates and of time.
    pub position: NodeId,
    /// Its total time derivative.
    pub velocity: NodeId,
}

/// The variable of a component that is just this coordinate, if exactly one position has such a component.
pub fn component_of_one(places: &[Place], q: NodeId) -> Option<NodeId> {
    let mut found = places.iter().flat_map(|place| {
        place
            .position
            .iter()
            .zip(&place.variables)
            .filter(move |&(&x, _)| x == q)
            .map(|(_, &variable)| variable)
    });
    let first = found.next();
    first.filter(|_| found.next().is_none())
}
