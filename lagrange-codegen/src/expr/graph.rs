//! The arena: nodes, identities, and what each node depends on.

use std::cell::RefCell;

use super::op::{Binary, Unary};
use crate::collections::Lookup;
use crate::number::Number;

/// A handle to a node of one [`Graph`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(u32);

impl NodeId {
    /// The position in the arena, for side tables.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// An exponent in halves: 1 is a square root, 2 the factor itself, −2 its reciprocal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Exponent(pub i32);

impl Exponent {
    /// A whole exponent.
    pub fn whole(power: i32) -> Exponent {
        Exponent(2 * power)
    }

    /// The integer power this is, unless it is an odd number of halves.
    pub fn as_integer(self) -> Option<i32> {
        (self.0 % 2 == 0).then_some(self.0 / 2)
    }
}

/// A quantity that expressions are functions of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Variable {
    /// A generalized coordinate.
    Coordinate(u32),
    /// A generalized velocity. For an orientation whose matrix is a variable, it is a component of the
    /// angular velocity in body axes.
    Velocity(u32),
    /// A generalized acceleration, if it is given instead of solved for.
    Acceleration(u32),
    /// Time.
    Time,
    /// An input.
    Input(u32),
    /// A parameter: a field of the user's struct or a constant outside the macro's sight.
    Parameter(u32),
    /// A function of the others whose Taylor coefficients follow from a recurrence.
    Auxiliary(u32),
    /// A Lagrange multiplier of a constraint.
    Multiplier(u32),
    /// An entry of the matrix of an orientation: nine an orientation, row by row.
    Entry(u32),
    /// A component of the position of a particle or body, in a constraint as a function of positions.
    Position(u32),
}

/// One operation.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// An exact constant.
    Constant(Number),
    /// A variable.
    Variable(Variable),
    /// `offset + Σ coefficient · term`, terms ascending, at least one of them.
    Sum {
        /// The constant part.
        offset: Number,
        /// Terms with nonzero coefficients; none is a constant or a lone scaled node.
        terms: Vec<(NodeId, Number)>,
    },
    /// `Π factor ^ exponent`, factors ascending, exponents nonzero.
    Product(Vec<(NodeId, Exponent)>),
    /// A function of one argument.
    Unary(Unary, NodeId),
    /// A function of two arguments.
    Binary(Binary, NodeId, NodeId),
}

/// The set of kinds of variables that a node depends on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dependence(u8);

impl Dependence {
    /// Nothing: a constant.
    pub const NONE: Dependence = Dependence(0);
    /// Generalized coordinates, and what is made of them: auxiliaries, entries of orientations, positions.
    pub const COORDINATES: Dependence = Dependence(1);
    /// Generalized velocities.
    pub const VELOCITIES: Dependence = Dependence(2);
    /// Time.
    pub const TIME: Dependence = Dependence(4);
    /// Inputs.
    pub const INPUTS: Dependence = Dependence(8);
    /// Parameters.
    pub const PARAMETERS: Dependence = Dependence(16);
    /// Generalized accelerations.
    pub const ACCELERATIONS: Dependence = Dependence(32);
    /// Lagrange multipliers.
    pub const MULTIPLIERS: Dependence = Dependence(64);

    /// The union of two sets.
    pub const fn union(self, other: Dependence) -> Dependence {
        Dependence(self.0 | other.0)
    }

    /// Whether the sets have a member in common.
    pub fn meets(self, other: Dependence) -> bool {
        self.0 & other.0 != 0
    }

    /// Whether the value is constant all through a run, being made of parameters and constants alone.
    pub fn is_fixed(self) -> bool {
        self.0 & !Dependence::PARAMETERS.0 == 0
    }
}

/// A hash-consed arena of scalar expressions.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    dependence: Vec<Dependence>,
    known: Lookup<Node, NodeId>,
    marks: RefCell<Marks>,
}

/// A set of nodes is close together if there are at most this many nodes for each of its own from its first
/// to its last.
const CLOSE: usize = 4;

/// Which nodes the current walk has seen: a mark is valid for one walk only, so that a walk
/// costs in proportion to what it visits, not to the whole arena.
#[derive(Clone, Debug, Default)]
struct Marks {
    walk: u32,
    seen: Vec<u32>,
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Graph {
        Graph::default()
    }

    /// The operation of a node.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.index()]
    }

    /// The number of nodes made so far.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// All nodes, ascending.
    pub fn nodes(&self) -> impl Iterator<Item = NodeId> {
        (0..self.nodes.len() as u32).map(NodeId)
    }

    /// Whether no node was made yet.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The variables that a node depends on.
    pub fn dependence(&self, id: NodeId) -> Dependence {
        self.dependence[id.index()]
    }

    /// The node of a constant.
    pub fn constant(&mut self, value: Number) -> NodeId {
        self.intern(Node::Constant(value))
    }

    /// The node of an integer.
    pub fn integer(&mut self, value: i128) -> NodeId {
        self.constant(Number::integer(value))
    }

    /// The node 0.
    pub fn zero(&mut self) -> NodeId {
        self.constant(Number::ZERO)
    }

    /// The node 1.
    pub fn one(&mut self) -> NodeId {
        self.constant(Number::ONE)
    }

    /// The number of nodes.
    pub fn size(&self) -> usize {
        self.nodes.len()
    }

    /// The node of a variable.
    pub fn variable(&mut self, variable: Variable) -> NodeId {
        self.intern(Node::Variable(variable))
    }

    /// The constant a node is, if it is one.
    pub fn as_constant(&self, id: NodeId) -> Option<Number> {
        match self.node(id) {
            Node::Constant(value) => Some(*value),
            _ => None,
        }
    }

    /// Whether a node is the constant 0.
    pub fn is_zero(&self, id: NodeId) -> bool {
        self.as_constant(id).is_some_and(Number::is_zero)
    }

    /// Calls `visit` with every operand of a node.
    pub fn operands(&self, id: NodeId, mut visit: impl FnMut(NodeId)) {
        match self.node(id) {
            Node::Constant(_) | Node::Variable(_) => {}
            Node::Sum { terms, .. } => terms.iter().for_each(|&(term, _)| visit(term)),
            Node::Product(factors) => factors.iter().for_each(|&(factor, _)| visit(factor)),
            Node::Unary(_, argument) => visit(*argument),
            Node::Binary(_, first, second) => {
                visit(*first);
                visit(*second);
            }
        }
    }

    /// All nodes that the roots need, ascending: operands stand before their users.
    pub fn cone(&self, roots: impl IntoIterator<Item = NodeId>) -> Vec<NodeId> {
        let mut marks = self.marks.borrow_mut();
        let Marks { walk, seen } = &mut *marks;
        *walk += 1;
        seen.resize(self.nodes.len(), 0);
        let mut cone = Vec::new();
        let mut stack: Vec<NodeId> = roots.into_iter().collect();
        while let Some(id) = stack.pop() {
            if std::mem::replace(&mut seen[id.index()], *walk) != *walk {
                cone.push(id);
                self.operands(id, |operand| stack.push(operand));
            }
        }
        // If nodes are close together, a look at all nodes between them is quicker than sorting.
        let ends =
            cone.iter().min().zip(cone.iter().max()).map(|(first, last)| (first.index(), last.index()));
        match ends {
            Some((first, last)) if last - first < CLOSE * cone.len() => {
                cone.clear();
                let marks = (first as u32..).zip(&seen[first..=last]);
                cone.extend(marks.filter(|&(_, mark)| mark == walk).map(|(id, _)| NodeId(id)));
            }
            _ => cone.sort_unstable(),
        }
        cone
    }

    /// Whether a node depends on one variable.
    pub fn depends_on(&self, id: NodeId, variable: Variable) -> bool {
        self.any_depends_on([id], variable)
    }

    /// Whether one of some nodes depends on a variable.
    pub fn any_depends_on(&self, ids: impl IntoIterator<Item = NodeId>, variable: Variable) -> bool {
        match self.known.get(&Node::Variable(variable)) {
            Some(&node) => self.cone(ids).binary_search(&node).is_ok(),
            None => false,
        }
    }

    /// Makes a node that is in normal form already. Only the constructors may call this.
    pub(super) fn intern(&mut self, node: Node) -> NodeId {
        if let Some(&id) = self.known.get(&node) {
            return id;
        }
        let dependence = match &node {
            Node::Constant(_) => Dependence::NONE,
            Node::Variable(
                Variable::Coordinate(_) | Variable::Entry(_) | Variable::Auxiliary(_) | Variable::Position(_),
            ) => Dependence::COORDINATES,
            Node::Variable(Variable::Velocity(_)) => Dependence::VELOCITIES,
            Node::Variable(Variable::Acceleration(_)) => Dependence::ACCELERATIONS,
            Node::Variable(Variable::Multiplier(_)) => Dependence::MULTIPLIERS,
            Node::Variable(Variable::Time) => Dependence::TIME,
            Node::Variable(Variable::Input(_)) => Dependence::INPUTS,
            Node::Variable(Variable::Parameter(_)) => Dependence::PARAMETERS,
            Node::Sum { terms, .. } => self.joint(terms.iter().map(|&(term, _)| term)),
            Node::Product(factors) => self.joint(factors.iter().map(|&(factor, _)| factor)),
            Node::Unary(_, argument) => self.dependence(*argument),
            Node::Binary(_, first, second) => self.joint([*first, *second].into_iter()),
        };
        let id = NodeId(self.nodes.len() as u32);
        self.nodes.push(node.clone());
        self.dependence.push(dependence);
        self.known.insert(node, id);
        id
    }

    fn joint(&self, operands: impl Iterator<Item = NodeId>) -> Dependence {
        operands.fold(Dependence::NONE, |joint, operand| joint.union(self.dependence(operand)))
    }
}
