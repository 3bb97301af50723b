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

fn rests_in_its_frame(_: &impl lagrangian::Scleronomic<1>) {}

fn turns_freely(_: &impl lagrangian::Cyclic<1>) {}

pub struct Skate;

#[lagrangian(coordinates = [x, y, heading])]
impl Skate {
    #[point(mass = 1.0)]
    fn blade(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        0.5 * v.heading.powi(2)
    }

    #[nonholonomic]
    fn no_slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.y * q.heading.cos() - v.x * q.heading.sin()
    }
}

fn goes_everywhere(_: &impl lagrangian::Holonomic<3>) {}

fn main() {
    rests_in_its_frame(&Driven { amplitude: 0.1 });
    turns_freely(&Driven { amplitude: 0.1 });
    goes_everywhere(&Skate);
    stays_at_its_energy(&Driven { amplitude: 0.1 });
}
