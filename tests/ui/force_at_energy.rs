//! A force at a potential.

use lagrangian::prelude::*;

pub struct Cart {
    pub mass: f64,
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x])]
impl Cart {
    #[point(mass = self.mass)]
    fn cart(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.x.powi(2)
    }

    #[force(at = spring)]
    fn push(&self, t: f64) -> f64 {
        t.sin()
    }
}

fn main() {}
