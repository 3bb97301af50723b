//! A function of the user's own that demands a system whose velocities are free.

use lagrangian::prelude::*;

pub struct Skate;

#[lagrangian(coordinates = [x, y, heading])]
impl Skate {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (v.x.powi(2) + v.y.powi(2) + 0.1 * v.heading.powi(2))
    }

    #[nonholonomic]
    fn no_slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.y * q.heading.cos() - v.x * q.heading.sin()
    }
}

fn goes_everywhere(_: &impl lagrangian::Holonomic<3>) {}

fn main() {
    goes_everywhere(&Skate);
}
