//! Taylor series in time: coefficients and their convolutions, polynomials as numbers.

pub mod columns;
pub mod followed;
pub mod tables;
pub(crate) mod taylor;

/// The highest order of the series of a motion.
pub(crate) const HIGHEST: usize = 32;
