//! Every coordinate is prescribed.

use lagrangian::prelude::*;

pub struct Slide {
    pub mass: f64,
    pub rate: f64,
}

#[lagrangian(coordinates = [x, y, angle])]
impl Slide {
    #[point(mass = self.mass)]
    fn block(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x + q.angle.cos(), q.y + q.angle.sin())
    }

    #[holonomic(eliminate)]
    fn drive(&self, q: &Coordinates, t: f64) -> [f64; 3] {
        [q.x - t, q.y, q.angle - self.rate * t]
    }
}

fn main() {}
