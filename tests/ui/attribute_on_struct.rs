//! The attribute stands on the struct.

use lagrangian::prelude::*;

#[lagrangian(coordinates = [theta])]
pub struct Pendulum {
    pub mass: f64,
    pub length: f64,
}

fn main() {}
