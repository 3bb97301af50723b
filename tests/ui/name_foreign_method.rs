//! A method of a field.

use lagrangian::prelude::*;

pub struct Spring {
    pub stiffness: f64,
}

impl Spring {
    pub fn energy(&self, x: f64) -> f64 {
        0.5 * self.stiffness * x * x
    }
}

pub struct Block {
    pub mass: f64,
    pub stiffness: f64,
    pub spring: Spring,
}

#[lagrangian(coordinates = [x])]
impl Block {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        self.spring.energy(q.x)
    }
}

fn main() {}
