//! A field of a body's velocity written as a method.

use lagrangian::prelude::*;

pub struct Sledge;

#[lagrangian(coordinates = [x, y, angle])]
impl Sledge {
    #[body(mass = 1.0, inertia = 0.1)]
    fn blade(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.angle)
    }

    #[nonholonomic]
    fn edge(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.blade_velocity(q, v).velocity_in_body().y
    }
}

fn main() {}
