//! A loop over a field of unknown length.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
    pub stiffness: f64,
    pub centres: Vec<f64>,
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
        for centre in &self.centres {
            sum += 0.5 * self.stiffness * (q.x - centre).powi(2);
        }
        sum
    }
}

fn main() {}
