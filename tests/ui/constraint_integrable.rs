//! Rolling on a line, which is a condition on positions.

use lagrangian::prelude::*;

pub struct Slide {
    pub mass: f64,
    pub radius: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Slide {
    #[point(mass = self.mass)]
    fn block(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[nonholonomic]
    fn rolling(&self, v: &Velocities) -> f64 {
        v.x - self.radius * v.y
    }
}

fn main() {}
