//! Three coordinates, two of which only move the third.

use lagrangian::prelude::*;

pub struct Gear {
    pub inertia: f64,
}

#[lagrangian(coordinates = [a, b, c])]
impl Gear {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        self.inertia * v.c * (v.a + v.b)
    }
}

fn main() {}
