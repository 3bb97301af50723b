//! The parts of random systems.
//!
//! Every function stays inside its domain by the form of its argument (√(1 + x²), ln(2 + cos x)), so that
//! almost every system is regular at almost every state. Hardly any strategy depends on the value of another
//! one: indices are resolved by the system, and shrinking is free to take parts away.

mod constraints;
mod expressions;
mod roles;
mod systems;

pub use systems::{chained, linked, sample, system};
