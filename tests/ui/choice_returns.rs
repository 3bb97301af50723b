//! A branch on the state that leaves the function.

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

    #[potential]
    fn step(&self, q: &Coordinates) -> f64 {
        if q.x > 0.0 {
            return 0.0;
        }
        q.x.powi(2)
    }
}

fn main() {}
