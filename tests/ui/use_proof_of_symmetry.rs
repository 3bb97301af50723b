//! A function of the user's own that demands a cyclic coordinate.

use lagrangian::prelude::*;

pub struct Oscillator;

#[lagrangian(coordinates = [x])]
impl Oscillator {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * q.x.powi(2)
    }
}

fn moves_freely(_: &impl lagrangian::Cyclic<1>) {}

fn main() {
    moves_freely(&Oscillator);
}
