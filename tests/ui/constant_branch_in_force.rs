//! Friction by a branch.

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
        0.5 * self.stiffness * q.x.powi(2)
    }

    #[force]
    fn friction(&self, v: &Velocities) -> f64 {
        if v.x == 0.0 { -self.mass } else { self.mass }
    }
}

fn main() {}
