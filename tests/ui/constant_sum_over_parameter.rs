//! A sum over a field of unknown length.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
    pub stiffness: f64,
    pub centres: [f64; 2],
}

#[lagrangian(coordinates = [x])]
impl Block {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        self.centres.iter().map(|centre| (q.x - centre).powi(2)).sum::<f64>()
    }
}

fn main() {}
