//! A distance that should be zero, instead of its components.

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

    #[holonomic]
    fn pin(&self, q: &Coordinates) -> f64 {
        (self.block(q) - Vector2::new(self.radius, 0.0)).norm()
    }
}

fn main() {}
