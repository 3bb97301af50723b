//! A mistake in the description does not make its uses wrong.

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
        self.length * Vector2::new((std::f64::consts::PI - q.thta).sin(), (std::f64::consts::PI - q.theta).cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * self.bob(q).y
    }
}

fn main() {
    let pendulum = Pendulum { mass: 1.0, length: 1.0, g: 9.81 };
    let start = State::at_rest([1.0]);
    let place: PendulumCoordinates = start.q.into();
    println!("{} {}", pendulum.bob(&place), PendulumCoordinates { theta: 1.0 }.theta);
    println!("{} {}", Pendulum::STRUCTURE, Pendulum::COST);
    println!("{} {:?}", pendulum.energy(&start), pendulum.accelerations(&start));
    let mut motion = pendulum.simulate(start);
    let _ = motion.advance_to(1.0);
    let _ = pendulum.stepper::<Rk4>(start).step(1e-3, &[]);
    let _ = pendulum.stepper::<Jet<6>>(start).step(1e-3, &[]);
}
