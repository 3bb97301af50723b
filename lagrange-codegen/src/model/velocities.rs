//! Velocities that a description uses, and their forms.

use crate::expr::NodeId;

/// A function of coordinates, velocities and time that the macro writes: the rate of a result of a user's
/// function. It is in terms of all declared coordinates.
#[derive(Clone, Debug)]
pub struct Velocity {
    /// Index of the user's function in the description.
    pub function: usize,
    /// Its own name.
    pub name: String,
    /// Its result.
    pub rates: Rates,
}

/// The rate of a value, in the value's own form.
#[derive(Clone, Debug)]
pub enum Rates {
    /// The rate of a number.
    Scalar(NodeId),
    /// The rates of a vector, a point, a translation or a matrix: rows, columns, and the entries row by row.
    Matrix(usize, usize, Vec<NodeId>),
    /// The twist of a pose.
    Twist(Twist),
    /// The rates of an array.
    Array(Vec<Rates>),
    /// The rates of a tuple.
    Tuple(Vec<Rates>),
}

/// Velocity of a body.
#[derive(Clone, Debug)]
pub struct Twist {
    /// Position of its reference point \[m\].
    pub position: Vec<NodeId>,
    /// Velocity of the reference point \[m/s\].
    pub velocity: Vec<NodeId>,
    /// The same in the axes of the body.
    pub velocity_in_body: Vec<NodeId>,
    /// Angular velocity \[rad/s\].
    pub spin: Spin,
}

/// Angular velocity.
#[derive(Clone, Debug)]
pub enum Spin {
    /// In the plane, counter-clockwise.
    Plane(NodeId),
    /// In space.
    Space {
        /// Components in space axes.
        in_space: [NodeId; 3],
        /// Components in body axes.
        in_body: [NodeId; 3],
    },
}

impl Twist {
    /// The dimension of the space that the body moves in.
    pub fn dimension(&self) -> usize {
        self.position.len()
    }

    /// Calls a function with every number, in the order of the fields of the runtime's struct.
    pub fn each(&mut self, visit: &mut dyn FnMut(&mut NodeId)) {
        let Twist { position, velocity, velocity_in_body, spin } = self;
        position.iter_mut().chain(velocity).chain(velocity_in_body).for_each(&mut *visit);
        match spin {
            Spin::Plane(rate) => visit(rate),
            Spin::Space { in_space, in_body } => in_space.iter_mut().chain(in_body).for_each(&mut *visit),
        }
    }

    /// All numbers in that order.
    pub fn nodes(&self) -> Vec<NodeId> {
        let mut nodes = Vec::new();
        self.clone().each(&mut |node| nodes.push(*node));
        nodes
    }
}

impl Rates {
    /// Replaces all numbers by others, in order.
    pub fn set(&mut self, nodes: &[NodeId]) {
        let mut nodes = nodes.iter();
        self.each(&mut |node| nodes.next().into_iter().for_each(|&new| *node = new));
    }

    fn each(&mut self, visit: &mut dyn FnMut(&mut NodeId)) {
        match self {
            Rates::Scalar(node) => visit(node),
            Rates::Matrix(_, _, entries) => entries.iter_mut().for_each(visit),
            Rates::Twist(twist) => twist.each(visit),
            Rates::Array(parts) | Rates::Tuple(parts) => parts.iter_mut().for_each(|part| part.each(visit)),
        }
    }

    /// All numbers in order.
    pub fn nodes(&self) -> Vec<NodeId> {
        let mut nodes = Vec::new();
        self.clone().each(&mut |node| nodes.push(*node));
        nodes
    }
}
