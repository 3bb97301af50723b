//! Kinks and jumps.

use super::*;

/// x″ = −sign x, or two springs.
#[derive(Clone, Copy, Debug)]
enum Kinked {
    Jump,
    Springs,
}

impl Toy<1, 0, 1> for Kinked {
    const ROWS: [Row; 0] = [];

    fn mass(&self) -> [f64; 1] {
        [1.0]
    }

    fn forces(&self, _: f64, q: &[f64; 1], _: &[f64; 1], kinks: &[f64; 1]) -> [f64; 1] {
        match self {
            Self::Jump => [-kinks[0]],
            Self::Springs => [if kinks[0] > 0.0 { -4.0 * q[0] } else { -9.0 * q[0] }],
        }
    }

    fn gradients(&self) -> [[f64; 1]; 0] {
        []
    }

    fn kinks<R: Real>(&self, q: &[R; 1], _: &[R; 1]) -> [R; 1] {
        *q
    }
}

#[test]
fn a_kink_costs_no_digits() {
    let kinked = Model(Kinked::Jump);
    let mut motion = kinked.start([1.0], [0.0]);
    let state = *motion.advance_to(1000.0).unwrap();
    // The times of its steps are known to 1e-13 there, and a period adds up what they lack.
    assert!((state.q[0] - 0.2021601512945516).abs() < 1e-9, "{state:?}");
    let state = *motion.advance_to(999.0).unwrap();
    let back = *motion.advance_to(0.0).unwrap();
    assert!((back.q[0] - 1.0).abs() < 1e-9 && back.v[0].abs() < 1e-9, "{state:?} {back:?}");
    let springs = Model(Kinked::Springs);
    let period = 2.6179938779914944;
    let state = *springs.start([1.0], [0.0]).advance_to(10.0 * period).unwrap();
    assert!((state.q[0] - 1.0).abs() < 1e-11 && state.v[0].abs() < 1e-11, "{state:?}");
}

/// v′ = −sign v with a drive: friction written as a jump.
#[derive(Clone, Copy, Debug)]
struct Stuck;

impl Toy<1, 0, 1> for Stuck {
    const ROWS: [Row; 0] = [];

    fn mass(&self) -> [f64; 1] {
        [1.0]
    }

    fn forces(&self, _: f64, _: &[f64; 1], _: &[f64; 1], kinks: &[f64; 1]) -> [f64; 1] {
        [0.5 - kinks[0]]
    }

    fn gradients(&self) -> [[f64; 1]; 0] {
        []
    }

    fn kinks<R: Real>(&self, _: &[R; 1], v: &[R; 1]) -> [R; 1] {
        *v
    }
}

#[test]
fn a_jump_that_holds_the_motion_is_an_error() {
    let error = Model(Stuck).start([0.0], [1.0]).advance_to(10.0).unwrap_err();
    assert!(
        matches!(error.cause, Cause::HeldAtKink { kink: 0, .. }) && (error.t - 2.0).abs() < 1e-12,
        "{error:?}"
    );
}
