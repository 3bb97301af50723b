//! Two generalized forces for one coordinate.

use lagrangian::prelude::*;

pub struct Cart {
    pub mass: f64,
}

#[lagrangian(coordinates = [x], inputs = [motor])]
impl Cart {
    #[point(mass = self.mass)]
    fn cart(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    #[force]
    fn drive(&self, u: &Inputs) -> [f64; 2] {
        [u.motor, 0.0]
    }
}

fn main() {}
