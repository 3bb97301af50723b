//! A force on a place that does not follow from the form of its constraint.

use lagrangian::prelude::*;

struct Sleeve;

#[lagrangian(coordinates = [s, phi])]
impl Sleeve {
    /// On a rod that turns: two coordinates, three components.
    #[point(mass = 1.0)]
    fn ring(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.s * q.phi.cos(), q.s * q.phi.sin(), 0.1 * q.s)
    }

    #[holonomic]
    fn drive(&self, q: &Coordinates, t: f64) -> f64 {
        q.phi - 2.0 * t
    }

    #[friction(coefficient = 0.2, normal = ring)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.s
    }
}

fn main() {}
