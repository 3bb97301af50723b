//! One small system per feature of the language, with a result by hand, and the identities of every system.

mod arrays;
mod closures;
mod constraints;
mod constraints_language;
mod elementary;
mod eliminated;
mod forces;
mod generic_bodies;
mod lagrangians;
mod language;
mod limits;
mod orientations;
mod parameters;
mod planar_bodies;
mod scalars;
mod sizes;
mod spatial_bodies;
mod time;
mod unusual_numbers;
mod velocities;
