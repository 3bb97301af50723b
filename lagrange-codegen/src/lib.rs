//! Engine.
pub mod calculus;
pub mod collections;
pub mod diagnostics;
pub mod expr;
pub mod mechanics;
pub mod model;
pub mod number;
