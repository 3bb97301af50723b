//! S08: a double pendulum whose second angle is relative, by positions and by T and V.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, close};
use crate::support::difference::{STEP, frequencies, state_matrix};
use crate::support::motion::{follows, state_at};
use crate::support::reference::seed;
use crate::support::sample::Samples;

/// Positions; the x axis points down.
struct ByPositions {
    m: [f64; 2],
    l: [f64; 2],
    g: f64,
}

#[lagrangian(coordinates = [theta, relative])]
impl ByPositions {
    #[point(mass = self.m[0])]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(self.l[0] * q.theta.cos(), self.l[0] * q.theta.sin())
    }

    #[point(mass = self.m[1])]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        let angle = q.theta + q.relative;
        self.upper(q) + self.l[1] * Vector2::new(angle.cos(), angle.sin())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -self.g * (self.m[0] * self.upper(q).x + self.m[1] * self.lower(q).x)
    }
}

/// T and V written out.
struct ByEnergies {
    m: [f64; 2],
    l: [f64; 2],
    g: f64,
}

#[lagrangian(coordinates = [theta: [2]])]
impl ByEnergies {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let ([m1, m2], [l1, l2]) = (self.m, self.l);
        let (first, second) = (v.theta[0], v.theta[0] + v.theta[1]);
        0.5 * (m1 + m2) * (l1 * first).powi(2)
            + 0.5 * m2 * (l2 * second).powi(2)
            + m2 * l1 * l2 * first * second * q.theta[1].cos()
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let [first, relative] = q.theta;
        let lower = self.m[1] * self.g * self.l[1] * (first + relative).cos();
        -(self.m[0] + self.m[1]) * self.g * self.l[0] * first.cos() - lower
    }
}

const POSITIONS: ByPositions = ByPositions { m: [1.0; 2], l: [1.0; 2], g: G };
const ENERGIES: ByEnergies = ByEnergies { m: [1.0; 2], l: [1.0; 2], g: G };

fn start() -> State<f64, 2> {
    State::at_rest([1.0, 0.5])
}

/// Tensions from d'Alembert's principle along the rods (unit masses and lengths).
fn tensions(state: &State<f64, 2>, a: [f64; 2]) -> [f64; 2] {
    let along = |angle: f64| Vector2::new(angle.cos(), angle.sin());
    let across = |angle: f64| Vector2::new(-angle.sin(), angle.cos());
    let down = Vector2::new(G, 0.0);
    let (first, second) = (state.q[0], state.q[0] + state.q[1]);
    let (rate, total) = (state.v[0], state.v[0] + state.v[1]);
    let upper = a[0] * across(first) - rate * rate * along(first);
    let lower = upper + (a[0] + a[1]) * across(second) - total * total * along(second);
    let outer = -(lower - down).dot(&along(second));
    let inner = -(upper - down).dot(&along(first)) + outer * along(second).dot(&along(first));
    [inner, outer]
}

#[test]
fn the_states_agree_in_both_forms() {
    let reference = seed("S08").timed_rows::<4>("state_th1_th2rel_rates");
    follows(&POSITIONS, start(), reference.clone(), EASY);
    follows(&ENERGIES, start(), reference, EASY);
}

#[test]
fn the_tensions_agree() {
    let expected = seed("S08").numbers::<2>("rod_tensions(10)");
    let state = state_at(&POSITIONS, start(), 10.0);
    all_close(tensions(&state, POSITIONS.accelerations(&state).unwrap()), expected, EASY);
    all_close(tensions(&state, ENERGIES.accelerations(&state).unwrap()), expected, EASY);
}

#[test]
fn the_linear_frequencies_agree() {
    let expected = seed("S08").numbers::<2>("linear_omegas");
    let rest = State::at_rest([0.0, 0.0]);
    let matrix = state_matrix(STEP, &rest, |s| POSITIONS.accelerations(s).unwrap());
    all_close(frequencies(&matrix), expected, CLOSED_FORM);
    let matrix = state_matrix(STEP, &rest, |s| ENERGIES.accelerations(s).unwrap());
    all_close(frequencies(&matrix), expected, CLOSED_FORM);
}

#[test]
fn both_forms_are_the_same_system() {
    let positions = ByPositions { m: [1.3, 0.4], l: [0.7, 1.9], g: 3.0 };
    let energies = ByEnergies { m: positions.m, l: positions.l, g: positions.g };
    let mut samples = Samples::new(8);
    for _ in 0..20 {
        let state = samples.state(-3.0, 3.0);
        let found = positions.accelerations(&state).unwrap();
        all_close(found, energies.accelerations(&state).unwrap(), 1e-12);
        all_close(positions.momenta(&state), energies.momenta(&state), 1e-12);
        all_close(positions.bias(&state), energies.bias(&state), 1e-12);
        close(positions.energy(&state), energies.energy(&state), 1e-12);
    }
}
