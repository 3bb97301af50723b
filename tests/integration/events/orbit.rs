//! The apsides of a Kepler orbit of eccentricity 0.6 and period 2π: r·v = 0 at every multiple of π.

use std::f64::consts::{PI, TAU};

use lagrangian::prelude::*;

use crate::support::close::{close, close_on};
use crate::support::motion::TIGHT;

struct Kepler;

#[lagrangian(coordinates = [x, y])]
impl Kepler {
    #[lagrangian]
    fn orbit(&self, q: &Coordinates, v: &Velocities) -> f64 {
        (v.x.powi(2) + v.y.powi(2)) / 2.0 + 1.0 / q.x.hypot(q.y)
    }

    #[event]
    fn apsis(&self, q: &Coordinates, v: &Velocities) -> f64 {
        q.x * v.x + q.y * v.y
    }

    /// The line through both apsides.
    #[event]
    fn line(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

fn periapsis() -> State<f64, 2> {
    State::new([0.4, 0.0], [0.0, 2.0])
}

fn radial(state: &State<f64, 2>) -> f64 {
    state.q[0] * state.v[0] + state.q[1] * state.v[1]
}

/// Half revolution `k` ends at kπ: at the far apsis where k is odd.
#[track_caller]
fn is_apsis(event: &Event<f64, 2>, k: i32, tolerance: f64) {
    close_on(f64::from(k.abs()) * PI, event.state.t, f64::from(k) * PI, tolerance);
    let (crossing, r) = if k % 2 == 0 { (Crossing::Rising, 0.4) } else { (Crossing::Falling, 1.6) };
    assert_eq!(event.crossing, crossing, "half revolution {k}");
    close(event.state.q[0].hypot(event.state.q[1]), r, tolerance.max(1e-11));
}

#[test]
fn all_apsides_of_a_hundred_revolutions() {
    let mut motion = Kepler.simulate(periapsis()).with_tolerance(TIGHT);
    let events: Vec<_> = motion.events(radial, 100.6 * TAU).map(Result::unwrap).collect();
    assert_eq!(events.len(), 201);
    for (event, k) in events.iter().zip(1..) {
        is_apsis(event, k, 1e-12);
    }
}

#[test]
fn by_name_and_one_direction_at_a_time() {
    let mut motion = Kepler.simulate(periapsis()).with_tolerance(TIGHT);
    for (event, k) in motion.events(KeplerEvent::Apsis, 30.1 * TAU).rising().zip(1..=30) {
        is_apsis(&event.unwrap(), 2 * k, 1e-12);
    }
    let mut motion = Kepler.simulate(periapsis()).with_tolerance(TIGHT);
    assert_eq!(motion.events(KeplerEvent::Apsis, 30.1 * TAU).falling().count(), 30);
    let mut motion = Kepler.simulate(periapsis()).with_tolerance(TIGHT);
    assert_eq!(motion.events(KeplerEvent::Apsis, 30.1 * TAU).touching().count(), 0);
}

#[test]
fn none_missed_and_none_twice_over_a_thousand_revolutions() {
    let mut motion = Kepler.simulate(periapsis()).with_tolerance(1e-13);
    let mut k = 0;
    while let Some(event) = motion.advance_to_event(KeplerEvent::Apsis, 1000.25 * TAU).unwrap() {
        k += 1;
        // The period follows the energy, whose error grows with the number of steps.
        is_apsis(&event, k, 1e-9);
    }
    assert_eq!(k, 2000);
}

#[test]
fn backward_in_time() {
    let mut motion = Kepler.simulate(periapsis()).with_tolerance(TIGHT);
    let back: Vec<_> = motion.events(KeplerEvent::Apsis, -10.2 * TAU).map(Result::unwrap).collect();
    assert_eq!(back.len(), 20);
    for (event, k) in back.iter().zip(1..) {
        is_apsis(event, -k, 1e-12);
    }
    let forth: Vec<_> = motion.events(KeplerEvent::Apsis, 1.0).map(Result::unwrap).collect();
    assert_eq!(forth.len(), 21, "the start is on the way now");
    for (there, back) in forth.iter().rev().skip(1).zip(&back) {
        close_on(10.0, there.state.t, back.state.t, 1e-12);
    }
}

#[test]
fn the_line_of_apsides_is_crossed_at_the_apsides() {
    let mut motion = Kepler.simulate(periapsis()).with_tolerance(TIGHT);
    let guards = [KeplerEvent::Apsis, KeplerEvent::Line];
    let events: Vec<_> = motion.events_of(guards, 10.5 * TAU).map(Result::unwrap).collect();
    assert_eq!(events.len(), 42);
    for (pair, k) in events.chunks(2).zip(1..) {
        let mut indices = [pair[0].index, pair[1].index];
        indices.sort_unstable();
        assert_eq!(indices, [0, 1]);
        assert!(pair.iter().all(|event| (event.state.t - f64::from(k) * PI).abs() < 1e-11));
    }
}

#[test]
fn by_runge_kutta() {
    let mut motion = Kepler.simulate_with::<Dop853>(periapsis()).with_tolerance(1e-14);
    let events: Vec<_> = motion.events(KeplerEvent::Apsis, 20.2 * TAU).map(Result::unwrap).collect();
    assert_eq!(events.len(), 40);
    for (event, k) in events.iter().zip(1..) {
        is_apsis(event, k, 1e-11);
    }
}

#[test]
fn what_grazes_is_told_from_what_crosses() {
    // The far apsis touches the circle r = 1.6, twice crosses a smaller one, and misses a larger one.
    for (offset, kinds) in
        [(0.0, &[Crossing::Touching][..]), (1e-9, &[]), (-1e-9, &[Crossing::Rising, Crossing::Falling])]
    {
        let mut motion = Kepler.simulate(periapsis()).with_tolerance(TIGHT);
        let circle = |state: &State<f64, 2>| state.q[0].hypot(state.q[1]) - (1.6 + offset);
        let found: Vec<_> = motion.events(circle, TAU).map(|event| event.unwrap()).collect();
        let crossings: Vec<_> = found.iter().map(|event| event.crossing).collect();
        assert_eq!(crossings, kinds, "{offset:e}");
        // r″ = −0.23 at the far apsis, so a circle 1e-9 smaller is crossed 1e-4 before and after it.
        assert!(found.iter().all(|event| (event.state.t - PI).abs() < 2e-4));
    }
}
