//! A coordinate to be eliminated that stands inside a cosine.

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

    #[holonomic(eliminate = angle)]
    fn crank(&self, q: &Coordinates) -> f64 {
        q.x - self.rate * q.angle.cos()
    }
}

fn main() {}
