//! A closure as the argument of a function of the block.

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

    fn scaled(&self, energy: impl Fn(f64) -> f64, x: f64) -> f64 {
        0.5 * self.stiffness * energy(x)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        let square = |x: f64| x * x;
        self.scaled(square, q.x)
    }
}

fn main() {}
