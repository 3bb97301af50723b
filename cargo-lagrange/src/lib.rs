//! What the command `cargo lagrange` does, as a library: robots from files as descriptions for `#[lagrangian]`.
#![forbid(unsafe_code)]

pub mod import;
