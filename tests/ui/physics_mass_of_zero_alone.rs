//! A particle of mass zero that is all of a coordinate's inertia.

use lagrangian::prelude::*;

pub struct Bead {
    pub weight: f64,
}

#[lagrangian(coordinates = [x])]
impl Bead {
    #[point(mass = 0.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.x * q.x)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.weight * self.bead(q).y
    }
}

fn main() {}
