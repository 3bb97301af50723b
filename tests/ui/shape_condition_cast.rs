//! A condition on the state that becomes a number by casts.

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
        self.stiffness * (q.y > 0.0) as u8 as f64 * q.y
    }
}

fn main() {}
