//! A force at a call.

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

    #[force(at = self.cart(q))]
    fn drive(&self, u: &Inputs) -> Vector2<f64> {
        Vector2::new(u.motor, 0.0)
    }
}

fn main() {}
