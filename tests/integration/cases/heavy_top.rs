//! C04: the heavy symmetric top released from rest with a fast spin (cusps), by T in Euler angles and as a
//! body.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, G, MEDIUM};
use crate::support::close::{all_close, between, close};
use crate::support::motion::{TIGHT, drift, follows, root, state_at};
use crate::support::reference::classical;
use crate::support::sample::Samples;

/// Moments about the tip, A across and C along the axis, and the moment of gravity.
struct ByAngles {
    across: f64,
    along: f64,
    weight: f64,
}

#[lagrangian(coordinates = [phi, theta, psi])]
impl ByAngles {
    #[kinetic]
    fn tilting(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.across * (v.theta.powi(2) + v.phi.powi(2) * q.theta.sin().powi(2)) / 2.0
    }

    #[kinetic]
    fn spinning(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.along * (v.psi + v.phi * q.theta.cos()).powi(2) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.weight * q.theta.cos()
    }
}

/// The same top by its pose; the inertia is about the centre of mass.
struct Gyroscope {
    mass: f64,
    arm: f64,
    inertia: Vector3<f64>,
    g: f64,
}

#[lagrangian(coordinates = [phi, theta, psi])]
impl Gyroscope {
    #[body(mass = self.mass, inertia = self.inertia)]
    fn gyroscope(&self, q: &Coordinates) -> Isometry3<f64> {
        let attitude = Rotation3::from_axis_angle(&Vector3::z_axis(), q.phi)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.theta)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.psi);
        Isometry3::from_parts((attitude * Vector3::new(0.0, 0.0, self.arm)).into(), attitude.into())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * self.gyroscope(q).translation.vector.z
    }
}

const ANGLES: ByAngles = ByAngles { across: 0.004, along: 0.0015, weight: 0.25 };

fn gyroscope() -> Gyroscope {
    let arm = 0.05;
    let mass = ANGLES.weight / (G * arm);
    let across = ANGLES.across - mass * arm * arm;
    Gyroscope { mass, arm, inertia: Vector3::new(across, across, ANGLES.along), g: G }
}

fn start() -> State<f64, 3> {
    State::new([0.0, 0.6, 0.0], [0.0, 0.0, 150.0])
}

/// θ′ and θ″: θ′ vanishes at the cusps and half way between them.
fn nutation(state: &State<f64, 3>) -> (f64, f64) {
    (state.v[1], ANGLES.accelerations(state).unwrap()[1])
}

#[test]
fn the_states_agree_in_both_forms() {
    let end = classical("C04_lagrange_top").numbers::<6>("state(0.5)");
    follows(&ANGLES, start(), [(0.5, end)], MEDIUM);
    follows(&gyroscope(), start(), [(0.5, end)], MEDIUM);
}

#[test]
fn nutation_and_precession_agree() {
    let reference = classical("C04_lagrange_top");
    let expected = reference.number("nutation_period");
    let period = root(&ANGLES, start(), 0.99 * expected, nutation);
    close(period, expected, MEDIUM);
    close(root(&gyroscope(), start(), 1.01 * expected, nutation), expected, MEDIUM);
    let end = state_at(&gyroscope(), start(), expected);
    close(end.q[0], reference.number("precession_per_nutation"), MEDIUM);
    close(end.q[1], 0.6, MEDIUM);
}

#[test]
fn the_axis_stays_between_the_given_tilts() {
    let [low, high] = classical("C04_lagrange_top").numbers("cos(theta)_range");
    let expected = classical("C04_lagrange_top").number("nutation_period");
    let half = state_at(&gyroscope(), start(), root(&ANGLES, start(), 0.49 * expected, nutation));
    close(half.q[1].cos(), low, MEDIUM);
    close(start().q[1].cos(), high, 1e-15);
}

#[test]
fn energy_and_both_cyclic_momenta_stay() {
    let top = gyroscope();
    let run = |quantity: &dyn Fn(&State<f64, 3>) -> f64| {
        let mut motion = top.simulate(start()).with_tolerance(TIGHT);
        drift(&mut motion, 0.01, 100, quantity)
    };
    // The spin energy is 17 J, the momenta are 0.2 kg m²/s.
    between(-1.0, run(&|s| top.energy(s)), 1e-10);
    between(-1.0, run(&|s| top.momenta(s)[0]), 1e-12);
    between(-1.0, run(&|s| top.momenta(s)[2]), 1e-12);
    let spin = 0.0015 * 150.0;
    all_close(top.momenta(&start()), [spin * 0.6_f64.cos(), 0.0, spin], CLOSED_FORM);
}

#[test]
fn both_forms_are_the_same_system() {
    let top = gyroscope();
    let mut samples = Samples::new(4);
    for _ in 0..20 {
        let state = samples.state(0.5, 2.5);
        all_close(ANGLES.mass_matrix(&state).as_slice(), top.mass_matrix(&state).as_slice(), 1e-12);
        all_close(ANGLES.accelerations(&state).unwrap(), top.accelerations(&state).unwrap(), 1e-11);
        all_close(ANGLES.momenta(&state), top.momenta(&state), 1e-12);
        close(ANGLES.energy(&state), top.energy(&state), 1e-12);
    }
}
