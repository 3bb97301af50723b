//! Behaviour of the `lagrangian` crate as a user sees it. `tests/README.md` says which test lives where.
//! `motions.rs` has the other half: two crates are compiled side by side.

// Descriptions index as their formulas do.
#![allow(clippy::needless_range_loop)]

mod cases;
mod conservation;
mod constraints;
mod derivation;
mod failure;
mod hygiene;
mod integrators;
mod jets;
mod order;
mod reading;
mod structure_of_models;
// Each half uses a part of it.
#[allow(dead_code, unused_imports, unused_macros)]
mod support;
