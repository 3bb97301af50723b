//! Two particles of one name, of which each has the inertia of a coordinate.

use lagrangian::prelude::*;

pub struct Puck {
    pub mass: f64,
    pub mu: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Puck {
    #[point(mass = self.mass)]
    fn puck(&self, q: &Coordinates) -> f64 {
        q.x
    }

    #[point(mass = self.mass)]
    fn puck(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

fn main() {}
