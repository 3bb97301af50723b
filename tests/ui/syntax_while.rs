//! A loop with a condition.

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
        let mut order = 0;
        while order < 3 {
            sum += q.x.powi(order);
            order += 1;
        }
        sum
    }
}

fn main() {}
