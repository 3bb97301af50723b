//! Orientations and poses as coordinates: closed forms through every attitude, and everything else that a
//! system can have beside them.

mod beside;
mod derivatives;
mod elliptic;
mod linkage;
mod momenta;
mod named;
mod rolling;
mod spin;
mod tops;
