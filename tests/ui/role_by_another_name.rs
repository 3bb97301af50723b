//! A role by a word that others use.

use lagrangian::prelude::*;

pub struct Oscillator;

#[lagrangian(coordinates = [x])]
impl Oscillator {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[damping]
    fn damper(&self, v: &Velocities) -> f64 {
        0.1 * v.x * v.x
    }
}

fn main() {}
