//! Coefficients of the methods: data and citations, no code.

pub(crate) mod dop853;
pub(crate) mod rk4;

#[cfg(test)]
mod conditions;
