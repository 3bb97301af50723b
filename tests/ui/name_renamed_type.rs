//! A type of nalgebra under another name.

use lagrangian::prelude::*;

pub type V = Vector2<f64>;

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
        0.5 * self.stiffness * V::new(q.x, q.y).norm_squared()
    }
}

fn main() {}
