//! A field that is private elsewhere.

use lagrangian::prelude::*;

mod spring {
    pub struct Spring {
        stiffness: f64,
    }
}

pub struct Block {
    pub mass: f64,
    pub stiffness: f64,
    pub spring: spring::Spring,
}

#[lagrangian(coordinates = [x])]
impl Block {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.spring.stiffness * q.x.powi(2)
    }
}

fn main() {}
