//! Factorisations of small dense matrices of fixed size: factor once, solve often, never allocate.
//!
//! [`Ldlt`] is for symmetric positive definite matrices (the mass matrix of any T), [`Lu`] for the rest (a user's
//! own L may have an indefinite ∂²L/∂v²). Both report the index of the pivot at which they stop.

pub(crate) mod complex;
mod ldlt;
mod lu;

pub use ldlt::Ldlt;
pub use lu::Lu;

#[cfg(test)]
pub(crate) mod samples;
