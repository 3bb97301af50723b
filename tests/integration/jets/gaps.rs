//! Series with gaps: orders whose coefficients vanish by symmetry, or nearly vanish, say nothing about the
//! step.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};
use crate::support::motion::numbers;

/// V = |x|^(p + 1) / (p + 1): from the origin only every (p + 1)-th order is there.
struct Oscillators;

#[lagrangian(coordinates = [cubic, quintic, septic, linear])]
impl Oscillators {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (v.cubic.powi(2) + v.quintic.powi(2) + v.septic.powi(2) + v.linear.powi(2))
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        q.cubic.powi(4) / 4.0 + q.quintic.powi(6) / 6.0 + q.septic.powi(8) / 8.0
    }
}

/// x″ = −tᵖ x.
struct Stiffening;

#[lagrangian(coordinates = [first, second, fourth])]
impl Stiffening {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (v.first.powi(2) + v.second.powi(2) + v.fourth.powi(2))
    }

    #[potential]
    fn potential(&self, q: &Coordinates, t: f64) -> f64 {
        0.5 * (t * q.first.powi(2) + t.powi(2) * q.second.powi(2) + t.powi(4) * q.fourth.powi(2))
    }
}

/// Tolerances to which all orders up to the highest belong.
const TOLERANCES: [f64; 11] = [1e-4, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-16];

#[test]
fn a_start_at_a_symmetric_place_or_near_it() {
    for near in [0.0, 1e-300, 1e-12, 1e-6, 1e-3] {
        let one_by_one = |i: usize| {
            let mut start = State::new([0.0; 4], [0.0; 4]);
            (start.q[i], start.v[i]) = (near, 1.0);
            start
        };
        for i in 0..3 {
            let start = one_by_one(i);
            let mut reference = Oscillators.simulate_with::<Dop853>(start).with_tolerance(1e-14);
            let reference = numbers(reference.advance_to(4.0).unwrap());
            for tolerance in TOLERANCES {
                let mut motion = Oscillators.simulate(start).with_tolerance(tolerance);
                all_close(numbers(motion.advance_to(4.0).unwrap()), &reference, 1e-11 + 500.0 * tolerance);
            }
        }
    }
}

#[test]
fn a_start_at_a_symmetric_time_or_near_it() {
    let start = State::new([1.0, -1.0, 1.0], [0.0; 3]);
    let mut reference = Stiffening.simulate_with::<Dop853>(start).with_tolerance(1e-15);
    let reference = numbers(reference.advance_to(3.0).unwrap());
    for tolerance in TOLERANCES {
        for velocity in [0.0, 1e-13] {
            let start = State::new(start.q, [velocity, 0.0, -velocity]);
            let mut motion = Stiffening.simulate(start).with_tolerance(tolerance);
            all_close(numbers(motion.advance_to(3.0).unwrap()), &reference, 2e-11 + 100.0 * tolerance);
        }
    }
}

#[test]
fn a_tiny_first_call_does_not_mislead_the_next() {
    let reference = {
        let mut motion = Stiffening.simulate_with::<Dop853>(start_late()).with_tolerance(1e-15);
        numbers(motion.advance_to(4.0).unwrap())
    };
    for tiny in [1e-3, 1e-9, 1e-13] {
        let mut motion = Stiffening.simulate(start_late()).with_tolerance(1e-14);
        motion.advance_to(1.0 + tiny).unwrap();
        all_close(numbers(motion.advance_to(4.0).unwrap()), &reference, 1e-11);
    }
    // At time zero a call may be so short that the highest coefficients underflow in any unit.
    for tiny in [1e-9, 1e-18, 1e-22, 1e-30, 1e-50] {
        let start = State::new([1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]);
        let mut motion = Oscillators.simulate(start).with_tolerance(1e-14);
        let mut plain = Oscillators.simulate(start).with_tolerance(1e-14);
        motion.advance_to(tiny).unwrap();
        plain.advance_to(3.0).unwrap();
        all_close(numbers(motion.advance_to(3.0).unwrap()), numbers(plain.state()), 1e-12);
        close(motion.state().q[3], 3.0, 1e-15);
        assert!(motion.steps().rejected < 10, "{:?}", motion.steps());
    }
}

fn start_late() -> State<f64, 3> {
    State::new([1.0, 0.3, -0.5], [0.0, 1.0, 0.2]).at_time(1.0)
}

/// x″ = t⁴⁰: at t = 0 all coefficients up to the highest order vanish.
struct Late;

#[lagrangian(coordinates = [x])]
impl Late {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2)
    }

    #[force]
    fn push(&self, t: f64) -> [f64; 1] {
        [t.powi(40)]
    }
}

#[test]
fn coefficients_that_vanish_to_the_highest_order_are_no_polynomial() {
    for tolerance in [1e-6, 1e-10, 1e-15] {
        let mut motion = Late.simulate(State::at_rest([0.0])).with_tolerance(tolerance);
        close(motion.advance_to(1.0).unwrap().q[0], 1.0 / (41.0 * 42.0), 1e-12 + tolerance);
    }
    let mut free = Late.simulate(State::at_rest([0.0]));
    close(free.advance_to(-1.0).unwrap().q[0], 1.0 / (41.0 * 42.0), 1e-9);
}
