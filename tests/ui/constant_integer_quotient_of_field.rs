//! A quotient of integers, of which one is a field.

use lagrangian::prelude::*;

pub struct Ladder {
    pub mass: f64,
    pub count: usize,
}

#[lagrangian(coordinates = [x])]
impl Ladder {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        self.count / 2 * q.x
    }
}

fn main() {}
