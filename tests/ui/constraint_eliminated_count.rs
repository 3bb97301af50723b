//! One equation for two unknowns.

use lagrangian::prelude::*;

pub struct Arm {
    pub mass: f64,
    pub rate: f64,
}

#[lagrangian(coordinates = [x, theta: [2]])]
impl Arm {
    #[point(mass = self.mass)]
    fn hand(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x + q.theta[0].cos() + q.theta[1].cos(), q.theta[0].sin())
    }

    #[holonomic(eliminate = theta)]
    fn drive(&self, q: &Coordinates, t: f64) -> f64 {
        q.theta[0] - self.rate * t
    }
}

fn main() {}
