//! Engine.
pub mod collections;
pub mod diagnostics;
pub mod expr;
pub mod model;
pub mod number;
