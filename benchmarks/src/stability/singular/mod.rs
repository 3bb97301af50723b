//! Motions that start beside singular positions of linkages and pass through them, by every method.
//!
//! In a singular position gradients of constraints are dependent, and branches of motions cross. A start is
//! on one branch, and the motion stays on it. A method that evaluates beside the crossing, with the rounding
//! errors of its state, may jump.

pub mod cases;
mod curve;
pub mod runs;
pub mod table;

pub use curve::run as along;
