//! Three constraints on two coordinates.

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
    fn curves(&self, q: &Coordinates) -> [f64; 3] {
        [q.x.sin() - q.y, q.x * q.y - self.radius, q.y.cos() - 0.5]
    }
}

fn main() {}
