//! Derivatives on the graph, never by expanding expressions.
//!
//! [`pullback`] is reverse accumulation: all derivatives of some seeded outputs for a small
//! multiple of the cost of the outputs. [`pushforward`] is forward accumulation: the
//! derivative of many outputs along one direction, total time derivatives among them.
//! Griewank and Walther, *Evaluating Derivatives*, 2nd ed., SIAM 2008, chapters 3 and 4.

mod degree;
mod forward;
mod local;
mod reverse;
mod sizes;
mod substitute;
#[cfg(test)]
mod tests;

pub use degree::{Degrees, beyond_degree, velocity_degrees, velocity_degrees_of};
pub use forward::{forward_operations, pushforward};
pub use local::{binary as partial_derivatives, unary as derivative};
pub use reverse::{pullback, pullback_to};
pub use sizes::sizes;
pub use substitute::{rebuild, substitute};
