//! Dormand and Prince's method alone on a system with contacts.

use lagrangian::prelude::*;

pub struct Ball;

#[lagrangian(coordinates = [y])]
impl Ball {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.y * v.y
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

fn main() {
    let _ = Ball.simulate_with::<Dop853>(State::at_rest([1.0]));
}
