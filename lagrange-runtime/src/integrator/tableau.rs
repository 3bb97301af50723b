//! Coefficients of the methods: data and citations, no code.

pub(crate) mod dop853;
pub(crate) mod gauss;
pub(crate) mod rk4;
pub(crate) mod splitting;

#[cfg(test)]
mod conditions;
