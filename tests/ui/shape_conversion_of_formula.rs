//! A formula converted as a whole.

use lagrangian::prelude::*;

pub struct Block<R> {
    pub mass: R,
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x])]
impl<R: Real> Block<R> {
    #[kinetic]
    fn kinetic(&self, v: &Velocities<R>) -> R {
        0.5 * self.mass * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates<R>) -> R {
        R::from_f64(0.5 * self.stiffness) * q.x.powi(2)
    }
}

fn main() {}
