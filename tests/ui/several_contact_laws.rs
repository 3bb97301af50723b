//! Laws of impact: one that does not exist, and a plastic one with a restitution.

use lagrangian::prelude::*;

pub struct Puck {
    pub mass: f64,
    pub restitution: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Puck {
    #[point(mass = self.mass)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[unilateral(restitution = self.restitution, law = hertz)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[unilateral(restitution = self.restitution, law = plastic)]
    fn wall(&self, q: &Coordinates) -> f64 {
        q.x
    }
}

fn main() {}
