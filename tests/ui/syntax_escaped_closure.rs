//! A closure outside the block that it stands in.

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
        let square = {
            let _unit = 1.0;
            |x: f64| x * x
        };
        0.5 * self.stiffness * square(q.x)
    }
}

fn main() {}
