//! A body without its inertia.

use lagrangian::prelude::*;

pub struct Pendulum {
    pub mass: f64,
    pub length: f64,
    pub g: f64,
}

#[lagrangian(coordinates = [theta])]
impl Pendulum {
    #[body(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.theta.sin(), -q.theta.cos()), q.theta)
    }
}

fn main() {}
