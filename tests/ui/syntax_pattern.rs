//! A struct among the parameters taken apart.

use lagrangian::prelude::*;

pub struct Spring {
    pub stiffness: f64,
    pub rest: f64,
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
        let Spring { stiffness, rest } = &self.spring;
        0.5 * stiffness * (q.x - rest).powi(2)
    }
}

fn main() {}
