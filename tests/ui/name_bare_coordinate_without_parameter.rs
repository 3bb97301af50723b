//! A coordinate in a function without `q`.

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
    fn gravity(&self) -> f64 {
        -self.mass * self.g * self.length * theta.cos()
    }
}

fn main() {}
