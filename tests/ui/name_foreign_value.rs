//! A variant of an enum of the standard library.

use lagrangian::prelude::*;

pub struct Spring {
    pub mass: f64,
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x])]
impl Spring {
    #[point(mass = self.mass)]
    fn block(&self, q: &Coordinates) -> f64 {
        q.x
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        let stretch = Some(q.x).unwrap();
        0.5 * self.stiffness * stretch * stretch
    }
}

fn main() {}
