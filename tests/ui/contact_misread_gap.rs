//! A mistake in a gap that a friction names.

use lagrangian::prelude::*;

pub struct Puck {
    pub mass: f64,
    pub mu: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Puck {
    #[point(mass = self.mass)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.z
    }

    #[friction(coefficient = self.mu, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

fn main() {}
