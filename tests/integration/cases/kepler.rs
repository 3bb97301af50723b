//! C01: the Kepler problem with eccentricity 0.6, over up to 159 revolutions.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, EASY};
use crate::support::close::{all_close, all_close_on_largest, between};
use crate::support::motion::{TIGHT, drift, follows, numbers, state_at};
use crate::support::reference::classical;

struct Kepler;

#[lagrangian(coordinates = [x, y])]
impl Kepler {
    #[lagrangian]
    fn orbit(&self, q: &Coordinates, v: &Velocities) -> f64 {
        (v.x.powi(2) + v.y.powi(2)) / 2.0 + 1.0 / q.x.hypot(q.y)
    }
}

/// The same orbit by a position and a potential.
struct Planet;

#[lagrangian(coordinates = [x, y])]
impl Planet {
    #[point(mass = 1.0)]
    fn planet(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn sun(&self, q: &Coordinates) -> f64 {
        -self.planet(q).norm().recip()
    }
}

const ECCENTRICITY: f64 = 0.6;

fn start() -> State<f64, 2> {
    let e = ECCENTRICITY;
    State::new([1.0 - e, 0.0], [0.0, ((1.0 + e) / (1.0 - e)).sqrt()])
}

/// Energy, angular momentum, and the Laplace vector, which points to the pericentre with length e.
fn integrals(state: &State<f64, 2>) -> [f64; 4] {
    let ([x, y], [vx, vy]) = (state.q, Planet.momenta(state));
    let momentum = x * vy - y * vx;
    let r = x.hypot(y);
    [Planet.energy(state), momentum, vy * momentum - x / r, -vx * momentum - y / r]
}

#[test]
fn the_states_agree_in_both_forms() {
    let reference = |t: u32| (f64::from(t), classical("C01_kepler").numbers::<4>(&format!("state({t})")));
    follows(&Kepler, start(), [10, 100].map(reference), EASY);
    follows(&Planet, start(), [10, 100].map(reference), EASY);
    // One velocity happens to be a thousandth of the other there.
    let (t, end) = reference(1000);
    all_close_on_largest(numbers(&state_at(&Kepler, start(), t)), end, EASY);
    all_close_on_largest(numbers(&state_at(&Planet, start(), t)), end, EASY);
}

#[test]
fn the_integrals_have_their_values() {
    all_close(integrals(&start()), [-0.5, 0.8, ECCENTRICITY, 0.0], CLOSED_FORM);
    all_close([Kepler.energy(&start())], [-0.5], CLOSED_FORM);
}

#[test]
fn the_integrals_stay_over_sixteen_revolutions() {
    for i in 0..4 {
        let mut motion = Planet.simulate(start()).with_tolerance(TIGHT);
        between(-1.0, drift(&mut motion, 1.0, 100, |s| integrals(s)[i]), 1e-11);
    }
}
