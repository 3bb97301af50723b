//! Corners: momenta and constraints that have two values at a kink are named, and smooth joints are passed.

use lagrangian::Cause;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close, close_on};

/// A particle on a track with a corner, with a coordinate that carries it up and down.
struct Track;

#[lagrangian(coordinates = [x, y])]
impl Track {
    #[point(mass = 1.0)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.5 * q.x.abs() + q.y)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * q.y * q.y
    }
}

/// A bead on a bent wire.
struct Bent;

#[lagrangian(coordinates = [x, y])]
impl Bent {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[holonomic]
    fn wire(&self, q: &Coordinates) -> f64 {
        q.y - 0.5 * q.x.abs()
    }
}

#[test]
fn a_momentum_that_jumps_is_refused() {
    let error = Track.simulate(State::new([-1.0, 0.0], [1.0, 0.0])).advance_to(2.0).unwrap_err();
    assert!(
        matches!(error.cause, Cause::MomentumJumps { name, .. } if name.as_str() == "particle"),
        "{error}"
    );
    close_on(1.0, error.t, 1.0, 1e-13);
}

#[test]
fn a_constraint_with_a_corner_is_refused() {
    let error = Bent.simulate(State::at_rest([-1.0, 0.5])).advance_to(2.0).unwrap_err();
    assert!(matches!(error.cause, Cause::MomentumJumps { name, .. } if name.as_str() == "wire"), "{error}");
    // Down a slope of one half: a = g sinα along the wire, √5/2 long.
    close_on(1.0, error.t, (2.0 * 2.5 / (2.0 * 9.81 / 2.0_f64)).sqrt(), 1e-9);
}

/// A bead on a wire of two parabolas, by a constraint and by one coordinate.
struct Joined;

#[lagrangian(coordinates = [x, y])]
impl Joined {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[holonomic]
    fn wire(&self, q: &Coordinates) -> f64 {
        q.y - if q.x > 0.0 { 0.5 * q.x * q.x } else { q.x * q.x }
    }
}

struct Reduced;

#[lagrangian(coordinates = [x])]
impl Reduced {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.x * (0.5 * q.x.max(0.0) + q.x.min(0.0)))
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * self.bead(q).y
    }
}

#[test]
fn a_smooth_joint_is_passed() {
    let mut motion = Joined.simulate(State::at_rest([-1.0, 1.0])).with_tolerance(TIGHT);
    let mut reduced = Reduced.simulate(State::at_rest([-1.0])).with_tolerance(TIGHT);
    for t in [0.5, 1.5, 10.0] {
        let (state, one) = (*motion.advance_to(t).unwrap(), *reduced.advance_to(t).unwrap());
        all_close([state.q[0], state.v[0]], [one.q[0], one.v[0]], 1e-10);
    }
    close_on(9.81, motion.energy(), 9.81, 1e-12);
    // As high on the flatter side.
    let top = reduced.advance_to_event(|state: &State<f64, 1>| state.v[0], 20.0).unwrap().unwrap().state.q[0];
    close_on(1.0, top.abs(), if top > 0.0 { 2.0_f64.sqrt() } else { 1.0 }, 1e-11);
}

/// The error of a motion in steps of Rk4.
fn by_steps<S: System<2, Scalar = f64>>(system: &S, start: State<f64, 2>) -> Option<Cause> {
    let mut motion = system.stepper::<Rk4>(start);
    (0..1000).find_map(|_| motion.step(2e-3, &[]).err()).map(|error| error.cause)
}

#[test]
fn corners_are_met_by_methods_that_look_for_no_kinks() {
    let cause = by_steps(&Track, State::new([-1.0, 0.0], [1.0, 0.0]));
    assert!(
        matches!(cause, Some(Cause::MomentumJumps { name, .. }) if name.as_str() == "particle"),
        "{cause:?}"
    );
    let mut motion = Track.simulate_with::<Dop853>(State::new([-1.0, 0.0], [1.0, 0.0]));
    let error = motion.advance_to(2.0).unwrap_err();
    assert!(
        matches!(error.cause, Cause::MomentumJumps { name, .. } if name.as_str() == "particle"),
        "{error}"
    );
    assert_eq!(by_steps(&Joined, State::at_rest([-1.0, 1.0])), None);
}
