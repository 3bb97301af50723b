//! A branch on the state with sides of two kinds.

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

    #[force(at = puck)]
    fn push(&self, q: &Coordinates) -> Vector2<f64> {
        let push = if q.x > 0.0 { [1.0, 0.0] } else { [1.0, 0.0, 2.0] };
        Vector2::new(push[0], push[1])
    }
}

fn main() {}
