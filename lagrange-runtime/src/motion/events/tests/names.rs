//! Errors of a search, and guards with names.

use super::*;

#[test]
fn errors_come_at_their_time_and_end_the_search() {
    let mut motion = Undefined.simulate(State::new([1.0], [1.0]));
    let mut events = motion.events(|state: &State<f64, 1>| (state.q[0] - 1.5) * (state.q[0] - 2.5), 5.0);
    assert!((events.next().unwrap().unwrap().state.t - 0.5).abs() < 1e-15);
    let error = events.next().unwrap().unwrap_err();
    assert_eq!(error.cause, Cause::NotFinite);
    assert!((error.t - 1.0).abs() < 1e-12);
    assert!(events.next().is_none());
    assert!((motion.t() - 1.0).abs() < 1e-12);

    let start = State::new([0.0], [1.0]);
    let root = |state: &State<f64, 1>| (0.75 - state.q[0]).sqrt() - 0.5;
    let mut motion = FREE.simulate(start);
    let mut events = motion.events(root, 3.0);
    assert!((events.next().unwrap().unwrap().state.t - 0.5).abs() < 1e-15);
    let error = events.next().unwrap().unwrap_err();
    assert_eq!(error.cause, Cause::NotFinite);
    assert!((error.t - 0.75).abs() < 1e-14, "{error:?}");

    let wild = |state: &State<f64, 1>| (state.q[0] * 1e22).sin();
    let mut motion = FREE.simulate(State { q: [0.1], ..start });
    let end = motion.events(wild, 3.0).find_map(Result::err).unwrap();
    assert_eq!(end.cause, Cause::StepTooSmall);

    let mut motion = Oscillator.simulate(State::at_rest([1.0])).with_max_steps(3);
    let guard = |state: &State<f64, 1>| state.q[0] - 2.0;
    assert_eq!(motion.advance_to_event(guard, 100.0).unwrap_err().cause, Cause::TooManySteps);
    let reached = motion.t();
    assert!(reached > 0.0);
    assert_eq!(motion.advance_to_event(guard, f64::NAN).unwrap_err().cause, Cause::InvalidTime);
    let mut calls = 0;
    while motion.advance_to_event(guard, 100.0).is_err() {
        calls += 1;
    }
    assert!(calls > 3 && motion.t() == 100.0);
}

/// A guard by name, as generated code makes it in another crate.
#[derive(Clone, Copy)]
enum Named {
    Position,
    Velocity,
}

impl Guard<Oscillator, f64, 1> for Named {
    fn value(&self, _: &Oscillator, state: &State<f64, 1>) -> f64 {
        match self {
            Self::Position => state.q[0],
            Self::Velocity => state.v[0],
        }
    }
}

#[test]
fn names_are_guards() {
    let mut motion = Oscillator.simulate(State::at_rest([1.0])).with_tolerance(1e-13);
    let guards = [Named::Velocity, Named::Position];
    let found: Vec<_> = motion.events_of(guards, 4.0).map(|event| event.unwrap().index).collect();
    assert_eq!(found, [1, 0]);
}
