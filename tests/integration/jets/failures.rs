//! Motions that cannot go on, bad arguments, and motions that go on for ever.

use lagrangian::Name;
use lagrangian::prelude::*;

use crate::support::close::{between, close};

struct Kepler {
    mu: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Kepler {
    #[point(mass = 1.0)]
    fn planet(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn sun(&self, q: &Coordinates) -> f64 {
        -self.mu / self.planet(q).norm()
    }
}

/// Falling from rest at distance 1 takes a quarter of √2 half turns.
const FALL: f64 = std::f64::consts::PI / (2.0 * std::f64::consts::SQRT_2);

#[test]
fn a_collision_is_an_error_near_its_time_at_every_tolerance() {
    for (tolerance, near) in [(1e-4, 2e-4), (1e-8, 1e-7), (1e-12, 1e-10), (1e-15, 1e-12), (0.0, 1e-12)] {
        for direction in [1.0, -1.0] {
            let mut motion =
                Kepler { mu: 1.0 }.simulate(State::at_rest([1.0, 0.0])).with_tolerance(tolerance);
            let error = motion.advance_to(2.0 * direction).unwrap_err();
            assert!(matches!(error.cause, Cause::StepTooSmall | Cause::NotFinite), "{error}");
            close(error.t, FALL * direction, near);
            let state = *motion.state();
            assert!(state.is_finite() && state.t == error.t, "{state:?}");
            between(0.0, state.q[0], 0.1);
            assert!(motion.steps().evaluations < 10_000, "{:?}", motion.steps());
            assert_eq!(motion.advance_to(2.0 * direction).unwrap_err().cause, error.cause);
        }
    }
}

/// Blows up in finite time: x = 1/(1 − t)² has x″ = 6 x².
struct Runaway {
    c: f64,
}

#[lagrangian(coordinates = [x], inputs = [push])]
impl Runaway {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        -2.0 * self.c * q.x.powi(3)
    }

    #[force(on = x)]
    fn push(&self, u: &Inputs) -> f64 {
        u.push
    }
}

#[test]
fn an_escape_to_infinity_is_an_error_at_its_time() {
    for tolerance in [1e-6, 1e-10, 1e-15] {
        let mut motion = Runaway { c: 1.0 }.simulate(State::new([1.0], [2.0])).with_tolerance(tolerance);
        let state = *motion.advance_to(0.9).unwrap();
        close(state.q[0], 100.0, 1e4 * tolerance + 1e-12);
        let error = motion.advance_to(1.5).unwrap_err();
        assert!(matches!(error.cause, Cause::StepTooSmall | Cause::NotFinite), "{error}");
        close(error.t, 1.0, 10.0 * tolerance.sqrt());
        assert!(motion.state().is_finite() && motion.t() == error.t);
        assert!(motion.steps().evaluations < 2_000, "{:?}", motion.steps());
    }
}

#[test]
fn what_is_not_finite_is_refused_and_changes_nothing() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for start in [State::new([bad], [0.0]), State::new([0.0], [bad]), State::at_rest([1.0]).at_time(bad)]
        {
            let runaway = Runaway { c: 1.0 };
            let mut motion = runaway.simulate(start);
            assert_eq!(motion.advance_to(1.0).unwrap_err().cause, Cause::NotFinite);
            assert!(motion.steps().evaluations < 100);
            let mut stepper = runaway.stepper::<Jet<5>>(start);
            assert_eq!(stepper.step(0.1, &[0.0]).unwrap_err().cause, Cause::NotFinite);
        }
        let start = State::new([1.0], [2.0]).at_time(3.0);
        let error = MotionError { cause: Cause::NotFinite, t: 3.0 };
        assert_eq!(Runaway { c: bad }.simulate(start).advance_to(4.0).unwrap_err(), error);
        let runaway = Runaway { c: 1.0 };
        let mut motion = runaway.simulate(start).with_inputs([bad]);
        assert_eq!(motion.advance_to(3.1).unwrap_err(), error);
        assert_eq!(motion.state(), &start);
        assert!(motion.steps().evaluations < 200, "{:?}", motion.steps());
        // With good inputs it goes on.
        motion.set_inputs([0.0]);
        assert!(motion.advance_to(3.1).is_ok());
        assert_eq!(motion.advance_to(bad).unwrap_err().cause, Cause::InvalidTime);
        let mut motion = runaway.simulate(start).with_step_limit(bad);
        assert_eq!(motion.advance_to(3.1).unwrap_err().cause, Cause::InvalidStep);
        let mut motion = runaway.simulate(start).with_tolerance(bad);
        assert_eq!(motion.advance_to(3.1).unwrap_err().cause, Cause::InvalidTolerance);
        let mut motion = runaway.simulate(start).with_tolerances(1e-10, bad);
        assert_eq!(motion.advance_to(3.1).unwrap_err().cause, Cause::InvalidTolerance);
        assert_eq!(motion.state(), &start);
    }
    let runaway = Runaway { c: 1.0 };
    let mut motion = runaway.simulate(State::at_rest([1.0])).with_tolerance(-1e-10);
    assert_eq!(motion.advance_to(3.1).unwrap_err().cause, Cause::InvalidTolerance);
}

/// M by entries, one of which vanishes at a pole, and by a constant block.
struct Masses {
    m: [f64; 4],
}

#[lagrangian(coordinates = [x, phi, theta, a, b])]
impl Masses {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector3<f64> {
        let (sin, cos) = q.phi.sin_cos();
        Vector3::new(sin * q.theta.cos(), sin * q.theta.sin(), -cos)
    }

    #[kinetic]
    fn carts(&self, v: &Velocities) -> f64 {
        0.5 * (self.m[0] * v.x.powi(2) + self.m[1] * v.a.powi(2) + self.m[2] * (v.a + v.b).powi(2))
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).z + 0.5 * self.m[3] * (q.x.powi(2) + q.a.powi(2) + q.b.powi(2))
    }
}

#[test]
fn a_singular_mass_matrix_is_reported_with_coordinate_and_time() {
    let good = State::new([0.1, 0.6, 0.2, 0.3, 0.4], [0.1, 0.2, 0.9, 0.1, 0.1]).at_time(7.0);
    let pole = State { q: [0.1, 0.0, 0.2, 0.3, 0.4], ..good };
    let cases = [
        ([1.0, 1.0, 1.0, 1.0], pole, 2),
        ([0.0, 1.0, 1.0, 1.0], good, 0),
        ([1.0, 0.0, 0.0, 1.0], good, 3),
        ([1.0, 1.0, 0.0, 1.0], good, 4),
    ];
    for (m, start, pivot) in cases {
        let masses = Masses { m };
        let name = Name::new(&Masses::NAMES.coordinates[pivot]);
        let expected = MotionError { cause: Cause::SingularMassMatrix { pivot, name }, t: 7.0 };
        let mut motion = masses.simulate(start);
        for t in [8.0, 6.0] {
            assert_eq!(motion.advance_to(t).unwrap_err(), expected);
        }
        assert_eq!(motion.state(), &start);
        assert!(motion.steps().evaluations < 100, "{:?}", motion.steps());
        let mut stepper = masses.stepper::<Jet<6>>(start);
        assert_eq!(stepper.step(0.1, &[]).unwrap_err(), expected);
        assert_eq!(stepper.state(), &start);
    }
    assert!(Masses { m: [1.0; 4] }.simulate(good).advance_to(8.0).is_ok());
}

#[test]
fn the_limit_of_steps_holds_and_the_motion_can_go_on() {
    let kepler = Kepler { mu: 1.0 };
    let start = State::new([1.0, 0.0], [0.0, 1.1]);
    let mut motion = kepler.simulate(start).with_max_steps(20);
    let error = motion.advance_to(1000.0).unwrap_err();
    assert_eq!((error.cause, error.t), (Cause::TooManySteps, motion.t()));
    between(1.0, motion.t(), 100.0);
    assert!(motion.steps().accepted + motion.steps().rejected <= 20);
    let mut whole = kepler.simulate(start);
    while motion.advance_to(100.0).is_err() {}
    let (found, expected) = (*motion.state(), *whole.advance_to(100.0).unwrap());
    for (found, expected) in found.iter().zip(expected.iter()) {
        close(found, expected, 1e-6);
    }
    let mut none = kepler.simulate(start).with_max_steps(0);
    assert_eq!(none.advance_to(1.0).unwrap_err().cause, Cause::TooManySteps);
    assert!(none.advance_to(0.0).is_ok(), "no step is needed to stay");
}

/// Free, at rest in an equilibrium, at rest on top of a hill, and on an exponential way.
struct Idle;

#[lagrangian(coordinates = [free, bottom, top, hill])]
impl Idle {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (v.free.powi(2) + v.bottom.powi(2) + v.top.powi(2) + v.hill.powi(2))
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        q.top.cos() - q.bottom.cos() - 0.5 * q.hill.powi(2)
    }
}

#[test]
fn nothing_happens_for_a_long_time_in_one_step() {
    let start = State::new([1.0, 0.0, 0.0, 0.0], [2.0, 0.0, 0.0, 0.0]);
    for t in [1e-300, 1e-30, 1.0, 1e9, 1e100, -1e9] {
        let mut motion = Idle.simulate(start);
        let state = *motion.advance_to(t).unwrap();
        assert_eq!(state, State { q: [1.0 + 2.0 * t, 0.0, 0.0, 0.0], ..start }.at_time(t));
        assert!(motion.steps().evaluations <= 2, "{:?}", motion.steps());
    }
}

#[test]
fn a_coordinate_beyond_the_arithmetic_is_an_error_and_the_last_good_state_is_kept() {
    let start = State::new([1.0, 0.0, 0.0, 0.0], [1e200, 0.0, 0.0, 0.0]);
    let mut motion = Idle.simulate(start);
    assert_eq!(motion.advance_to(1e200).unwrap_err().cause, Cause::NotFinite);
    assert_eq!(motion.state(), &start);
    close(motion.advance_to(3.0).unwrap().q[0] / 3e200, 1.0, 1e-15);
    // e^t leaves the arithmetic near t = 709.
    let mut motion = Idle.simulate(State::new([0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 1.0]));
    close(motion.advance_to(100.0).unwrap().q[3].ln(), 100.0, 1e-11);
    let error = motion.advance_to(1000.0).unwrap_err();
    between(600.0, error.t, 710.0);
    assert!(motion.state().is_finite());
    assert!(motion.steps().evaluations < 2000, "{:?}", motion.steps());
}

/// A spring on which a pendulum without weight hangs, so short that the cube of its length is no number.
struct Tiny;

#[lagrangian(coordinates = [x, y])]
impl Tiny {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        15.0 * (self.bob(q).norm() - 1e-110).powi(2)
    }
}

/// Its forces are numbers, so that a leap is right wherever the motion stands.
#[test]
fn leaps_do_not_take_the_place_of_a_series_for_ever() {
    for tolerance in [1e-6, 1e-15] {
        let start = State::new([1.1e-110, 2e-111], [1e-111, 1.3e-110]);
        let mut motion = Tiny.simulate(start).with_tolerance(tolerance).with_max_steps(2000);
        assert_eq!(motion.advance_to(3.0).unwrap_err().cause, Cause::NotFinite);
        assert!(motion.state().is_finite());
    }
}
