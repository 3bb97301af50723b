//! An implicit method for a system without generated derivatives.

use lagrangian::prelude::*;

pub struct Pendulum {
    pub length: f64,
}

#[lagrangian(coordinates = [theta])]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        self.length * Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).y
    }
}

fn main() {
    let pendulum = Pendulum { length: 1.0 };
    let _ = pendulum.stepper::<Gauss6>(State::at_rest([1.0]));
}
