//! The expression graph: scalar, hash-consed, exact.
//!
//! A [`Graph`] is an arena of nodes. Equal expressions are one node, so common subexpressions
//! are shared by construction. The only way to make a node is a constructor of `sums`,
//! `products` or `functions`, which brings it into a local normal form. Operands always have
//! a smaller [`NodeId`] than their user: ascending order is a topological order, and no walk
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
