//! A branch on a whole number of the system.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
    pub springs: usize,
}

#[lagrangian(coordinates = [x])]
impl Block {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        if self.springs > 2 { 0.5 * q.x.powi(2) } else { q.x.powi(4) }
    }
}

fn main() {}
