//! Taylor series in time: coefficients and their convolutions, polynomials as numbers.

pub mod columns;
pub mod tables;
pub(crate) mod taylor;
