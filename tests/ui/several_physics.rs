//! Several mistakes of physics are reported at once.

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
        self.length * Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * self.bob(q).y
    }

    #[potential]
    fn offset(&self) -> f64 {
        self.g
    }

    #[dissipation]
    fn damper(&self, q: &Coordinates) -> f64 {
        q.theta
    }
}

fn main() {}
