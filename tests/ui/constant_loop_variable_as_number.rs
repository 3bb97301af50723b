//! A loop variable where a number belongs.

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
        for i in 1..4 {
            sum += i * self.stiffness * q.x.powi(i);
        }
        sum
    }
}

fn main() {}
