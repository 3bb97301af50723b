//! A constant in small letters.

use lagrangian::prelude::*;

mod units {
    #[allow(non_upper_case_globals)]
    pub const gravity: f64 = 9.81;
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
        self.mass * units::gravity * q.x
    }
}

fn main() {}
