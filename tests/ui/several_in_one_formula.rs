//! Several mistakes in one formula.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x])]
impl Block {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.y.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        let stretch = (q.x - lenght).abs();
        let energy = 0.5 * self.stiffness * stretch.sqr();
        energy + q.x.floor() + q.y
    }
}

fn main() {}
