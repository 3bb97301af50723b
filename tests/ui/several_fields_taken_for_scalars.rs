//! A field that is a vector, in a product that does not tell.
use lagrangian::prelude::*;

struct Spring {
    mass: f64,
    anchor: Vector2<f64>,
}

#[lagrangian(coordinates = [x, y])]
impl Spring {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y) + self.anchor * q.x
    }

    #[potential]
    fn energy(&self, q: &Coordinates) -> f64 {
        (self.anchor * 2.0).norm() * q.x
    }
}

fn main() {}
