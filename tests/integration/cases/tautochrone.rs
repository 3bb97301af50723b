//! C08: a bead on a cycloid, whose period does not depend on the amplitude.

use lagrangian::prelude::*;

use super::{EASY, G};
use crate::support::close::{between, close};
use crate::support::motion::{root, state_at};
use crate::support::reference::classical;

/// T and V in the rolling angle.
struct ByEnergies {
    r: f64,
    g: f64,
}

#[lagrangian(coordinates = [w])]
impl ByEnergies {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.r.powi(2) * v.w.powi(2) * (1.0 - q.w.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -self.g * self.r * (1.0 - q.w.cos())
    }
}

/// The position of the bead.
struct ByPosition {
    r: f64,
    g: f64,
}

#[lagrangian(coordinates = [w])]
impl ByPosition {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.w - q.w.sin(), q.w.cos() - 1.0) * self.r
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.g * self.bead(q).y
    }
}

const ENERGIES: ByEnergies = ByEnergies { r: 0.3, g: G };
const POSITION: ByPosition = ByPosition { r: 0.3, g: G };
const AMPLITUDES: [f64; 3] = [0.5, 2.0, 3.0];

#[test]
fn the_period_is_the_same_for_every_amplitude() {
    let expected = classical("C08_tautochrone").number("period_any_amplitude");
    let lowest = |state: &State<f64, 1>| (state.q[0] - std::f64::consts::PI, state.v[0]);
    for amplitude in AMPLITUDES {
        let start = State::at_rest([amplitude]);
        close(4.0 * root(&ENERGIES, start, 0.24 * expected, lowest), expected, EASY);
        close(4.0 * root(&POSITION, start, 0.26 * expected, lowest), expected, EASY);
    }
}

#[test]
fn the_motion_closes_after_the_period() {
    let period = classical("C08_tautochrone").number("period_any_amplitude");
    for amplitude in AMPLITUDES {
        let end = state_at(&ENERGIES, State::at_rest([amplitude]), period);
        close(end.q[0], amplitude, EASY);
        close(end.v[0], 0.0, 1e-7);
        let half = state_at(&POSITION, State::at_rest([amplitude]), period / 2.0);
        close(half.q[0], std::f64::consts::TAU - amplitude, EASY);
    }
}

#[test]
fn the_acceleration_is_proportional_to_the_arc() {
    // The arc length from the lowest point, s = 4r cos(w/2), obeys s″ = −g s / 4r: that makes it a
    // tautochrone.
    for amplitude in AMPLITUDES {
        let arc = 4.0 * POSITION.r * (amplitude / 2.0).cos();
        let a = POSITION.accelerations(&State::at_rest([amplitude])).unwrap()[0];
        let tangential = a * 2.0 * POSITION.r * (amplitude / 2.0).sin();
        close(tangential / arc, G / (4.0 * POSITION.r), 1e-13);
        between(0.0, tangential, G);
    }
}
