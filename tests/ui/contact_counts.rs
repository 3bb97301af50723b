//! Two reactions for one slip velocity.

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
    fn walls(&self, q: &Coordinates) -> [f64; 2] {
        [q.x, 1.0 - q.x]
    }

    #[friction(coefficient = self.mu, normal = walls)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.y
    }
}

fn main() {}
