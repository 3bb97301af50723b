//! A helper in another impl block.

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

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * self.stretch(q.x).powi(2)
    }
}

impl Block {
    fn stretch(&self, x: f64) -> f64 {
        x - 1.0
    }
}

fn main() {}
