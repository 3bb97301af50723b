//! A spring that saturates, with the bounds the wrong way round.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x])]
impl Block {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2)
    }

    #[force(on = x)]
    fn spring(&self, q: &Coordinates) -> f64 {
        -self.stiffness * q.x.clamp(1.0, -1.0)
    }
}

fn main() {}
