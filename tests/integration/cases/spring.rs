//! S02: a damped mass on a spring, about its static equilibrium and hanging from the unstretched spring.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, close, close_on};
use crate::support::difference::{STEP, eigenvalues, state_matrix};
use crate::support::motion::follows;
use crate::support::reference::seed;
use crate::support::sample::Samples;

struct Spring {
    m: f64,
    k: f64,
    c: f64,
}

#[lagrangian(coordinates = [x])]
impl Spring {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.m * v.x * v.x
    }

    #[potential]
    fn stretch(&self, q: &Coordinates) -> f64 {
        0.5 * self.k * q.x.powi(2)
    }

    #[dissipation]
    fn damper(&self, v: &Velocities) -> f64 {
        0.5 * self.c * v.x.powi(2)
    }
}

/// The same mass with its weight; `sag` is the static stretch of the spring.
struct Hanging {
    m: f64,
    k: f64,
    c: f64,
    g: f64,
    sag: f64,
}

#[lagrangian(coordinates = [x])]
impl Hanging {
    #[point(mass = self.m)]
    fn mass(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        -self.m * self.g * q.x
    }

    #[potential]
    fn stretch(&self, q: &Coordinates) -> f64 {
        0.5 * self.k * (q.x + self.sag).powi(2)
    }

    #[dissipation]
    fn damper(&self, v: &Velocities) -> f64 {
        0.5 * self.c * v.x.powi(2)
    }
}

const SPRING: Spring = Spring { m: 2.0, k: 18.0, c: 3.0 };

fn hanging() -> Hanging {
    let Spring { m, k, c } = SPRING;
    Hanging { m, k, c, g: G, sag: m * G / k }
}

#[test]
fn the_state_after_two_seconds_agrees() {
    let reference = seed("S02");
    let end = [reference.number("x(2)"), reference.number("v(2)")];
    follows(&SPRING, State::at_rest([0.1]), [(2.0, end)], EASY);
    follows(&hanging(), State::at_rest([0.1]), [(2.0, end)], EASY);
}

#[test]
fn the_eigenvalues_agree() {
    let [re, im] = seed("S02").numbers("eigenvalue");
    let matrix = state_matrix(STEP, &State::at_rest([0.0]), |s| SPRING.accelerations(s).unwrap());
    for (found, sign) in eigenvalues(&matrix).iter().zip([-1.0, 1.0]) {
        close(found.re, re, CLOSED_FORM);
        close(found.im, sign * im, CLOSED_FORM);
    }
    let undamped = Spring { c: 0.0, ..SPRING };
    let matrix = state_matrix(STEP, &State::at_rest([0.0]), |s| undamped.accelerations(s).unwrap());
    close(eigenvalues(&matrix)[1].im, seed("S02").number("undamped_omega"), CLOSED_FORM);
}

#[test]
fn weight_and_static_stretch_cancel() {
    let mut samples = Samples::new(2);
    for _ in 0..20 {
        let state = samples.state(-1.0, 1.0);
        let found = hanging().accelerations(&state).unwrap();
        // The forces that cancel are of the size of g.
        let scale = found[0].abs().max(G);
        close_on(scale, found[0], SPRING.accelerations(&state).unwrap()[0], 1e-14);
    }
}

#[test]
fn the_damper_takes_the_power_that_the_energy_loses() {
    let state = State::new([0.1], [-0.4]);
    all_close(SPRING.applied_forces(&state), [1.2], CLOSED_FORM);
    close(SPRING.power(&state), -0.48, CLOSED_FORM);
    close(SPRING.energy(&state), 0.5 * 2.0 * 0.16 + 0.5 * 18.0 * 0.01, CLOSED_FORM);
}
