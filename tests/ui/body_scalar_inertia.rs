//! One moment of inertia for a body in space.

use lagrangian::prelude::*;

pub struct Top {
    pub mass: f64,
    pub inertia: [f64; 3],
}

#[lagrangian(coordinates = [angle])]
impl Top {
    #[body(mass = self.mass, inertia = 0.5 * self.mass)]
    fn top(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::rotation(Vector3::z() * q.angle)
    }
}

fn main() {}
