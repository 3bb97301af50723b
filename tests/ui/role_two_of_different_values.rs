//! Two roles on a function that returns what one of them takes.

use lagrangian::prelude::*;

pub struct Bead {
    pub mass: f64,
}

#[lagrangian(coordinates = [x])]
impl Bead {
    #[potential]
    #[point(mass = self.mass)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.x * q.x)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * self.mass * self.bead(q).y
    }
}

fn main() {}
