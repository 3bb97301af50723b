//! Constants that are wrong for all gaps and slips of an array.

use lagrangian::prelude::*;

pub struct Feet;

#[lagrangian(coordinates = [x, y: [2]])]
impl Feet {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.x * v.x + v.y[0] * v.y[0] + v.y[1] * v.y[1])
    }

    #[unilateral(restitution = 1.5)]
    fn floor(&self, q: &Coordinates) -> [f64; 2] {
        q.y
    }

    #[friction(coefficient = -0.2, normal = floor)]
    fn slip(&self, v: &Velocities) -> [f64; 2] {
        [v.x, 2.0 * v.x]
    }
}

fn main() {}
