//! An attribute that resembles no role.

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

    #[observed]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * self.bob(q).y
    }
}

fn main() {}
