//! Motions that cannot go on: the cause and the time as a value, the last good state kept, never a panic.

mod collisions;
mod impossible_constraints;
mod parameters;
mod singular_masses;
mod steppers;
