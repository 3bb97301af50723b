//! Factorisations of small matrices of fixed size: factor once, solve often. Nothing allocates but, with
//! `std`, `SingularValues` and a [`Sparse`] whose rows depend on each other. Vector functions for any scalar
//! stand in [`algebra`], large tables in [`stored`].
//!
//! [`Ldlt`] is for symmetric positive definite matrices (the mass matrix of any T), [`Lu`] for the rest (a
//! user's own L may have an indefinite ∂²L/∂v²). Both report the index of the pivot at which they stop.
//! `Rows` solves for many columns at once. [`Inverse`] is made from the factors of a matrix that is not
//! formed. [`Saddle`], [`Diagonal`] and [`Sparse`] solve for velocities and multipliers of a constrained
//! system together, redundant constraints included; [`Switched`] does so with rows that can be switched off.
//! [`Schur`] is what is left of such a system once the velocities are eliminated.
//!
//! Loops over a triangle run to `i + 1` and not to `=i`: the end of an inclusive range is a flag of its own,
//! by which compilers for small processors and for graphics processors do not see that indices are within
//! bounds, and a panic would stay.

pub mod algebra;
pub(crate) mod complex;
mod gradients;
mod independence;
mod inverse;
mod ldlt;
mod lu;
mod rows;
mod saddle;
mod schur;
mod singular_values;
pub mod stored;
mod symmetric;

pub use gradients::{Gradients, Pattern, SparseRows};
pub use independence::Independence;
pub(crate) use independence::{CLEAR, determined};
pub use inverse::{Inverse, RecursionStep};
pub use ldlt::Ldlt;
pub use lu::Lu;
pub(crate) use rows::Rows;
pub(crate) use saddle::TangentSpace;
pub use saddle::{Defect, Diagonal, Load, Parts, Saddle, SaddlePoint, Sparse, Switched, SwitchedRows};
pub use schur::Schur;
pub(crate) use singular_values::SingularValues;
pub(crate) use symmetric::diagonalise;

#[cfg(test)]
pub(crate) mod samples;
