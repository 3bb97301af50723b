//! An array of unknown length.

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
        let powers = std::array::from_fn(|i| q.x.powi(i as i32));
        let sum: f64 = powers.iter().sum();
        sum * self.stiffness
    }
}

fn main() {}
