//! A matrix with a missing entry.

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
        let stiffness = nalgebra::matrix![self.stiffness, 0.0; 0.0];
        let x = Vector2::new(q.x, q.x);
        0.5 * x.dot(&(stiffness * x))
    }
}

fn main() {}
