//! A function of the user's own that demands what the system does not have.

use lagrangian::prelude::*;

pub struct Driven {
    pub amplitude: f64,
}

#[lagrangian(coordinates = [x])]
impl Driven {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates, t: f64) -> Vector1<f64> {
        Vector1::new(q.x + self.amplitude * t.sin())
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * q.x.powi(2)
    }
}

fn stays_at_its_energy(_: &impl lagrangian::Conservative<1>) {}

fn main() {
    stays_at_its_energy(&Driven { amplitude: 0.1 });
}
