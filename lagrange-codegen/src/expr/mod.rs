//! The expression graph: scalar, hash-consed, exact.
//!
//! A [`Graph`] is an arena of nodes. Equal expressions are one node, so common subexpressions are shared by
//! construction. Nodes are made by constructors alone: constants and variables by those of `graph`, all
//! others by those of `sums`, `products` and `functions`, which bring them into a local normal form. Operands
//! always have a smaller [`NodeId`] than their user: ascending order is a topological order, and no walk
//! needs recursion.

mod evaluate;
mod functions;
mod graph;
mod op;
mod print;
mod products;
mod sums;

pub use evaluate::Rounded;
pub use graph::{Dependence, Exponent, Graph, Node, NodeId, Variable};
pub use op::{Binary, Parity, Unary};
