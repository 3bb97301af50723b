//! The norm of an array of coordinates.

use lagrangian::prelude::*;

pub struct Planet {
    pub mass: f64,
}

#[lagrangian(coordinates = [r: [2]])]
impl Planet {
    #[point(mass = self.mass)]
    fn planet(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::from(q.r)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -self.mass / q.r.norm()
    }
}

fn main() {}
