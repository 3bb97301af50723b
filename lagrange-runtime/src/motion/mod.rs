//! Motions under error control, in fixed steps, several at once, and the events along them.

pub mod batch;
pub mod events;
pub(crate) mod roots;
pub mod simulation;
pub mod stepper;
