//! Constants that no coefficient of a contact can be: a restitution above one, negative friction, and static friction
//! below the kinetic one.

use lagrangian::prelude::*;

pub struct Puck {
    pub mass: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Puck {
    #[point(mass = self.mass)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[unilateral(restitution = 1.5)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[friction(coefficient = -0.2, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }

    #[friction(limit = -1.0)]
    fn rail(&self, v: &Velocities) -> f64 {
        v.x - v.y
    }

    #[friction(limit = 5.0, static_limit = 2.0)]
    fn brake(&self, v: &Velocities) -> f64 {
        v.x + v.y
    }
}

fn main() {}
