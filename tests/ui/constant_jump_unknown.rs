//! A staircase of a constant that no rule of rounding tells.

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
        self.stiffness * (1.0_f64.exp() % 0.5) * q.x
    }
}

fn main() {}
