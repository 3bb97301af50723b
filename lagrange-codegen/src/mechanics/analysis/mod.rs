//! What a model can tell about itself beyond its motion, derived only where the attribute asks for it.
//!
//! | file | what it derives |
//! | --- | --- |
//! | `covariant` | Christoffel symbols, the Coriolis matrix, gyroscopic terms |
//! | `inertia` | T2, T1, T0 and the inertia forces that belong to them |
//! | `balance` | rates of the energy and of the Jacobi integral |
//! | `symmetries` | integrals of the motion by Noether's theorem, found by `nullspace`; `turns` of orientations |
//! | `regressor` | the equations as a linear function of lumped parameters, found by `monomials` |

mod balance;
mod covariant;
mod inertia;
mod monomials;
mod nullspace;
mod regressor;
mod symmetries;
mod turns;

pub use balance::Balance;
pub use covariant::{Covariant, christoffel};
pub use inertia::Inertia;
pub use regressor::Regressor;
pub use symmetries::{Generator, Integral, integrals};
pub use turns::Turn;
