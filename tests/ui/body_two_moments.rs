//! Two moments of inertia for a body in space.

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

    #[body(mass = self.mass, inertia = [1.0, 2.0])]
    fn top(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::rotation(Vector3::z() * q.x)
    }
}

fn main() {}
