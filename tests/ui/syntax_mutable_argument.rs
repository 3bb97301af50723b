//! A helper that changes its argument.

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
        let mut sum = 0.0;
        self.add(&mut sum, q.x);
        sum
    }

    fn add(&self, sum: &mut f64, x: f64) {
        *sum += x;
    }
}

fn main() {}
