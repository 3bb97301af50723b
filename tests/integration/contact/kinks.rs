//! N14: kinks and jumps in a description are switches.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{close, close_on};

struct Valley;

#[lagrangian(coordinates = [x])]
impl Valley {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn depth(&self, q: &Coordinates) -> f64 {
        q.x.abs()
    }
}

#[test]
fn a_valley_with_a_kink() {
    let mut motion = Valley.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    close(motion.advance_to(5.656854249492381).unwrap().q[0], 1.0, 1e-13);
    close_on(1.0, motion.advance_to(1000.0).unwrap().q[0], 0.2021601512945516, 1e-11);
    close(motion.energy(), 1.0, 1e-13);
    // The motion has 353 zeros in a thousand seconds, and a step on either side of each.
    assert!(motion.steps().accepted < 1500, "{:?}", motion.steps());
}

struct Bilinear;

#[lagrangian(coordinates = [x])]
impl Bilinear {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        let stiffness = if q.x > 0.0 { 4.0 } else { 9.0 };
        0.5 * stiffness * q.x * q.x
    }
}

#[test]
fn a_spring_that_is_stiffer_on_one_side() {
    let period = 2.6179938779914944;
    let mut motion = Bilinear.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    for periods in [1, 100] {
        let state = motion.advance_to(periods as f64 * period).unwrap();
        close_on(1.0, state.q[0], 1.0, 1e-12);
        close_on(1.0, state.v[0], 0.0, 1e-11);
    }
    let mut backward = Bilinear.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    close_on(1.0, backward.advance_to(-10.0 * period).unwrap().q[0], 1.0, 1e-12);
}

/// Drag that grows with the square of the speed has a kink at rest.
struct Drag;

#[lagrangian(coordinates = [x])]
impl Drag {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * q.x * q.x
    }

    #[force]
    fn drag(&self, v: &Velocities) -> f64 {
        -0.3 * v.x.abs() * v.x
    }
}

#[test]
fn a_kink_at_a_turning_point() {
    // Between turning points E' = −0.6 |v|³ has the integral (x ∓ 1/0.6 … ) of a linear equation in v².
    let mut motion = Drag.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    let mut other = Drag.simulate_with::<Dop853>(State::at_rest([1.0])).with_tolerance(1e-13);
    let (a, b) = (*motion.advance_to(20.0).unwrap(), *other.advance_to(20.0).unwrap());
    close_on(1.0, a.q[0], b.q[0], 1e-11);
    assert!(motion.steps().accepted < 200, "{:?}", motion.steps());
}

/// A step of the potential, which nothing climbs by its slope.
struct Step;

#[lagrangian(coordinates = [x])]
impl Step {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn height(&self, q: &Coordinates) -> f64 {
        if q.x > 1.0 { 0.25 } else { 0.0 }
    }
}

#[test]
fn an_energy_that_jumps_is_refused() {
    let error = Step.simulate(State::new([0.0], [1.0])).advance_to(2.0).unwrap_err();
    assert!(matches!(error.cause, Cause::EnergyJumps { name, .. } if name.as_str() == "height"), "{error}");
    assert!(error.to_string().contains("in `height`"), "{error}");
    close(error.t, 1.0, 1e-12);
}

/// A relay: a force that holds the motion where it jumps.
struct Relay;

#[lagrangian(coordinates = [x])]
impl Relay {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force]
    fn relay(&self, q: &Coordinates, v: &Velocities) -> f64 {
        -(q.x + v.x).signum()
    }
}

#[test]
fn a_motion_that_is_held_at_a_jump_ends_there() {
    let error = Relay.simulate(State::new([1.0], [0.0])).advance_to(20.0).unwrap_err();
    assert!(matches!(error.cause, Cause::HeldAtKink { name, .. } if name.as_str() == "relay"), "{error}");
}
