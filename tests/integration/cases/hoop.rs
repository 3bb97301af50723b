//! S14: a bead on a hoop that whirls at a given rate, by T and V and by a position that depends on time.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, between, close, close_on};
use crate::support::difference::{STEP, frequencies, rate, state_matrix};
use crate::support::motion::{TIGHT, drift, follows, state_at};
use crate::support::reference::seed;
use crate::support::sample::Samples;

/// The angle is measured from the upward vertical.
#[derive(Clone, Copy)]
struct Hoop {
    m: f64,
    radius: f64,
    rate: f64,
    g: f64,
}

#[lagrangian(coordinates = [phi])]
impl Hoop {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.m * self.radius.powi(2) * (v.phi.powi(2) + self.rate.powi(2) * q.phi.sin().powi(2)) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * self.g * self.radius * q.phi.cos()
    }
}

/// The same bead by its place in space.
struct Whirling(Hoop);

#[lagrangian(coordinates = [phi])]
impl Whirling {
    #[point(mass = self.0.m)]
    fn bead(&self, q: &Coordinates, t: f64) -> Vector3<f64> {
        let turn = self.0.rate * t;
        let outward = q.phi.sin();
        Vector3::new(outward * turn.cos(), outward * turn.sin(), q.phi.cos()) * self.0.radius
    }

    #[potential]
    fn gravity(&self, q: &Coordinates, t: f64) -> f64 {
        self.0.m * self.0.g * self.bead(q, t).z
    }
}

const HOOP: Hoop = Hoop { m: 1.0, radius: 0.5, rate: 6.0, g: G };
const WHIRLING: Whirling = Whirling(HOOP);

fn start() -> State<f64, 1> {
    State::new([2.0], [0.3])
}

fn acceleration(hoop: Hoop, phi: f64) -> f64 {
    hoop.accelerations(&State::at_rest([phi])).unwrap()[0]
}

fn frequency(hoop: Hoop, phi: f64) -> f64 {
    let matrix = state_matrix(STEP, &State::at_rest([phi]), |s| hoop.accelerations(s).unwrap());
    frequencies(&matrix)[0]
}

#[test]
fn the_states_agree_in_both_forms() {
    let reference = seed("S14").timed_rows::<2>("ph_phd");
    follows(&HOOP, start(), reference.clone(), EASY);
    follows(&WHIRLING, start(), reference, EASY);
}

#[test]
fn the_equilibria_are_where_the_text_says() {
    let tilted = seed("S14").number("phi_eq");
    // Gravity and the centrifugal term, each of the size of g/R, cancel.
    for phi in [0.0, std::f64::consts::PI, tilted] {
        close_on(G / HOOP.radius, acceleration(HOOP, phi), 0.0, 1e-14);
    }
    close(tilted, (-G / (HOOP.radius * HOOP.rate.powi(2))).acos(), CLOSED_FORM);
}

#[test]
fn the_frequencies_about_the_equilibria_agree() {
    close(frequency(HOOP, seed("S14").number("phi_eq")), seed("S14").number("omega_about_eq"), CLOSED_FORM);
    let slow = Hoop { rate: 3.0, ..HOOP };
    let expected = seed("S14").number("omega_bottom_at_Omega_3");
    close(frequency(slow, std::f64::consts::PI), expected, CLOSED_FORM);
}

#[test]
fn the_bottom_loses_its_stability_at_the_critical_rate() {
    let critical = seed("S14").number("critical_Omega");
    let stiffness = |rate: f64| {
        let hoop = Hoop { rate, ..HOOP };
        -state_matrix(STEP, &State::at_rest([std::f64::consts::PI]), |s| hoop.accelerations(s).unwrap())
            [(1, 0)]
    };
    // ω² = g/R − W².
    close_on(critical * critical, stiffness(critical), 0.0, CLOSED_FORM);
    between(0.0, stiffness(critical * 0.999), 0.1);
    between(-0.1, stiffness(critical * 1.001), 0.0);
}

#[test]
fn the_jacobi_integral_is_conserved_and_the_energy_is_driven_by_the_hoop() {
    let expected = seed("S14").number("jacobi");
    close(HOOP.jacobi_integral(&start()), expected, CLOSED_FORM);
    close(WHIRLING.jacobi_integral(&start()), expected, CLOSED_FORM);
    let mut motion = WHIRLING.simulate(start()).with_tolerance(TIGHT);
    between(-1.0, drift(&mut motion, 0.1, 100, |s| WHIRLING.jacobi_integral(s)), 1e-11);
    let mut motion = HOOP.simulate(start()).with_tolerance(TIGHT);
    between(0.1, drift(&mut motion, 0.1, 100, |s| HOOP.energy(s)), 10.0);
}

#[test]
fn the_force_of_the_hoop_and_its_power_agree() {
    let state = state_at(&WHIRLING, start(), 1.0);
    let Hoop { m, radius, rate: whirl, .. } = HOOP;
    let force = 2.0 * m * radius * whirl * state.v[0] * state.q[0].cos();
    close(force, seed("S14").number("N_theta(1)"), EASY);
    let a = WHIRLING.accelerations(&state).unwrap();
    let power = rate(STEP / 5.0, &state, &a, |s| WHIRLING.energy(s));
    close(power, force * radius * whirl * state.q[0].sin(), 1e-11);
}

#[test]
fn both_forms_are_the_same_system_at_any_time() {
    let mut samples = Samples::new(14);
    for _ in 0..20 {
        let state = samples.state(-3.0, 3.0);
        let found = WHIRLING.accelerations(&state).unwrap();
        all_close(found, HOOP.accelerations(&state).unwrap(), 1e-12);
        close(WHIRLING.kinetic_energy(&state), HOOP.kinetic_energy(&state), 1e-13);
        close(WHIRLING.potential_energy(&state), HOOP.potential_energy(&state), 1e-13);
    }
}
