//! S13: a particle inside a hemisphere, in spherical coordinates that keep the radius, and in Cartesian ones.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, EASY, G};
use crate::support::close::{between, close};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, both_follow, drift, state_at};
use crate::support::reference::seed;

/// φ is measured from the upward vertical.
struct Spherical {
    m: f64,
    radius: f64,
}

#[lagrangian(coordinates = [r, phi, theta])]
impl Spherical {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let around = q.phi.sin() * v.theta;
        self.m * (v.r.powi(2) + q.r.powi(2) * (v.phi.powi(2) + around.powi(2))) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * q.r * q.phi.cos()
    }

    #[holonomic]
    fn bowl(&self, q: &Coordinates) -> f64 {
        q.r - self.radius
    }
}

struct Cartesian {
    m: f64,
    radius: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl Cartesian {
    #[point(mass = self.m)]
    fn particle(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * q.z
    }

    #[holonomic]
    fn bowl(&self, q: &Coordinates) -> f64 {
        self.particle(q).norm() - self.radius
    }
}

const RADIUS: f64 = 1.2;
const SPHERICAL: Spherical = Spherical { m: 0.8, radius: RADIUS };
const CARTESIAN: Cartesian = Cartesian { m: 0.8, radius: RADIUS };
const START: [f64; 4] = [2.2, 0.0, 0.5, 1.8];

fn spherical([phi, theta, dphi, dtheta]: [f64; 4]) -> State<f64, 3> {
    State::new([RADIUS, phi, theta], [0.0, dphi, dtheta])
}

fn cartesian([phi, theta, dphi, dtheta]: [f64; 4]) -> State<f64, 3> {
    let ((up, out), (sin, cos)) = (phi.sin_cos(), theta.sin_cos());
    let radial =
        |place: f64, turned: f64| (RADIUS * up * place, RADIUS * (out * dphi * place + up * dtheta * turned));
    let ((x, vx), (y, vy)) = (radial(cos, -sin), radial(sin, cos));
    State::new([x, y, RADIUS * out], [vx, vy, -RADIUS * up * dphi])
}

fn row(state: State<f64, 3>) -> [f64; 6] {
    let ([a, b, c], [d, e, f]) = (state.q, state.v);
    [a, b, c, d, e, f]
}

/// 3 m g cos φ − 2 E / R at a height R cos φ with energy E.
fn normal_force(height: f64, energy: f64) -> f64 {
    (3.0 * CARTESIAN.m * G * height - 2.0 * energy) / RADIUS
}

#[test]
fn the_states_agree_in_both_forms() {
    let rows = seed("S13").timed_rows::<4>("ph_th_phd_thd");
    both_follow(&SPHERICAL, spherical(START), rows.iter().map(|&(t, x)| (t, row(spherical(x)))), EASY);
    both_follow(&CARTESIAN, cartesian(START), rows.iter().map(|&(t, x)| (t, row(cartesian(x)))), EASY);
}

#[test]
fn energy_and_angular_momentum_stay_at_the_given_values() {
    let (energy, momentum) = (seed("S13").number("E"), seed("S13").number("Hz"));
    let about_z = |s: &State<f64, 3>| CARTESIAN.m * (s.q[0] * s.v[1] - s.q[1] * s.v[0]);
    close(SPHERICAL.energy(&spherical(START)), energy, CLOSED_FORM);
    close(SPHERICAL.momenta(&spherical(START))[2], momentum, CLOSED_FORM);
    close(CARTESIAN.energy(&cartesian(START)), energy, CLOSED_FORM);
    close(about_z(&cartesian(START)), momentum, CLOSED_FORM);
    let run = |quantity: &dyn Fn(&State<f64, 3>) -> f64| {
        drift(&mut SPHERICAL.simulate(spherical(START)).with_tolerance(TIGHT), 0.5, 100, quantity)
    };
    between(-1.0, run(&|s| SPHERICAL.energy(s)), 1e-11);
    between(-1.0, run(&|s| SPHERICAL.momenta(s)[2]), 1e-11);
    let run = |quantity: &dyn Fn(&State<f64, 3>) -> f64| {
        drift(&mut CARTESIAN.simulate(cartesian(START)).with_tolerance(TIGHT), 0.5, 100, quantity)
    };
    between(-1.0, run(&|s| CARTESIAN.energy(s)), 1e-11);
    between(-1.0, run(&about_z), 1e-11);
}

#[test]
fn the_reaction_is_the_normal_force() {
    let (reference, energy) = (seed("S13"), seed("S13").number("E"));
    let expected = reference.number("N_radial(1)_correct");
    let mut motion = SPHERICAL.simulate(spherical(START)).with_tolerance(TIGHT);
    motion.advance_to(1.0).unwrap();
    close(motion.reactions().bowl, expected, EASY);
    let state = state_at(&CARTESIAN, cartesian(START), 1.0);
    close(CARTESIAN.reactions(&state).unwrap().bowl, expected, EASY);
    for sample in motion.every(0.1).take(50) {
        let state = sample.unwrap();
        let height = RADIUS * state.q[1].cos();
        let found = SPHERICAL.reactions(&state).unwrap().bowl;
        close(found, normal_force(height, energy), 1e-11);
        // The bowl only pushes.
        assert!(found < 0.0);
    }
}

#[test]
fn the_normal_force_is_a_closed_form_of_the_state() {
    for state in [START, [1.9, 0.4, -0.8, 2.5], [3.0, 1.0, 0.1, -7.0]] {
        let height = RADIUS * state[0].cos();
        let expected = normal_force(height, SPHERICAL.energy(&spherical(state)));
        close(SPHERICAL.reactions(&spherical(state)).unwrap().bowl, expected, CLOSED_FORM);
        close(CARTESIAN.reactions(&cartesian(state)).unwrap().bowl, expected, CLOSED_FORM);
    }
}

#[test]
fn the_identities_hold() {
    let states = [START, [1.9, 0.4, -0.8, 2.5]];
    bound!(SPHERICAL, [true]).holds(states.map(spherical));
    bound!(CARTESIAN, [true]).holds(states.map(cartesian));
}
