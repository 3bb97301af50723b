//! The command `cargo lagrange` as a library: models of a package as the macro sees them, and robots from
//! files as descriptions for `#[lagrangian]`.
#![forbid(unsafe_code)]

pub mod import;
pub mod models;
