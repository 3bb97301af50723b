//! A position as a pair of numbers, which another function uses.

use lagrangian::prelude::*;

pub struct Bead {
    pub mass: f64,
}

#[lagrangian(coordinates = [x])]
impl Bead {
    #[point(mass = self.mass)]
    fn bead(&self, q: &Coordinates) -> (f64, f64) {
        (q.x, q.x * q.x)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * self.mass * self.bead(q).y
    }
}

fn main() {}
