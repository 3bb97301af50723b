//! An analysis of a system with contacts.

use lagrangian::prelude::*;

pub struct Puck {
    pub mass: f64,
    pub mu: f64,
}

#[lagrangian(coordinates = [x, y], analysis)]
impl Puck {
    #[point(mass = self.mass)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

}

fn main() {}
