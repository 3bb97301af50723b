//! Facts about one system, and the best way to solve for its accelerations.
//!
//! Reads the equations of motion and collects facts. [`solve`] picks a factorisation for each decoupled block
//! of the mass matrix and writes small ones out on the graph.

mod elimination;
pub mod facts;
mod recursion;
pub mod solve;
mod sparsity;

pub use facts::Facts;
pub use recursion::{Recursion, Step};
pub use solve::{Block, Method, Pivot, Saddle, Solution};
pub use sparsity::Sparsity;
