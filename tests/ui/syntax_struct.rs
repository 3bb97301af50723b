//! A struct is built.

use lagrangian::prelude::*;

pub struct Spring {
    pub length: f64,
}

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
        let spring = Spring { length: q.x };
        0.5 * self.stiffness * spring.length.powi(2)
    }
}

fn main() {}
