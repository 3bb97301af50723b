//! The other half of `main.rs`: derivatives and linear models, contacts, events, orientations.

// Descriptions index as their formulas do.
#![allow(clippy::needless_range_loop)]

mod analysis;
mod contact;
mod events;
mod orientations;
// Each half uses a part of it.
#[allow(dead_code, unused_imports, unused_macros)]
mod support;
