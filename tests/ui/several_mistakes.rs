//! A user in a hurry: everything is reported at once.

use lagrangian::prelude::*;

pub struct CartPole {
    pub cart_mass: f64,
    pub pole_mass: f64,
    pub length: f64,
    pub g: f64,
    pub damping: f64,
}

#[lagrangian(coordinates = [x, theta, phi], inputs = [motor])]
impl CartPole {
    #[point]
    fn cart(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    #[point(mass = self.pole_mass)]
    fn tip(&self, q: &Coordinates) -> Vector2<f64> {
        self.cart(q) + self.length * Vector2::new(q.thta.sin(), q.theta.cos())
    }

    #[potental]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.pole_mass * self.g * self.tip(q).y
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        2 * q.x.powi(2) + q.theta.floor()
    }

    #[dissipation]
    fn bearing(&self, v: &Velocity) -> f64 {
        0.5 * self.damping * v.theta.powi(2)
    }

    #[force(at = card)]
    fn drive(&self, u: &Inputs) -> Vector2<f64> {
        Vector2::new(u.motor, 0.0)
    }

    #[evnt]
    fn rail(&self, q: &Coordinates) -> f64 {
        q.phi
    }
}

fn main() {}
