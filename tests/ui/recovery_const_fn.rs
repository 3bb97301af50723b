//! A constant function beside a mistake.

use lagrangian::prelude::*;

pub struct Block {
    pub mass: f64,
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x])]
impl Block {
    pub const COUNT: usize = Self::count();

    const fn count() -> usize {
        2
    }

    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.y.powi(2)
    }
}

fn main() {
    println!("{}", [0.0; Block::COUNT].len());
}
