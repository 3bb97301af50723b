//! Descriptions in which names mean something else than usual: read as Rust reads them, or caught at first
//! use.

#[cfg(debug_assertions)]
mod caught;
mod constants;
mod read;
