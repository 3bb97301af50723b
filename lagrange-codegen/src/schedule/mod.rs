//! From graph nodes to a straight-line program of instructions, and from its alike parts to loops.
//!
//! Products share their common pairs of factors, and terms of a sum share a multiplier. Divisors with several
//! uses become reciprocals. Factors that depend on parameters alone are gathered, so that they can be
//! computed once per run. Scheduling does no other algebra.

mod divisors;
mod lowering;
mod pairs;
pub mod program;
pub mod rolling;
mod sharing;

pub use lowering::plan;
pub use program::{Given, Instruction, Operations, Phase, Program, Slot};
pub use rolling::{Loop, Place, Rolled, Row, Source, Step, Surroundings, Walk, roll};

#[cfg(test)]
mod tests;
