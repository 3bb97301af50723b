//! S03: a pinned bar with two masses and a spring, its frequency with and without gravity.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, G};
use crate::support::close::{all_close, close};
use crate::support::difference::{STEP, frequencies, state_matrix};
use crate::support::reference::seed;
use crate::support::sample::Samples;

#[derive(Clone, Copy)]
struct PinnedBar {
    m: f64,
    k: f64,
    length: f64,
    g: f64,
}

#[lagrangian(coordinates = [theta])]
impl PinnedBar {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        2.0 * self.m * (self.length / 2.0).powi(2) * v.theta.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        self.k * (self.length / 4.0).powi(2) * q.theta.sin().powi(2) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * self.g * (self.length / 2.0) * (q.theta.cos() - 3.0 * q.theta.cos())
    }
}

/// The same bar by the positions of its masses and of the spring.
struct TwoMasses {
    bar: PinnedBar,
}

#[lagrangian(coordinates = [theta])]
impl TwoMasses {
    /// The place at a distance above the pin.
    fn along(&self, q: &Coordinates, distance: f64) -> Vector2<f64> {
        distance * Vector2::new(q.theta.sin(), q.theta.cos())
    }

    #[point(mass = self.bar.m)]
    fn top(&self, q: &Coordinates) -> Vector2<f64> {
        self.along(q, 0.5 * self.bar.length)
    }

    #[point(mass = 3.0 * self.bar.m)]
    fn bottom(&self, q: &Coordinates) -> Vector2<f64> {
        self.along(q, -0.5 * self.bar.length)
    }

    #[potential]
    fn energy_of_place(&self, q: &Coordinates) -> f64 {
        let spring = self.along(q, self.bar.length / 4.0).x;
        self.bar.m * self.bar.g * (self.top(q).y + 3.0 * self.bottom(q).y)
            + 0.5 * self.bar.k * spring * spring
    }
}

const BAR: PinnedBar = PinnedBar { m: 1.5, k: 200.0, length: 0.8, g: G };

#[test]
fn the_frequencies_of_both_readings_agree() {
    for (g, key) in [(0.0, "omega_printed_no_gravity"), (G, "omega_with_gravity")] {
        let bar = PinnedBar { g, ..BAR };
        let formula = state_matrix(STEP, &State::at_rest([0.0]), |s| bar.accelerations(s).unwrap());
        close(frequencies(&formula)[0], seed("S03").number(key), CLOSED_FORM);
        let masses = TwoMasses { bar };
        let positions = state_matrix(STEP, &State::at_rest([0.0]), |s| masses.accelerations(s).unwrap());
        close(frequencies(&positions)[0], seed("S03").number(key), CLOSED_FORM);
    }
}

#[test]
fn energies_and_positions_give_the_same_equation() {
    let mut samples = Samples::new(3);
    for _ in 0..20 {
        let state = samples.state(-3.0, 3.0);
        let masses = TwoMasses { bar: BAR };
        all_close(BAR.accelerations(&state).unwrap(), masses.accelerations(&state).unwrap(), 1e-13);
        close(BAR.energy(&state), masses.energy(&state), 1e-13);
        all_close(BAR.momenta(&state), masses.momenta(&state), 1e-13);
    }
}
