//! Numbers: the scalar trait, its functions, SIMD lanes, dual numbers, the double-double.

pub mod elements;
mod math;
pub mod real;
pub(crate) mod rounded;
