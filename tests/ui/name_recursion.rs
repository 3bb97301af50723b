//! Helpers that call each other.

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
        0.5 * self.stiffness * self.even(q.x)
    }

    fn even(&self, x: f64) -> f64 {
        1.0 + self.odd(x)
    }

    fn odd(&self, x: f64) -> f64 {
        x * self.even(x)
    }
}

fn main() {}
