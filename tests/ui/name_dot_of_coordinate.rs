//! A velocity by a name of its own.

use lagrangian::prelude::*;

pub struct Wheel {
    pub inertia: f64,
}

#[lagrangian(coordinates = [theta])]
impl Wheel {
    #[kinetic]
    fn turning(&self, q: &Coordinates) -> f64 {
        0.5 * self.inertia * q.theta_dot.powi(2)
    }
}

fn main() {}
