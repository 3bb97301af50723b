//! A rotation about an axis that moves.

use lagrangian::prelude::*;

pub struct Top {
    pub mass: f64,
    pub inertia: [f64; 3],
}

#[lagrangian(coordinates = [lean, spin])]
impl Top {
    #[body(mass = self.mass, inertia = self.inertia)]
    fn top(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::new(Vector3::zeros(), Vector3::new(q.lean.sin(), 0.0, q.lean.cos()) * q.spin)
    }
}

fn main() {}
