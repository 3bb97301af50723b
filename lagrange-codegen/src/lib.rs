//! The engine of the `lagrangian` crate: from a mechanical description to Rust.
//!
//! An ordinary library on `proc_macro2`, so that it can be tested, fuzzed and measured, and called
//! from a build script. [`expand`] is the whole pipeline; data flows through it one way:
//!
//! `tokens → Item → Model → Equations → Facts, Solution → Program → tokens`
//!
//! | module | stage |
//! | --- | --- |
//! | [`syntax`] | tokens → [`syntax::Item`]: roles, signatures, bodies, with spans |
//! | [`lower`] | [`syntax::Item`] → [`model::Model`]: names, shapes, loops and calls resolved |
//! | [`eliminate`] | [`model::Model`] → a [`model::Model`] with fewer coordinates |
//! | [`mechanics`] | [`model::Model`] → [`mechanics::Equations`] |
//! | [`structure`] | what is special about the equations, and how they are solved |
//! | [`simplify`] | cheaper roots of equal value |
//! | [`jets`] | which Taylor coefficients follow from which |
//! | [`orders`] | one order of a series as a [`schedule::Program`] |
//! | [`regimes`] | of a system with contacts, friction or kinks: one smooth system, with its regime as parameters |
//! | [`schedule`] | graph nodes → a straight-line [`schedule::Program`], and loops of its alike parts |
//! | `emit` | everything → tokens |
//!
//! [`expr`], [`calculus`], `kinematics` and [`number`] are the mathematics underneath; they know no tokens.
#![forbid(unsafe_code)]

pub mod calculus;
pub mod collections;
pub mod diagnostics;
pub mod eliminate;
mod emit;
mod expand;
pub mod expr;
pub mod jets;
mod kinematics;
pub mod lower;
pub mod mechanics;
pub mod model;
pub mod number;
pub mod orders;
pub mod regimes;
pub mod schedule;
pub mod simplify;
pub mod structure;
pub mod syntax;

pub use expand::{Settings, expand, expand_with};
