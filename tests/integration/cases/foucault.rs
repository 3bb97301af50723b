//! C09: Foucault's pendulum for small swings, a gyroscopic Lagrangian.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, EASY};
use crate::support::close::{all_close, close};
use crate::support::difference::{STEP, frequencies, state_matrix};
use crate::support::motion::{follows, state_at};
use crate::support::reference::classical;

struct Foucault {
    /// Vertical component of the Earth's rate.
    rate: f64,
    k: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Foucault {
    #[lagrangian]
    fn swing(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let coriolis = self.rate * (q.x * v.y - q.y * v.x);
        (v.x.powi(2) + v.y.powi(2)) / 2.0 + coriolis - self.k * (q.x.powi(2) + q.y.powi(2)) / 2.0
    }
}

fn foucault() -> Foucault {
    Foucault { rate: 0.5 * 0.8_f64.sin(), k: 4.0 }
}

fn start() -> State<f64, 2> {
    State::at_rest([0.3, 0.0])
}

/// In a frame that turns with the plane of the swing the pendulum oscillates at this frequency.
fn own_frequency() -> f64 {
    (foucault().k + foucault().rate.powi(2)).sqrt()
}

#[test]
fn the_position_agrees() {
    let state = state_at(&foucault(), start(), 3.0);
    let reference = classical("C09_foucault");
    all_close(state.q, [reference.number("x(3)"), reference.number("y(3)")], EASY);
}

#[test]
fn the_motion_is_the_closed_form_at_all_times() {
    let (turn, own) = (foucault().rate, own_frequency());
    let reference = |t: f64| {
        // In complex form: z = (cos ωt + i Ω/ω sin ωt) e^(−iΩt), started at 0.3.
        let (along, across) = ((own * t).cos(), turn / own * (own * t).sin());
        let (sin, cos) = (turn * t).sin_cos();
        let z = [along * cos + across * sin, across * cos - along * sin];
        let (dalong, dacross) = (-own * (own * t).sin(), turn * (own * t).cos());
        let rate = [dalong * cos + dacross * sin + turn * z[1], dacross * cos - dalong * sin - turn * z[0]];
        (t, [z[0], z[1], rate[0], rate[1]].map(|x| 0.3 * x))
    };
    follows(&foucault(), start(), [0.5, 1.0, 3.0, 20.0].map(reference), EASY);
}

#[test]
fn the_plane_turns_at_the_given_rate() {
    let half = std::f64::consts::PI / own_frequency();
    let State { q: [x, y], .. } = state_at(&foucault(), start(), half);
    let rate = (-y).atan2(-x) / half;
    close(rate, classical("C09_foucault").number("precession_rate"), EASY);
}

#[test]
fn the_frequencies_are_split_by_the_rotation() {
    let foucault = foucault();
    let matrix = state_matrix(STEP, &start(), |s| foucault.accelerations(s).unwrap());
    let expected = [own_frequency() - foucault.rate, own_frequency() + foucault.rate];
    all_close(frequencies(&matrix), expected, CLOSED_FORM);
}

#[test]
fn momentum_is_not_velocity_and_the_coriolis_term_has_no_energy() {
    let foucault = foucault();
    let state = State::new([0.3, -0.2], [0.7, 0.4]);
    let [x, y] = state.q;
    all_close(foucault.momenta(&state), [0.7 - foucault.rate * y, 0.4 + foucault.rate * x], CLOSED_FORM);
    close(foucault.kinetic_energy(&state), (0.49 + 0.16) / 2.0, CLOSED_FORM);
    close(foucault.potential_energy(&state), 2.0 * 0.13, CLOSED_FORM);
    close(foucault.energy(&state), 0.325 + 0.26, CLOSED_FORM);
}
