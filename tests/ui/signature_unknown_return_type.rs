//! A position of a type of its own.

use lagrangian::prelude::*;

pub type Position = Vector2<f64>;

pub struct Pendulum {
    pub mass: f64,
    pub length: f64,
    pub g: f64,
}

#[lagrangian(coordinates = [theta])]
impl Pendulum {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Position {
        self.length * Vector2::new(q.theta.sin(), -q.theta.cos())
    }
}

fn main() {}
