//! Numbers: the scalar trait, its functions, SIMD lanes, dual numbers, the double-double, numbers with bounds
//! of their errors; arrays from functions.

pub(crate) mod compensated;
pub mod elements;
mod math;
pub mod real;
pub(crate) mod rounded;
