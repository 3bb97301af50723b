//! A body without mass and inertia.

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
        0.5 * self.stiffness * q.x.powi(2)
    }

    #[body(mass = 0.0, inertia = 0.0)]
    fn wheel(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::zeros(), q.x)
    }
}

fn main() {}
