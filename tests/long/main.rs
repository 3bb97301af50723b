//! Motions of millions of steps, in `--release`: `scripts/check.sh long drift`.

// A part of it is used here.
#[allow(dead_code)]
#[path = "../integration/support/close.rs"]
mod close;
mod constrained;
mod free;
mod turning;
