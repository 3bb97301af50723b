//! No arguments at all.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
}

#[lagrangian]
impl Block {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2)
    }
}

fn main() {}
