//! A friction whose slip is the square of a velocity.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
    pub limit: f64,
}

#[lagrangian(coordinates = [x])]
impl Block {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x * v.x
    }

    #[friction(limit = self.limit)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x.powi(2)
    }
}

fn main() {}
