//! C12: the swinging Atwood machine at mass ratio 3, which has a hidden integral.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, between, close};
use crate::support::motion::{TIGHT, drift, follows};
use crate::support::reference::classical;
use crate::support::sample::Samples;

/// The Lagrangian as published, for unit mass.
struct ByLagrangian;

#[lagrangian(coordinates = [r, theta])]
impl ByLagrangian {
    #[lagrangian]
    fn machine(&self, q: &Coordinates, v: &Velocities) -> f64 {
        (4.0 * v.r.powi(2) + q.r.powi(2) * v.theta.powi(2)) / 2.0 - G * q.r * (3.0 - q.theta.cos())
    }
}

/// The two masses at the ends of the thread.
struct ByMasses {
    mass: f64,
    ratio: f64,
}

#[lagrangian(coordinates = [r, theta])]
impl ByMasses {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.r * q.theta.sin(), -q.r * q.theta.cos())
    }

    /// Rises as the thread runs out.
    #[point(mass = self.ratio * self.mass)]
    fn counterweight(&self, q: &Coordinates) -> f64 {
        q.r
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * G * (self.bob(q).y + self.ratio * self.counterweight(q))
    }
}

const MASSES: ByMasses = ByMasses { mass: 1.0, ratio: 3.0 };

fn start() -> State<f64, 2> {
    State::new([1.0, 1.2], [0.0, 0.5])
}

fn hidden(state: &State<f64, 2>) -> f64 {
    let ([r, theta], [dr, dtheta]) = (state.q, state.v);
    let (sin, cos) = (theta / 2.0).sin_cos();
    r * r * dtheta * (dr * cos - r * dtheta / 2.0 * sin) + G * r * r * sin * cos * cos
}

#[test]
fn the_states_agree_in_both_forms() {
    let reference =
        [1, 5].map(|t| (f64::from(t), classical("C12_swinging_atwood").numbers::<4>(&format!("state({t})"))));
    follows(&ByLagrangian, start(), reference, EASY);
    follows(&MASSES, start(), reference, EASY);
}

#[test]
fn the_hidden_integral_has_its_value_and_stays() {
    close(hidden(&start()), classical("C12_swinging_atwood").number("I"), CLOSED_FORM);
    let mut motion = MASSES.simulate(start()).with_tolerance(TIGHT);
    between(-1.0, drift(&mut motion, 0.25, 40, hidden), 1e-10);
}

#[test]
fn both_forms_are_the_same_system() {
    let mut samples = Samples::new(12);
    for _ in 0..20 {
        let state = samples.state(0.5, 2.5);
        let found = MASSES.accelerations(&state).unwrap();
        all_close(found, ByLagrangian.accelerations(&state).unwrap(), 1e-13);
        all_close(MASSES.momenta(&state), ByLagrangian.momenta(&state), 1e-13);
        close(MASSES.energy(&state), ByLagrangian.energy(&state), 1e-13);
    }
}
