//! A friction whose slip is the rate of the gap that limits it.

use lagrangian::prelude::*;

pub struct Puck {
    pub mass: f64,
    pub roughness: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Puck {
    #[point(mass = self.mass)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[friction(coefficient = self.roughness, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.y
    }
}

fn main() {}
