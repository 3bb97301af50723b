//! A force on a point that does not move.

use lagrangian::prelude::*;

pub struct Cart {
    pub mass: f64,
}

#[lagrangian(coordinates = [x])]
impl Cart {
    #[point(mass = self.mass)]
    fn cart(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    #[force(at = cart)]
    fn wind(&self, t: f64) -> Vector2<f64> {
        Vector2::new(0.0, t.sin())
    }
}

fn main() {}
