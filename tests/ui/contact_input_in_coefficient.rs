//! A coefficient of friction that an input gives.

use lagrangian::prelude::*;

pub struct Puck {
    pub mass: f64,
}

#[lagrangian(coordinates = [x, y], inputs = [glue])]
impl Puck {
    #[point(mass = self.mass)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    fn roughness(&self, u: &Inputs) -> f64 {
        u.glue
    }

    #[friction(coefficient = roughness, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

fn main() {}
