//! Two limits of one friction in two directions.

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

    #[friction(limit = [self.mu, self.mu])]
    fn slip(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x, v.y)
    }
}

fn main() {}
