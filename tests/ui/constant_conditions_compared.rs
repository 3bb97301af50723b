//! Conditions on the state that are compared.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Block {
    #[point(mass = self.mass)]
    fn block(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        let crossed = if (q.x > 0.0) != (q.y > 0.0) { 1.0 } else { 2.0 };
        self.stiffness * crossed * q.x * q.x
    }
}

fn main() {}
