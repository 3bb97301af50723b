//! A random mechanical system: coordinates, inputs, helper functions and roles.

use std::ops::Range;

use crate::constraint::{Kind, Rows};
use crate::expression::{Body, Expr, Vector};

/// A mechanical system as the generator makes it.
#[derive(Clone, Debug)]
pub struct System {
    pub scalar: Scalar,
    pub coordinates: Vec<Group>,
    pub inputs: Vec<Group>,
    /// Functions of (q, t, x, y) without a role; at least one.
    pub helpers: Vec<Body<Expr>>,
    pub roles: Vec<Role>,
    /// The rate at which constraints are stabilised instead of projected onto.
    pub baumgarte: Option<Expr>,
}

/// The type that the description is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    F64,
    F32,
    /// A type parameter `R: Real`.
    Generic,
}

/// A declared coordinate or input.
#[derive(Clone, Debug)]
pub struct Group {
    pub name: &'static str,
    /// The length of an array.
    pub length: Option<usize>,
}

impl Group {
    /// How many scalars this is.
    pub fn count(&self) -> usize {
        self.length.unwrap_or(1)
    }
}

/// A function of the impl block that means something.
#[derive(Clone, Debug)]
pub enum Role {
    Point {
        dimension: usize,
        mass: Expr,
        position: Body<Vector>,
    },
    Planar {
        mass: Expr,
        inertia: Expr,
        pose: Body<(Vector, Expr)>,
        form: Form,
    },
    Spatial {
        mass: Expr,
        inertia: Inertia,
        pose: Body<(Vector, Rotation)>,
        form: Form,
    },
    /// Particles at the joints of a chain in the plane, returned as an array.
    Chain {
        which: usize,
        relative: bool,
        mass: Expr,
        length: Expr,
    },
    Energy(Energy, Body<Expr>),
    /// A generalized force on one coordinate.
    ForceOn(usize, Body<Expr>),
    /// A generalized force on every coordinate.
    ForceOnAll(Body<Vec<Expr>>),
    /// A Cartesian force at a place.
    ForceAt(usize, Body<Vector>),
    /// A force and a torque on a body; in the plane the torque is the first component.
    Wrench(usize, Body<(Vector, Vector)>),
    /// A function that stays zero. The number picks a name.
    Constraint(Kind, usize, Body<Rows>),
}

/// How a pose is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Isometry,
    Tuple,
}

/// The roles that return a scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Energy {
    Kinetic,
    Potential,
    Lagrangian,
    Dissipation,
}

/// Moments of inertia, with one product of inertia where the axes are not principal.
#[derive(Clone, Debug)]
pub struct Inertia {
    pub moments: [Expr; 3],
    pub product: Option<Expr>,
}

/// A rotation in space.
#[derive(Clone, Debug)]
pub enum Rotation {
    /// About x, y or z.
    Axis(usize, Expr),
    /// About the unit vector [`TILTED`].
    Tilted(Expr),
    /// Roll, pitch, yaw.
    Euler(Box<[Expr; 3]>),
    Product(Box<Rotation>, Box<Rotation>),
    Inverse(Box<Rotation>),
    /// A rotation given to the engine by its nine entries alone.
    Entries(Box<Rotation>),
}

/// The axis of [`Rotation::Tilted`].
pub const TILTED: [f64; 3] = [0.6, 0.0, 0.8];

/// A particle or body: the role and the index within its array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    pub role: usize,
    pub index: usize,
}

impl System {
    /// The number of scalar coordinates.
    pub fn count(&self) -> usize {
        self.coordinates.iter().map(Group::count).sum()
    }

    /// The number of scalar inputs.
    pub fn input_count(&self) -> usize {
        self.inputs.iter().map(Group::count).sum()
    }

    /// The array of coordinates that a loop runs over, or all coordinates where no array is.
    pub fn looped(&self, which: usize) -> (Option<&Group>, Range<usize>) {
        let mut arrays = Vec::new();
        let mut start = 0;
        for group in &self.coordinates {
            if group.length.is_some() {
                arrays.push((Some(group), start..start + group.count()));
            }
            start += group.count();
        }
        if arrays.is_empty() { (None, 0..start) } else { arrays.swap_remove(which % arrays.len()) }
    }

    /// The dimension of the positions that a role gives, and their number.
    fn extent(&self, role: usize) -> Option<(usize, usize)> {
        match &self.roles[role] {
            Role::Point { dimension, .. } => Some((*dimension, 1)),
            Role::Planar { .. } => Some((2, 1)),
            Role::Spatial { .. } => Some((3, 1)),
            Role::Chain { which, .. } => Some((2, self.looped(*which).1.len())),
            Role::Energy(..)
            | Role::ForceOn(..)
            | Role::ForceOnAll(_)
            | Role::ForceAt(..)
            | Role::Wrench(..)
            | Role::Constraint(..) => None,
        }
    }

    /// All particles and bodies that are declared, each with its dimension.
    pub fn all_places(&self) -> Vec<(Place, usize)> {
        self.places(usize::MAX, |_| true)
    }

    fn places(&self, visible: usize, fits: impl Fn(usize) -> bool) -> Vec<(Place, usize)> {
        let mut places = Vec::new();
        for role in 0..visible.min(self.roles.len()) {
            if let Some((dimension, count)) = self.extent(role).filter(|_| fits(role)) {
                places.extend((0..count).map(|index| (Place { role, index }, dimension)));
            }
        }
        places
    }

    /// One of the places of a dimension that are declared before a role.
    pub fn place(&self, which: usize, dimension: usize, visible: usize) -> Option<Place> {
        let mut places = self.places(visible, |_| true);
        places.retain(|&(_, d)| d == dimension);
        (!places.is_empty()).then(|| places[which % places.len()].0)
    }

    /// One of all places, with its dimension.
    pub fn any_place(&self, which: usize) -> Option<(Place, usize)> {
        let places = self.all_places();
        (!places.is_empty()).then(|| places[which % places.len()])
    }

    /// One of all bodies, with its dimension.
    pub fn any_body(&self, which: usize) -> Option<(Place, usize)> {
        let is_body = |role: usize| matches!(self.roles[role], Role::Planar { .. } | Role::Spatial { .. });
        let bodies = self.places(usize::MAX, is_body);
        (!bodies.is_empty()).then(|| bodies[which % bodies.len()])
    }

    /// Whether there are applied forces or dissipation.
    pub fn is_driven(&self) -> bool {
        self.roles.iter().any(|role| match role {
            Role::Point { .. }
            | Role::Planar { .. }
            | Role::Spatial { .. }
            | Role::Chain { .. }
            | Role::Constraint(..) => false,
            Role::Energy(energy, _) => *energy == Energy::Dissipation,
            Role::ForceOn(..) | Role::ForceOnAll(_) | Role::ForceAt(..) | Role::Wrench(..) => true,
        })
    }
}
