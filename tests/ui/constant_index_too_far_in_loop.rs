//! A loop that runs beyond an array.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x: [2]])]
impl Block {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * (v.x[0].powi(2) + v.x[1].powi(2))
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        let mut sum = 0.0;
        for i in 0..4 {
            sum += 0.5 * self.stiffness * q.x[i].powi(2);
        }
        sum
    }
}

fn main() {}
