//! A position that depends on velocity.

use lagrangian::prelude::*;

pub struct Pendulum {
    pub mass: f64,
    pub length: f64,
    pub g: f64,
}

#[lagrangian(coordinates = [theta])]
impl Pendulum {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.length * Vector2::new(v.theta.sin(), -q.theta.cos())
    }
}

fn main() {}
