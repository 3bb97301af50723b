//! An array of frictions in two directions.

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

    #[friction(limit = self.mu)]
    fn slips(&self, v: &Velocities) -> [Vector2<f64>; 2] {
        [Vector2::new(v.x, v.y), Vector2::new(v.y, v.x)]
    }
}

fn main() {}
