//! A window whose width is no constant.

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
        let mut sum = 0.0;
        for pair in [q.x, 2.0 * q.x].windows(self.stiffness) {
            sum += pair[0] * pair[1];
        }
        sum
    }
}

fn main() {}
