//! The square of what should be zero.

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
    fn circle(&self, q: &Coordinates) -> f64 {
        (self.block(q).norm() - self.radius).powi(2)
    }
}

fn main() {}
