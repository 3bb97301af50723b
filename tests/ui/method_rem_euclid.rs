//! A remainder.

use lagrangian::prelude::*;

pub struct Well;

#[lagrangian(coordinates = [x])]
impl Well {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        q.x.rem_euclid(2.0)
    }
}

fn main() {}
