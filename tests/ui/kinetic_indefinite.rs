//! A kinetic energy with a product of velocities alone.

use lagrangian::prelude::*;

pub struct Saddle;

#[lagrangian(coordinates = [x, y])]
impl Saddle {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        v.x * v.y
    }
}

fn main() {}
