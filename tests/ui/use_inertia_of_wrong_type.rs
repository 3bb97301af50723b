//! A field with one moment of inertia for a body in space.

use lagrangian::prelude::*;

pub struct Top {
    pub mass: f64,
    pub inertia: f64,
}

#[lagrangian(coordinates = [angle])]
impl Top {
    #[body(mass = self.mass, inertia = self.inertia)]
    fn top(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::rotation(Vector3::z() * q.angle)
    }
}

fn main() {}
