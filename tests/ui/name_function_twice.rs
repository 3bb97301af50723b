//! Two functions of one name.

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

    #[event]
    fn stop(&self, v: &Velocities) -> f64 {
        v.x
    }

    #[event]
    fn stop(&self, v: &Velocities) -> f64 {
        v.y
    }
}

fn main() {}
