//! A closure that copies what it uses.

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
        let mut stiffness = self.stiffness;
        let energy = move |x: f64| 0.5 * stiffness * x * x;
        stiffness *= 2.0;
        energy(q.x) + stiffness
    }
}

fn main() {}
