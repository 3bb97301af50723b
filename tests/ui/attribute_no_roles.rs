//! No function has a role.

use lagrangian::prelude::*;

pub struct Block {
    pub stiffness: f64,
}

#[lagrangian(coordinates = [x])]
impl Block {
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.x.powi(2)
    }
}

fn main() {}
