//! Velocities without a parameter for them.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x])]
impl Block {
    #[lagrangian]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.mass * v.x.powi(2) - 0.5 * self.stiffness * q.x.powi(2)
    }
}

fn main() {}
