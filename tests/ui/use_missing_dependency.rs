//! A path of the crate that does not exist.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
}

#[lagrangian(coordinates = [x], crate = missing)]
impl Block {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2)
    }
}

fn main() {}
