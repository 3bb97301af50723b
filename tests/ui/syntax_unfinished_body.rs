//! A body that is being written; the rest of the program uses the system.

use lagrangian::prelude::*;

pub struct Pendulum {
    pub mass: f64,
    pub length: f64,
    pub gravity: f64,
}

#[lagrangian(coordinates = [theta], analysis)]
impl Pendulum {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        self.length * Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        let height = self.bob(q).;
        self.mass * self.gravity * height
    }
}

fn main() {
    let pendulum = Pendulum { mass: 1.0, length: 1.0, gravity: 9.81 };
    let mut motion = pendulum.simulate(State::at_rest([1.0]));
    motion.advance_to(1.0).unwrap();
    let angles = PendulumCoordinates::from(motion.state().q);
    println!("{} {} {:?}", angles.theta, pendulum.energy(motion.state()), pendulum.verify());
}
