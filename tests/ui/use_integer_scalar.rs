//! A generic system of integers.

use lagrangian::prelude::*;

pub struct Block<R> {
    pub mass: R,
}

#[lagrangian(coordinates = [x])]
impl<R: Real> Block<R> {
    #[kinetic]
    fn kinetic(&self, v: &Velocities<R>) -> R {
        0.5 * self.mass * v.x * v.x
    }
}

fn main() {
    let block = Block { mass: 1 };
    let _ = block.energy(&State::at_rest([0.0]));
}
