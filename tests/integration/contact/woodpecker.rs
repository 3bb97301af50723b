//! The woodpecker toy: a sleeve that slides and jams on a pole, a bird on a spring, a beak that strikes.
//!
//! Parameters of C. Glocker, *Dynamik von Starrkörpersystemen mit Reibung und Stößen* (VDI, 1995), as in R. I. Leine,
//! D. H. van Campen, C. Glocker, "Nonlinear dynamics and modeling of various wooden toys with impact and friction",
//! J. Vib. Control 9 (2003).

use lagrangian::Contact;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::close_on;

struct Woodpecker;

/// Masses \[kg] and inertias \[kg m²] of bird and sleeve; the spring \[N m].
const BIRD: [f64; 2] = [4.5e-3, 7.0e-7];
const SLEEVE: [f64; 2] = [3.0e-4, 5.0e-9];
const SPRING: f64 = 5.6e-3;

#[lagrangian(coordinates = [y, sleeve, bird])]
impl Woodpecker {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        let bird = v.y + 0.010 * v.sleeve + 0.015 * v.bird;
        0.5 * (SLEEVE[0] * v.y * v.y + SLEEVE[1] * v.sleeve * v.sleeve)
            + 0.5 * (BIRD[0] * bird * bird + BIRD[1] * v.bird * v.bird)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (SLEEVE[0] * q.y + BIRD[0] * (q.y + 0.010 * q.sleeve + 0.015 * q.bird))
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * SPRING * (q.bird - q.sleeve).powi(2)
    }

    #[unilateral(restitution = 0.5)]
    fn beak(&self, q: &Coordinates) -> f64 {
        (0.010 + 0.015 - 0.0201 - 0.0025) - 0.02 * q.bird
    }

    #[unilateral]
    fn edges(&self, q: &Coordinates) -> [f64; 2] {
        [1.0, -1.0].map(|side| (0.0031 - 0.0025) + side * 0.0058 * q.sleeve)
    }

    #[friction(coefficient = 0.3, normal = beak)]
    fn scrape(&self, v: &Velocities) -> f64 {
        v.y + 0.010 * v.sleeve + (0.015 - 0.0201) * v.bird
    }

    #[friction(coefficient = 0.3, normal = edges)]
    fn slides(&self, v: &Velocities) -> [f64; 2] {
        [v.y + 0.0031 * v.sleeve; 2]
    }
}

/// A published state of the limit cycle, to four digits: the sleeve slides down on its lower edge.
const START: State<f64, 3> =
    State { t: 0.0, q: [0.0, -0.0006 / 0.0058, -0.2788], v: [-0.3411, 0.0, -7.4583] };

/// The states of so many cycles in which the sleeve comes to rest.
fn rests(tolerance: f64, count: usize) -> Vec<State<f64, 3>> {
    let mut motion = Woodpecker.simulate(START).with_tolerance(tolerance);
    let mut states = Vec::new();
    let mut stuck = false;
    while states.len() < count {
        let state = motion.advance_to_switch(1e3).unwrap().expect("it goes on").state;
        let sticks = motion.contacts().slides[0] == Contact::Sticks;
        if sticks && !stuck {
            states.push(state);
        }
        stuck = sticks;
    }
    states
}

/// The period, the way down, and the velocity of the bird at rest of the sleeve.
fn cycle(states: &[State<f64, 3>]) -> [f64; 3] {
    let [before, last] = states.last_chunk().unwrap();
    [last.t - before.t, before.q[0] - last.q[0], last.v[2]]
}

#[test]
fn a_woodpecker_pecks_in_a_limit_cycle() {
    let states = rests(TIGHT, 250);
    let [ours, theirs] = [cycle(&states), cycle(&rests(1e-10, 250))];
    // A deviation changes its sign from cycle to cycle and decays; what is left does not depend on the steps.
    for (ours, theirs) in ours.into_iter().zip(theirs) {
        close_on(1.0, ours / theirs, 1.0, 1e-8);
    }
    let [before, last] = states.last_chunk().unwrap();
    close_on(1.0, last.v[2], before.v[2], 1e-10);
    // The published state leads to this rest within its digits, of which the way there takes one.
    close_on(1.0, states[0].q[2] / last.q[2], 1.0, 2e-3);
    close_on(1.0, states[0].v[2] / last.v[2], 1.0, 2e-3);
    eprintln!("{ours:?} {theirs:?} {:?} {:?}", states[0], last);
}
