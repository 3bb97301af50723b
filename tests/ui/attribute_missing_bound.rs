//! A type parameter without the bound `Real`.

use lagrangian::prelude::*;

pub struct Block<R> {
    pub mass: R,
}

#[lagrangian(coordinates = [x])]
impl<R> Block<R> {
    #[kinetic]
    fn kinetic(&self, v: &Velocities<R>) -> R {
        self.mass * v.x * v.x
    }
}

fn main() {}
