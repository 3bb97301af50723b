//! Equations of motion and their integration from a Lagrangian, at compile time.
#![no_std]
