//! Degrees of expressions in the velocities.

use crate::expr::{Dependence, Exponent, Graph, Node, NodeId};

/// The degrees of the homogeneous parts of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Degrees {
    /// A polynomial; bit n is set if it has a part of degree n.
    Polynomial(u32),
    /// Not a polynomial, or one of a degree beyond any use.
    Other,
}

/// The number of degrees that are told apart, from 0 on.
const BITS: u32 = 31;

impl Degrees {
    /// Whether there are parts of this degree and of no other. Zero has no parts.
    pub fn is_homogeneous(self, degree: u32) -> bool {
        self == Degrees::Polynomial(1 << degree)
    }

    /// Whether no part has a degree above `limit`.
    pub fn at_most(self, limit: u32) -> bool {
        matches!(self, Degrees::Polynomial(parts) if parts >> (limit + 1) == 0)
    }

    fn product(self, other: Degrees) -> Degrees {
        let (Degrees::Polynomial(a), Degrees::Polynomial(b)) = (self, other) else { return Degrees::Other };
        if a == 1 || b == 1 {
            return Degrees::Polynomial(a * b);
        }
        let parts = (0..BITS).filter(|&n| a >> n & 1 == 1).fold(0_u64, |parts, n| parts | u64::from(b) << n);
        if parts >> BITS == 0 { Degrees::Polynomial(parts as u32) } else { Degrees::Other }
    }

    fn power(self, exponent: Exponent) -> Degrees {
        if self == Degrees::Polynomial(1) {
            return self;
        }
        match exponent.as_integer() {
            Some(power) if power > 0 => {
                (0..power).fold(Degrees::Polynomial(1), |product, _| product.product(self))
            }
            _ => Degrees::Other,
        }
    }
}

/// The degrees of one expression in the velocities.
pub fn velocity_degrees(graph: &Graph, root: NodeId) -> Degrees {
    velocity_degrees_of(graph, &[root])[0]
}

/// The same of several.
pub fn velocity_degrees_of(graph: &Graph, roots: &[NodeId]) -> Vec<Degrees> {
    let mut degrees = vec![Degrees::Polynomial(0); graph.len()];
    for id in graph.cone(roots.iter().copied()) {
        degrees[id.index()] = node_degrees(graph, id, |operand| degrees[operand.index()]);
    }
    roots.iter().map(|root| degrees[root.index()]).collect()
}

/// The nodes of an expression, ascending, that are not polynomials of at most the given degree.
pub fn beyond_degree(graph: &Graph, root: NodeId, limit: u32) -> Vec<NodeId> {
    let mut degrees = vec![Degrees::Polynomial(0); graph.len()];
    let mut beyond = Vec::new();
    for id in graph.cone([root]) {
        degrees[id.index()] = node_degrees(graph, id, |operand| degrees[operand.index()]);
        if !degrees[id.index()].at_most(limit) {
            beyond.push(id);
        }
    }
    beyond
}

fn node_degrees(graph: &Graph, id: NodeId, of: impl Fn(NodeId) -> Degrees) -> Degrees {
    const CONSTANT: Degrees = Degrees::Polynomial(1);
    if !graph.dependence(id).meets(Dependence::VELOCITIES) {
        return if graph.is_zero(id) { Degrees::Polynomial(0) } else { CONSTANT };
    }
    match graph.node(id) {
        Node::Constant(_) => CONSTANT,
        Node::Variable(_) => Degrees::Polynomial(1 << 1),
        Node::Sum { offset, terms } => {
            let start = u32::from(!offset.is_zero());
            terms.iter().fold(Degrees::Polynomial(start), |sum, &(term, _)| match (sum, of(term)) {
                (Degrees::Polynomial(a), Degrees::Polynomial(b)) => Degrees::Polynomial(a | b),
                _ => Degrees::Other,
            })
        }
        Node::Product(factors) => factors
            .iter()
            .fold(CONSTANT, |product, &(factor, exponent)| product.product(of(factor).power(exponent))),
        Node::Unary(..) | Node::Binary(..) => Degrees::Other,
    }
}
