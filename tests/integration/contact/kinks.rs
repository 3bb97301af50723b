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

/// An event rounds the velocity three times, by half an ulp at most, which changes the energy by an ulp each
/// time. The signs are random. A place of the event that is wrong by half an ulp of the time since the last one
/// would add four, since the force turns round there.
#[test]
fn events_on_kinks_walk_at_random_by_three_ulps_of_the_energy_at_most() {
    let (starts, mut squares, mut events) = (64, 0.0, 0.0);
    for number in 0..starts {
        let height = 0.5 + 1.5 * (f64::from(number) + 0.37) / f64::from(starts);
        let mut motion = Valley.simulate(State::at_rest([height])).with_tolerance(TIGHT);
        motion.advance_to(1000.0).unwrap();
        squares += (motion.energy() / height - 1.0).powi(2);
        // A quarter of the period is √2h.
        events += 1000.0 / (2.0 * (2.0 * height).sqrt());
    }
    let root_mean_square = (squares / f64::from(starts)).sqrt();
    let walk = (events / f64::from(starts)).sqrt() * f64::EPSILON;
    assert!(root_mean_square < 3.0 * walk, "{root_mean_square:e} instead of {walk:e}");
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

/// A spring whose force, or whose extension, is limited.
struct Limited {
    limit: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Limited {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.x * v.x + v.y * v.y)
    }

    #[potential]
    fn extended(&self, q: &Coordinates) -> f64 {
        2.0 * q.y.max(-self.limit).min(self.limit).powi(2)
    }

    #[force(on = x)]
    fn pull(&self, q: &Coordinates) -> f64 {
        (-4.0 * q.x).clamp(-self.limit, self.limit)
    }
}

#[test]
fn a_limit_that_is_not_reached_costs_no_digit() {
    for limit in [1e3, 1e9, 1e15, 1e20, 1e100] {
        let system = Limited { limit };
        let start = State::at_rest([0.3, 0.3]);
        assert_eq!(system.accelerations(&start).unwrap(), [-1.2, -1.2], "{limit:e}");
        close(system.potential_energy(&start), 0.18, 1e-15);
        let mut motion = system.simulate(start).with_tolerance(TIGHT);
        let end = motion.advance_to(1.0).unwrap();
        for q in end.q {
            close(q, 0.3 * 2.0_f64.cos(), 1e-12);
        }
    }
}

#[test]
fn a_limit_that_is_reached_holds() {
    let system = Limited { limit: 0.5 };
    for (x, expected) in [(0.1, -0.4), (1.0, -0.5), (-1.0, 0.5)] {
        assert_eq!(system.accelerations(&State::at_rest([x, 0.0])).unwrap()[0], expected, "{x}");
    }
    for (y, energy) in [(0.1, 0.02), (3.0, 0.5), (-3.0, 0.5)] {
        close(system.potential_energy(&State::at_rest([0.0, y])), energy, 1e-15);
    }
    // From 1 with the constant force 1/2 down to x = 1/8, and by the spring from there.
    let mut motion = system.simulate(State::at_rest([1.0, 0.0])).with_tolerance(TIGHT);
    let (t, v) = (3.5_f64.sqrt(), -0.5 * 3.5_f64.sqrt());
    close(motion.advance_to(t).unwrap().q[0], 0.125, 1e-13);
    let expected = 0.125 * 0.4_f64.cos() + v / 2.0 * 0.4_f64.sin();
    close(motion.advance_to(t + 0.2).unwrap().q[0], expected, 1e-12);
}

/// A value by conditions that are joined; the other one is large.
struct Joined;

#[lagrangian(coordinates = [x])]
impl Joined {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn pull(&self, q: &Coordinates) -> f64 {
        let both = if q.x > -1.0 && q.x < 1.0 { q.x } else { 1e20 };
        let either = if q.x < -2.0 || q.x > 2.0 { 1e20 } else { 3.0 * q.x };
        let neither = if !(q.x < -2.0 || q.x > 2.0) { 5.0 * q.x } else { 1e20 };
        both + either + neither
    }
}

#[test]
fn values_that_joined_conditions_leave_out_cost_no_digit() {
    for (x, expected) in [(0.25, 2.25), (-0.5, -4.5), (1.5, 1e20), (-3.0, 3e20)] {
        close(Joined.accelerations(&State::at_rest([x])).unwrap()[0], expected, 1e-15);
    }
}
