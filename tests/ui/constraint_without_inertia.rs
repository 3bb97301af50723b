//! A steering angle without inertia that no constraint determines.

use lagrangian::prelude::*;

pub struct Slide {
    pub mass: f64,
    pub radius: f64,
}

#[lagrangian(coordinates = [x, y, angle])]
impl Slide {
    #[point(mass = self.mass)]
    fn block(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[nonholonomic]
    fn wheel(&self, q: &Coordinates, v: &Velocities) -> f64 {
        q.angle.sin() * v.x - q.angle.cos() * v.y
    }
}

fn main() {}
