//! Energy over long runs, its dependence on the tolerance, and the work of forces that are not conservative.

use lagrangian::prelude::*;

use crate::support::close::{between, close};
use crate::support::motion::{TIGHT, drift};

struct DoublePendulum {
    m: [f64; 2],
    l: [f64; 2],
    g: f64,
}

#[lagrangian(coordinates = [theta: [2]])]
impl DoublePendulum {
    #[point(mass = self.m[0])]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        self.l[0] * Vector2::new(q.theta[0].sin(), -q.theta[0].cos())
    }

    #[point(mass = self.m[1])]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        self.upper(q) + self.l[1] * Vector2::new(q.theta[1].sin(), -q.theta[1].cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.g * (self.m[0] * self.upper(q).y + self.m[1] * self.lower(q).y)
    }
}

const PENDULUM: DoublePendulum = DoublePendulum { m: [1.0, 1.0], l: [1.0, 1.0], g: 9.81 };

/// Chaotic: it turns over.
fn wild() -> State<f64, 2> {
    State::at_rest([2.0, 2.5])
}

fn drift_at(tolerance: f64) -> f64 {
    let mut motion = PENDULUM.simulate(wild()).with_tolerance(tolerance);
    drift(&mut motion, 0.5, 100, |s| PENDULUM.energy(s))
}

#[test]
fn a_chaotic_pendulum_keeps_its_energy_for_a_thousand_seconds() {
    let mut motion = PENDULUM.simulate(wild()).with_tolerance(TIGHT);
    let turned = motion.every(1.0).take(51).map(|s| s.unwrap().q[1].abs()).fold(0.0, f64::max);
    assert!(turned > std::f64::consts::TAU, "the motion is wild: {turned}");
    between(-1.0, drift(&mut motion, 1.0, 950, |s| PENDULUM.energy(s)), 1e-10);
}

#[test]
fn the_tolerance_controls_the_energy() {
    between(1e-7, drift_at(1e-5), 1e-1);
    between(1e-12, drift_at(1e-9), 1e-5);
    between(1e2, drift_at(1e-5) / drift_at(1e-9), 1e6);
}

#[test]
fn the_default_tolerance_is_good_for_a_millionth() {
    let mut motion = PENDULUM.simulate(wild());
    between(1e-13, drift(&mut motion, 0.5, 100, |s| PENDULUM.energy(s)), 1e-6);
}

#[test]
fn the_motion_reports_the_energy_of_its_state() {
    let mut motion = PENDULUM.simulate(wild());
    motion.advance_to(3.0).unwrap();
    let state = *motion.state();
    close(motion.energy(), PENDULUM.energy(&state), 1e-15);
    let stepper = PENDULUM.stepper::<Rk4>(state);
    close(stepper.energy(), PENDULUM.energy(&state), 1e-15);
}

/// A pendulum with friction in the bearing and a motor.
struct Driven {
    damping: f64,
}

#[lagrangian(coordinates = [theta], inputs = [motor])]
impl Driven {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).y
    }

    #[dissipation]
    fn bearing(&self, v: &Velocities) -> f64 {
        0.5 * self.damping * v.theta.powi(2)
    }

    #[force(on = theta)]
    fn motor(&self, u: &Inputs) -> f64 {
        u.motor
    }
}

#[test]
fn the_change_of_energy_is_the_work_of_the_forces() {
    let driven = Driven { damping: 0.3 };
    let torque = [1.5];
    let start = State::new([0.5], [2.0]);
    let (steps, dt) = (400, 0.01);
    let mut motion = driven.simulate(start).with_tolerance(1e-14).with_inputs(torque);
    let states: Vec<_> = motion.every(dt).take(steps + 1).map(Result::unwrap).collect();
    // Boole's rule, of order six.
    let weights = |k: usize| match k % 4 {
        _ if k == 0 || k == steps => 7.0,
        0 => 14.0,
        2 => 12.0,
        _ => 32.0,
    };
    let power = |(k, state): (usize, &State<f64, 1>)| weights(k) * driven.power(state, &torque);
    let work = 2.0 * dt / 45.0 * states.iter().enumerate().map(power).sum::<f64>();
    let change = driven.energy(&states[steps]) - driven.energy(&start);
    assert!(change.abs() > 0.5, "there is work to speak of: {change}");
    close(work, change, 1e-10);
}

#[test]
fn friction_alone_brings_the_pendulum_to_rest() {
    let driven = Driven { damping: 0.3 };
    let mut motion = driven.simulate(State::at_rest([2.0]));
    let mut before = motion.energy();
    for _ in 0..100 {
        motion.advance_by(1.0).unwrap();
        assert!(motion.energy() < before + 1e-9, "the energy never rises");
        before = motion.energy();
    }
    close(before, -9.81, 1e-9);
}
