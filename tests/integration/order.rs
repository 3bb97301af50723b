//! Measured orders of the methods, two-sided, on generated equations.

use lagrangian::prelude::*;

use crate::support::close::between;
use crate::support::motion::state_at;

struct Pendulum;

#[lagrangian(coordinates = [theta, r])]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta.sin(), -q.theta.cos()) * q.r
    }

    #[potential]
    fn energy_of_place(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).y + 20.0 * (q.r - 1.0).powi(2)
    }
}

fn start() -> State<f64, 2> {
    State::new([1.0, 1.1], [0.5, 0.0])
}

fn distance(found: &State<f64, 2>, exact: &State<f64, 2>) -> f64 {
    found.iter().zip(exact.iter()).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn rk4_is_of_order_four() {
    let exact = state_at(&Pendulum, start(), 1.0);
    let error = |steps: u32| {
        let mut motion = Pendulum.stepper::<Rk4>(start());
        for _ in 0..steps {
            motion.step(1.0 / f64::from(steps), &[]).unwrap();
        }
        distance(motion.state(), &exact)
    };
    between(3.9, (error(100) / error(200)).log2(), 4.1);
    between(3.9, (error(200) / error(400)).log2(), 4.1);
}

#[test]
fn dop853_is_of_order_eight() {
    let exact = state_at(&Pendulum, start(), 4.0);
    // A tolerance that accepts every step leaves the limit in charge.
    let error = |h: f64| {
        let motion = Pendulum.simulate_with::<Dop853>(start());
        let mut motion = motion.with_tolerance(1e6).with_step_limit(h);
        distance(motion.advance_to(4.0).unwrap(), &exact)
    };
    between(7.5, (error(0.1) / error(0.05)).log2(), 8.5);
}

#[test]
fn samples_are_as_good_as_the_tolerance() {
    let worst = |tolerance: f64| {
        let mut motion = Pendulum.simulate(start()).with_tolerance(tolerance);
        let samples = motion.every(0.37).take(11).map(Result::unwrap);
        samples.map(|s| distance(&s, &state_at(&Pendulum, start(), s.t))).fold(0.0, f64::max)
    };
    between(1e-8, worst(1e-6), 1e-4);
    between(1e-12, worst(1e-10), 1e-8);
}
