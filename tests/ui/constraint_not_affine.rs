//! A constraint on the speed.

use lagrangian::prelude::*;

pub struct Slide {
    pub mass: f64,
    pub radius: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Slide {
    #[point(mass = self.mass)]
    fn block(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[nonholonomic]
    fn speed(&self, q: &Coordinates, v: &Velocities) -> f64 {
        q.x + (v.x.powi(2) + v.y.powi(2)).sqrt() - self.radius
    }
}

fn main() {}
