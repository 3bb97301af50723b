//! A mistake in a helper that three roles use is reported once.

use lagrangian::prelude::*;

pub struct Pendulum {
    pub mass: f64,
    pub length: f64,
    pub g: f64,
}

#[lagrangian(coordinates = [theta])]
impl Pendulum {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        self.length * Vector2::new(q.thta.sin(), -q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * self.bob(q).y
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        self.bob(q).x.powi(2)
    }

    #[force(at = bob)]
    fn wind(&self, t: f64) -> Vector2<f64> {
        Vector2::new(t.sin(), 0.0)
    }
}

fn main() {}
