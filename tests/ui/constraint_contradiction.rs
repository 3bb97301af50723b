//! Two parallel lines at once.

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
    fn line(&self, q: &Coordinates) -> f64 {
        q.x - 2.0 * q.y
    }

    #[holonomic]
    fn other(&self, q: &Coordinates) -> f64 {
        4.0 * q.y - 2.0 * q.x + 1.0
    }
}

fn main() {}
