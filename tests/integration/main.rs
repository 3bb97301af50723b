//! Behaviour of the `lagrangian` crate as a user sees it. `tests/README.md` says which test lives where.

// Descriptions index as their formulas do.
#![allow(clippy::needless_range_loop)]

mod analysis;
mod cases;
mod conservation;
mod constraints;
mod contact;
mod derivation;
mod events;
mod failure;
mod hygiene;
mod integrators;
mod jets;
mod order;
mod orientations;
mod reading;
mod structure_of_models;
mod support;
