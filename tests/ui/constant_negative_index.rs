//! An index that runs below zero.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
    pub stiffness: f64,
    pub centres: [f64; 2],
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
        for i in 0..2 {
            sum += self.stiffness * (q.x - self.centres[i - 1]).powi(2);
        }
        sum
    }
}

fn main() {}
