//! A helper named like a method that an elimination adds.

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

    fn velocities(&self) -> f64 {
        self.rate
    }

    #[holonomic(eliminate = angle)]
    fn drive(&self, q: &Coordinates, t: f64) -> f64 {
        q.angle - self.velocities() * t
    }
}

fn main() {}
