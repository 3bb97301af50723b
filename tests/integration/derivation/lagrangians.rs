//! L given as a whole: magnetic, relativistic, indefinite, and together with T and V.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};
use crate::support::identities::model;
use crate::support::motion::follows;
use crate::support::sample::Samples;

/// A charge in a constant magnetic field along z and an electric field along x.
struct Charge {
    m: f64,
    e: f64,
    b: f64,
    field: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl Charge {
    #[lagrangian]
    fn charge(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let velocity = Vector3::new(v.x, v.y, v.z);
        let potential = self.b / 2.0 * Vector3::new(-q.y, q.x, 0.0);
        0.5 * self.m * velocity.norm_squared() + self.e * velocity.dot(&potential) + self.e * self.field * q.x
    }
}

#[test]
fn a_charge_drifts_across_crossed_fields() {
    let charge = Charge { m: 2.0, e: 3.0, b: 4.0, field: 5.0 };
    let state = State::new([0.1, 0.2, 0.3], [1.0, -2.0, 0.5]);
    all_close(charge.accelerations(&state).unwrap(), [3.0 * (5.0 - 8.0) / 2.0, -6.0, 0.0], 1e-15);
    all_close(charge.momenta(&state), [2.0 - 1.2, -4.0 + 0.6, 1.0], 1e-14);
    close(charge.kinetic_energy(&state), 5.25, 1e-15);
    close(charge.potential_energy(&state), -1.5, 1e-15);
    close(charge.energy(&state), 3.75, 1e-15);
    model!(charge).holds(-1.0, 1.0);
    // The cycloid from rest: rate e b/m = 6, drift E × B/B² = (0, −5/4).
    let exact = |t: f64| {
        let (sin, cos) = (6.0 * t).sin_cos();
        let (radius, drift) = (1.25 / 6.0, -1.25);
        (t, [radius * (1.0 - cos), drift * t + radius * sin, 0.0, 1.25 * sin, drift + 1.25 * cos, 0.0])
    };
    follows(&charge, State::at_rest([0.0; 3]), [0.3, 2.0, 10.0].map(exact), 1e-10);
}

/// A relativistic particle in a constant field.
struct Relativistic {
    m: f64,
    c: f64,
    force: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Relativistic {
    #[lagrangian]
    fn particle(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let beta = (v.x.powi(2) + v.y.powi(2)) / self.c.powi(2);
        self.force * q.x - self.m * self.c.powi(2) * (1.0 - beta).sqrt()
    }
}

#[test]
fn a_relativistic_particle_obeys_the_textbook() {
    let particle = Relativistic { m: 1.5, c: 2.0, force: 3.0 };
    let state = State::new([0.3, 0.0], [0.8, -1.2]);
    let gamma = 1.0 / (1.0 - (0.64 + 1.44) / 4.0_f64).sqrt();
    all_close(particle.momenta(&state), [1.5 * gamma * 0.8, -1.5 * gamma * 1.2], 1e-14);
    // a = (F − (F·v) v/c²)/(γ m).
    let along = 3.0 * 0.8 / 4.0;
    let expected = [(3.0 - along * 0.8) / (gamma * 1.5), along * 1.2 / (gamma * 1.5)];
    all_close(particle.accelerations(&state).unwrap(), expected, 1e-14);
    close(particle.kinetic_energy(&state), (gamma - 1.0) * 1.5 * 4.0, 1e-14);
    close(particle.energy(&state), gamma * 6.0 - 0.9, 1e-14);
    close(particle.potential_energy(&state), 6.0 - 0.9, 1e-14);
    model!(particle).holds(-0.5, 0.5);
    // Hyperbolic motion from rest: x = (m c²/F)(√(1 + (F t/m c)²) − 1).
    let exact = |t: f64| {
        let root = (1.0 + t * t).sqrt();
        (t, [2.0 * (root - 1.0), 0.0, 2.0 * t / root, 0.0])
    };
    follows(&particle, State::at_rest([0.0, 0.0]), [1.0, 5.0, 50.0].map(exact), 1e-11);
}

/// Bateman's pair: a damped oscillator and its mirror image, with an indefinite mass matrix.
struct Bateman {
    damping: f64,
    k: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Bateman {
    #[lagrangian]
    fn inertia(&self, v: &Velocities) -> f64 {
        v.x * v.y
    }

    #[lagrangian]
    fn rest(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.damping / 2.0 * (q.x * v.y - v.x * q.y) - self.k * q.x * q.y
    }
}

#[test]
fn an_indefinite_mass_matrix_is_solved() {
    let pair = Bateman { damping: 0.3, k: 4.0 };
    let state = State::new([0.5, 0.7], [-0.2, 0.9]);
    assert_eq!(pair.mass_matrix(&state), Matrix2::new(0.0, 1.0, 1.0, 0.0));
    let expected = [-0.3 * -0.2 - 4.0 * 0.5, 0.3 * 0.9 - 4.0 * 0.7];
    all_close(pair.accelerations(&state).unwrap(), expected, 1e-14);
    model!(pair).holds(-1.0, 1.0);
    let exact = |t: f64| {
        let own = (4.0 - 0.0225_f64).sqrt();
        let (sin, cos) = (own * t).sin_cos();
        let decay = (-0.15 * t).exp();
        (decay * (cos + 0.15 / own * sin), -decay * 4.0 / own * sin)
    };
    let mut motion = pair.simulate(State::at_rest([1.0, 0.0])).with_tolerance(1e-15);
    for t in [1.0, 5.0, 20.0] {
        let state = motion.advance_to(t).unwrap();
        let (x, rate) = exact(t);
        all_close([state.q[0], state.v[0]], [x, rate], 1e-11);
    }
}

/// The parts of one system in four roles, against the sum as one Lagrangian.
struct Parts {
    k: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Parts {
    #[point(mass = 1.0)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x * q.x, q.y)
    }

    #[kinetic]
    fn flywheel(&self, q: &Coordinates, v: &Velocities) -> f64 {
        (2.0 + q.x.sin()) * v.y.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        self.k * (q.x - q.y).powi(2)
    }

    #[lagrangian]
    fn gyroscope(&self, q: &Coordinates, v: &Velocities) -> f64 {
        q.x * q.y * (v.x - v.y) + q.y.cos()
    }
}

struct Whole {
    k: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Whole {
    #[lagrangian]
    fn whole(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let particle = 0.5 * ((2.0 * q.x * v.x).powi(2) + v.y * v.y);
        let flywheel = (2.0 + q.x.sin()) * v.y.powi(2);
        particle + flywheel - self.k * (q.x - q.y).powi(2) + q.x * q.y * (v.x - v.y) + q.y.cos()
    }
}

#[test]
fn roles_add_up_to_one_lagrangian() {
    let (parts, whole) = (Parts { k: 3.0 }, Whole { k: 3.0 });
    let mut samples = Samples::new(6);
    for _ in 0..10 {
        let state = samples.state(0.5, 1.5);
        all_close(parts.mass_matrix(&state).as_slice(), whole.mass_matrix(&state).as_slice(), 1e-14);
        all_close(parts.bias(&state), whole.bias(&state), 1e-12);
        all_close(parts.momenta(&state), whole.momenta(&state), 1e-13);
        all_close(parts.accelerations(&state).unwrap(), whole.accelerations(&state).unwrap(), 1e-12);
        close(parts.energy(&state), whole.energy(&state), 1e-13);
        close(parts.kinetic_energy(&state), whole.kinetic_energy(&state), 1e-13);
        close(parts.potential_energy(&state), whole.potential_energy(&state), 1e-13);
    }
    model!(parts).holds(0.5, 1.5);
    model!(whole).holds(0.5, 1.5);
}
