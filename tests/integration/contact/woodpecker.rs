//! The woodpecker toy: a sleeve that slides and jams on a pole, a bird on a spring, a beak that strikes.
//!
//! Parameters of C. Glocker, *Dynamik von Starrkörpersystemen mit Reibung und Stößen* (VDI, 1995), as in R.
//! I. Leine, D. H. van Campen, C. Glocker, "Nonlinear dynamics and modeling of various wooden toys with
//! impact and friction", J. Vib. Control 9 (2003).

use std::marker::PhantomData;

use lagrangian::Contact;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::close_on;

struct Woodpecker<R>(PhantomData<R>);

/// Masses \[kg] and inertias \[kg m²] of bird and sleeve; the spring \[N m].
const BIRD: [f64; 2] = [4.5e-3, 7.0e-7];
const SLEEVE: [f64; 2] = [3.0e-4, 5.0e-9];
const SPRING: f64 = 5.6e-3;

#[lagrangian(coordinates = [y, sleeve, bird])]
impl<R: Real> Woodpecker<R> {
    #[kinetic]
    fn motion(&self, v: &Velocities<R>) -> R {
        let bird = v.y + 0.010 * v.sleeve + 0.015 * v.bird;
        0.5 * (R::from_f64(SLEEVE[0]) * v.y * v.y + R::from_f64(SLEEVE[1]) * v.sleeve * v.sleeve)
            + 0.5 * (R::from_f64(BIRD[0]) * bird * bird + R::from_f64(BIRD[1]) * v.bird * v.bird)
    }

    #[potential]
    fn weight(&self, q: &Coordinates<R>) -> R {
        9.81 * (R::from_f64(SLEEVE[0]) * q.y
            + R::from_f64(BIRD[0]) * (q.y + 0.010 * q.sleeve + 0.015 * q.bird))
    }

    #[potential]
    fn spring(&self, q: &Coordinates<R>) -> R {
        0.5 * R::from_f64(SPRING) * (q.bird - q.sleeve).powi(2)
    }

    #[unilateral(restitution = 0.5)]
    fn beak(&self, q: &Coordinates<R>) -> R {
        (0.010 + 0.015 - 0.0201 - 0.0025) - 0.02 * q.bird
    }

    #[unilateral]
    fn edges(&self, q: &Coordinates<R>) -> [R; 2] {
        [1.0, -1.0].map(|side| (0.0031 - 0.0025) + side * 0.0058 * q.sleeve)
    }

    #[friction(coefficient = 0.3, normal = beak)]
    fn scrape(&self, v: &Velocities<R>) -> R {
        v.y + 0.010 * v.sleeve + (0.015 - 0.0201) * v.bird
    }

    #[friction(coefficient = 0.3, normal = edges)]
    fn slides(&self, v: &Velocities<R>) -> [R; 2] {
        [v.y + 0.0031 * v.sleeve; 2]
    }
}

/// A published state of the limit cycle, to four digits: the sleeve slides down on its lower edge.
fn start<R: Real>() -> State<R, 3> {
    let number = R::from_f64;
    State::new(
        [number(0.0), number(-6.0) / number(58.0), number(-0.2788)],
        [-0.3411, 0.0, -7.4583].map(number),
    )
}

/// The states of so many cycles in which the sleeve comes to rest.
fn rests(tolerance: f64, count: usize) -> Vec<State<f64, 3>> {
    let mut motion = Woodpecker(PhantomData).simulate(start()).with_tolerance(tolerance);
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

/// The limit of a sequence whose deviations fall by the same factor (Aitken), and that factor.
fn limit(sequence: &[f64]) -> [f64; 2] {
    let [a, b, c] = *sequence.last_chunk().unwrap();
    let factor = (c - b) / (b - a);
    [c + (c - b) * factor / (1.0 - factor), factor]
}

#[test]
fn a_woodpecker_pecks_in_a_limit_cycle() {
    let states = rests(TIGHT, 24);
    let rates: Vec<f64> = states.iter().map(|state| state.v[2]).collect();
    let periods: Vec<f64> = states.windows(2).map(|pair| pair[1].t - pair[0].t).collect();
    // A deviation changes its sign from cycle to cycle and decays.
    for number in 6..rates.len() {
        let [_, factor] = limit(&rates[..number]);
        assert!(factor < -0.8 && factor > -0.9, "{factor}");
    }
    let [rate, _] = limit(&rates);
    close_on(1.0, limit(&rates[..rates.len() - 1])[0] / rate, 1.0, 1e-6);
    let [period, _] = limit(&periods);
    close_on(1.0, limit(&periods[..periods.len() - 1])[0] / period, 1.0, 1e-6);
    // Other steps lead there as well.
    let others: Vec<f64> = rests(1e-10, 24).iter().map(|state| state.v[2]).collect();
    close_on(1.0, limit(&others)[0] / rate, 1.0, 1e-6);
    // The published state leads to this rest within its digits; the way there costs one of them.
    close_on(1.0, rates[0] / rate, 1.0, 2e-3);
}

#[cfg(feature = "double-double")]
#[test]
fn the_digits_of_a_woodpecker_are_true() {
    use crate::support::digits::{agree, at_switches};

    // Six cycles and more.
    let double = at_switches!(Woodpecker(PhantomData), start::<f64>(), TIGHT, 60);
    let [coarse, fine] = [1e-22, 1e-27].map(|tolerance| {
        at_switches!(Woodpecker(PhantomData), start::<lagrangian::DoubleDouble>(), tolerance.into(), 60)
    });
    agree(&double, [&coarse, &fine], [TIGHT, 1e-22]);
}
