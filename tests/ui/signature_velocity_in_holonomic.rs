//! A condition on the velocity, given as one on the position.

use lagrangian::prelude::*;

pub struct Bead {
    pub mass: f64,
    pub speed: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Bead {
    #[point(mass = self.mass)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[holonomic]
    fn drive(&self, v: &Velocities) -> f64 {
        v.x - self.speed
    }
}

fn main() {}
