//! Velocities that descriptions name, against what a user would derive by hand.

mod forms;
mod rolling;
mod slipping;
