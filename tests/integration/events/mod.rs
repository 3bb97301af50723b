//! Zeros of functions along motions of generated systems, against closed forms.

mod kinked;
mod narrow;
mod orbit;
mod own_bounces;
#[cfg(feature = "double-double")]
mod random;
mod swings;
