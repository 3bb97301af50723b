//! Explicit time: moving points and supports, driven potentials, forces, and what becomes of the energy.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close, close_on};
use crate::support::difference::slope;
use crate::support::identities::model;
use crate::support::motion::follows;
use crate::support::sample::Samples;

/// A pendulum whose support moves up and down.
struct Shaken {
    m: f64,
    l: f64,
    g: f64,
    amplitude: f64,
    rate: f64,
}

#[lagrangian(coordinates = [theta])]
impl Shaken {
    fn support(&self, t: f64) -> f64 {
        self.amplitude * (self.rate * t).cos()
    }

    #[point(mass = self.m)]
    fn bob(&self, q: &Coordinates, t: f64) -> Vector2<f64> {
        Vector2::new(self.l * q.theta.sin(), self.support(t) - self.l * q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates, t: f64) -> f64 {
        self.m * self.g * self.bob(q, t).y
    }
}

const SHAKEN: Shaken = Shaken { m: 0.7, l: 1.3, g: 9.81, amplitude: 0.2, rate: 5.0 };

#[test]
fn a_shaken_support_adds_its_acceleration_to_gravity() {
    let mut samples = Samples::new(1);
    for _ in 0..10 {
        let state: State<f64, 1> = samples.state(-3.0, 3.0);
        let Shaken { l, g, amplitude, rate, .. } = SHAKEN;
        let lift = -amplitude * rate * rate * (rate * state.t).cos();
        let expected = -(g + lift) / l * state.q[0].sin();
        close(SHAKEN.accelerations(&state).unwrap()[0], expected, 1e-13);
        let kinetic = {
            let support = -amplitude * rate * (rate * state.t).sin();
            let (sin, cos) = state.q[0].sin_cos();
            let speed = [l * cos * state.v[0], l * sin * state.v[0] + support];
            0.5 * SHAKEN.m * (speed[0].powi(2) + speed[1].powi(2))
        };
        close(SHAKEN.kinetic_energy(&state), kinetic, 1e-14);
        close(SHAKEN.potential_energy(&state), SHAKEN.gravity(&state.q.into(), state.t), 1e-14);
    }
    model!(SHAKEN, jacobi).holds(-1.0, 1.0);
}

/// An oscillator with a swelling spring, pushed in time.
struct Driven {
    m: f64,
    k: f64,
}

#[lagrangian(coordinates = [x])]
impl Driven {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.m * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates, time: f64) -> f64 {
        0.5 * self.k * (1.0 + 0.1 * time) * q.x.powi(2)
    }

    #[force]
    fn push(&self, t: f64) -> [f64; 1] {
        [3.0 * (2.0 * t).sin()]
    }
}

#[test]
fn potentials_and_forces_may_depend_on_time() {
    let driven = Driven { m: 2.0, k: 7.0 };
    let state = State::new([0.5], [-1.0]).at_time(4.0);
    close(driven.bias(&state)[0], 7.0 * 1.4 * 0.5, 1e-15);
    close(driven.applied_forces(&state)[0], 3.0 * 8.0_f64.sin(), 1e-15);
    close(driven.accelerations(&state).unwrap()[0], (3.0 * 8.0_f64.sin() - 4.9) / 2.0, 1e-14);
    close(driven.power(&state), -3.0 * 8.0_f64.sin(), 1e-15);
    model!(driven, forces).holds(-2.0, 2.0);
}

/// A coordinate relative to a wagon that accelerates: x(t) = s + a t²/2.
struct Wagon {
    a: f64,
}

#[lagrangian(coordinates = [s])]
impl Wagon {
    #[kinetic]
    fn kinetic(&self, v: &Velocities, t: f64) -> f64 {
        (v.s + self.a * t).powi(2) / 2.0
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        2.0 * q.s * q.s
    }
}

#[test]
fn a_kinetic_energy_may_be_linear_in_the_velocity() {
    let wagon = Wagon { a: 3.0 };
    let state = State::new([0.25], [1.5]).at_time(2.0);
    // The inertia force −a, though T depends on t and v alone.
    close(wagon.accelerations(&state).unwrap()[0], -3.0 - 4.0 * 0.25, 1e-15);
    close(wagon.momenta(&state)[0], 7.5, 1e-15);
    close(wagon.jacobi_integral(&state), 1.5 * 7.5 - (7.5 * 7.5 / 2.0 - 0.125), 1e-15);
    model!(wagon, jacobi).holds(-2.0, 2.0);
    // s″ = −a − 4 s from rest at 0: s = −(a/4)(1 − cos 2t).
    let exact = |t: f64| (t, [-0.75 * (1.0 - (2.0 * t).cos()), -1.5 * (2.0 * t).sin()]);
    follows(&wagon, State::at_rest([0.0]), [0.7, 2.0, 9.0].map(exact), 1e-12);
}

/// A plate that turns at a given rate with an inertia of its own.
struct Turntable {
    rate: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Turntable {
    /// In space; the coordinates are those of the turning plate.
    #[body(mass = 2.0, inertia = 0.3)]
    fn puck(&self, q: &Coordinates, t: f64) -> Isometry2<f64> {
        let plate = Isometry2::new(Vector2::zeros(), self.rate * t);
        plate * Isometry2::new(Vector2::new(q.x, q.y), q.x * q.y)
    }
}

#[test]
fn a_body_may_ride_on_a_moving_frame() {
    let table = Turntable { rate: 1.7 };
    model!(table, jacobi).holds(-1.0, 1.0);
    let state = State::new([0.4, -0.2], [0.5, 0.9]).at_time(0.6);
    let place = |axis: usize| {
        slope(0.005, |h| {
            let q = TurntableCoordinates { x: 0.4 + 0.5 * h, y: -0.2 + 0.9 * h };
            table.puck(&q, 0.6 + h).translation.vector[axis]
        })
    };
    let turn = 1.7 + 0.5 * -0.2 + 0.4 * 0.9;
    let expected = place(0).powi(2) + place(1).powi(2) + 0.15 * turn * turn;
    close(table.kinetic_energy(&state), expected, 1e-11);
}

#[test]
fn a_motion_may_start_at_any_time() {
    let driven = Driven { m: 2.0, k: 7.0 };
    let whole = *driven.simulate(State::at_rest([1.0])).with_tolerance(1e-14).advance_to(6.0).unwrap();
    let mut motion = driven.simulate(State::at_rest([1.0])).with_tolerance(1e-14);
    let half = *motion.advance_to(3.0).unwrap();
    let rest = *driven.simulate(half).with_tolerance(1e-14).advance_to(6.0).unwrap();
    all_close([rest.t, rest.q[0], rest.v[0]], [whole.t, whole.q[0], whole.v[0]], 1e-11);
}

/// A mass on a spring, pushed by a force that changes linearly between two calls of `set_inputs`.
struct Pushed;

#[lagrangian(coordinates = [x], inputs = [force, slope, since])]
impl Pushed {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * q.x * q.x
    }

    #[force(on = x)]
    fn push(&self, u: &Inputs, t: f64) -> f64 {
        u.force + u.slope * (t - u.since)
    }
}

/// The steps over ten seconds, with a force that is a triangle of this slope.
fn pushed(slope: f64) -> u64 {
    let mut motion = Pushed.simulate(State::at_rest([0.0])).with_tolerance(1e-13);
    let (mut x, mut v) = (0.0, 0.0);
    for second in 0..10 {
        let since = f64::from(second);
        let (force, slope) = if second % 2 == 0 { (0.5, slope) } else { (0.5 + slope, -slope) };
        motion.set_inputs([force, slope, since]);
        let state = *motion.advance_to(since + 1.0).unwrap();
        // A vibration about the line x = force + slope (t − since).
        let ((sine, cosine), a, b) = (1.0_f64.sin_cos(), x - force, v - slope);
        (x, v) = (force + slope + a * cosine + b * sine, slope - a * sine + b * cosine);
        close_on(1.0, state.q[0], x, 1e-13);
        close_on(1.0, state.v[0], v, 1e-13);
    }
    motion.steps().accepted
}

#[test]
fn an_input_may_be_a_polynomial_of_a_step() {
    // A series includes the line as it includes a constant input: one step a second.
    assert_eq!(pushed(0.0), pushed(0.7));
}
