//! A body that returns a position.

use lagrangian::prelude::*;

pub struct Bar {
    pub mass: f64,
    pub inertia: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Bar {
    #[body(mass = self.mass, inertia = self.inertia)]
    fn bar(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }
}

fn main() {}
