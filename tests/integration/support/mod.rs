//! The common tools of several tests.

pub mod close;
pub mod constrained;
pub mod difference;
#[cfg(feature = "double-double")]
pub mod digits;
pub mod dual;
pub mod identities;
pub mod motion;
pub mod reference;
pub mod sample;
