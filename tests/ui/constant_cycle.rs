//! Constants that need each other.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x])]
impl Block {
    const N: usize = Self::M;
    const M: usize = Self::N;

    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        let mut sum = 0.0;
        for i in 0..Self::N {
            sum += self.stiffness * q.x.powi(i as i32);
        }
        sum
    }
}

fn main() {}
