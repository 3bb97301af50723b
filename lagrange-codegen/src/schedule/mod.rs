//! From graph nodes to a straight-line program of two-operand instructions.
//!
//! Products share their common pairs of factors, divisors that occur twice become one
//! reciprocal, and what depends on parameters alone is gathered into single factors, so that
//! it can be computed once per run. Scheduling does no algebra beyond that.

mod divisors;
mod lowering;
mod pairs;
pub mod program;
mod sharing;

pub use lowering::plan;
pub use program::{Given, Instruction, Operations, Phase, Program, Slot};

#[cfg(test)]
mod tests;
