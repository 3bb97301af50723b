//! A vector compared with a number.

use lagrangian::prelude::*;

pub struct Pendulum {
    pub mass: f64,
    pub length: f64,
    pub g: f64,
}

#[lagrangian(coordinates = [theta])]
impl Pendulum {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        self.length * Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        if self.bob(q) > 0.0 { q.theta } else { 2.0 * q.theta }
    }
}

fn main() {}
