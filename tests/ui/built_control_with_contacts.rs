//! A control of the state on a system that goes through contacts with inputs that are held.

use lagrangian::prelude::*;

pub struct Ball;

#[lagrangian(coordinates = [y], inputs = [thrust])]
impl Ball {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.y * v.y
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[force(on = y)]
    fn engine(&self, u: &Inputs) -> f64 {
        u.thrust
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

fn main() {
    let _ = Ball.simulate(State::at_rest([1.0])).with_control(|state| [-state.v[0]]);
}
