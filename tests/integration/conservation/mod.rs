//! Quantities that a motion must keep: energy, momenta, phase volume, and the way back.

mod energy;
mod momenta;
mod phase_space;
