//! C02: the Hénon–Heiles system at a regular, a mixed and a chaotic energy.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, EASY};
use crate::support::close::{between, close};
use crate::support::motion::{TIGHT, drift, follows};
use crate::support::reference::classical;

struct HenonHeiles;

#[lagrangian(coordinates = [x, y])]
impl HenonHeiles {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        (v.x.powi(2) + v.y.powi(2)) / 2.0
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        (q.x.powi(2) + q.y.powi(2)) / 2.0 + q.x.powi(2) * q.y - q.y.powi(3) / 3.0
    }
}

const ENERGIES: [(&str, f64); 3] = [("1/12", 1.0 / 12.0), ("1/8", 1.0 / 8.0), ("1/6", 1.0 / 6.0)];

fn start(key: &str) -> State<f64, 2> {
    let speed = classical("C02_henon_heiles").part(key).number("xd0");
    State::new([0.0, 0.1], [speed, 0.0])
}

#[test]
fn the_states_agree_at_all_energies() {
    for (key, _) in ENERGIES {
        let reference = classical("C02_henon_heiles").part(key);
        let states = [10, 100].map(|t| (f64::from(t), reference.numbers::<4>(&format!("state({t})"))));
        follows(&HenonHeiles, start(key), states, EASY);
    }
}

#[test]
fn the_energies_have_their_values_and_stay() {
    for (key, energy) in ENERGIES {
        close(HenonHeiles.energy(&start(key)), energy, CLOSED_FORM);
        let mut motion = HenonHeiles.simulate(start(key)).with_tolerance(TIGHT);
        between(-1.0, drift(&mut motion, 5.0, 40, |s| HenonHeiles.energy(s)), 1e-13);
    }
}
