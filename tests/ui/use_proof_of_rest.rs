//! A function of the user's own that demands a system which nothing moves from outside.

use lagrangian::prelude::*;

pub struct Shaken;

#[lagrangian(coordinates = [x])]
impl Shaken {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates, t: f64) -> Vector1<f64> {
        Vector1::new(q.x + 0.1 * t.sin())
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * q.x.powi(2)
    }
}

fn rests_in_its_frame(_: &impl lagrangian::Scleronomic<1>) {}

fn main() {
    rests_in_its_frame(&Shaken);
}
