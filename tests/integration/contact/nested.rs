//! Kinks within kinks, and guards that are not smooth everywhere.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::close_on;

/// A mass with play: the force begins where the dead zone ends, a kink within a kink.
struct DeadZone {
    stiffness: f64,
    play: f64,
}

#[lagrangian(coordinates = [x])]
impl DeadZone {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force]
    fn spring(&self, q: &Coordinates) -> f64 {
        -self.stiffness * (q.x - q.x.clamp(-self.play, self.play))
    }
}

#[test]
fn a_dead_zone() {
    let system = DeadZone { stiffness: 10.0, play: 0.5 };
    let rate = system.stiffness.sqrt();
    for i in 0..40 {
        // From the middle with a speed u: a free way, half a period of the spring, and back.
        let speed = 0.1 + 0.05 * f64::from(i);
        let period = 4.0 * system.play / speed + 2.0 * core::f64::consts::PI / rate;
        let mut motion = system.simulate(State::new([0.0], [speed])).with_tolerance(TIGHT);
        let end = *motion.advance_to(7.0 * period).unwrap();
        close_on(1.0, end.q[0], 0.0, 1e-11);
        close_on(1.0, end.v[0], speed, 1e-11);
        let widest = *motion.advance_to(7.0 * period + 0.25 * period).unwrap();
        close_on(1.0, widest.q[0], system.play + speed / rate, 1e-11);
    }
}

/// The smaller and the larger of two distances.
struct Bounds;

#[lagrangian(coordinates = [x])]
impl Bounds {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force]
    fn spring(&self, q: &Coordinates) -> f64 {
        -2.0 * q.x.min(0.0) - 3.0 * q.x.max(0.0)
    }
}

#[test]
fn two_functions_of_one_switch_have_one_kink() {
    let structure = Bounds::STRUCTURE.to_string();
    assert!(structure.contains("switched at its zeros: 1"), "{structure}");
    let pi = core::f64::consts::PI;
    let (first, second) = (pi / 2.0 / 3.0_f64.sqrt(), pi / 2.0_f64.sqrt());
    let mut motion = Bounds.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    let end = *motion.advance_to(2.0 * first + second).unwrap();
    close_on(1.0, end.q[0], 1.0, 1e-12);
}

/// A bead within a ring, whose distance from the middle has a tip there.
struct Ring;

#[lagrangian(coordinates = [x, y])]
impl Ring {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[unilateral(restitution = 1.0)]
    fn wall(&self, q: &Coordinates) -> f64 {
        1.0 - Vector2::new(q.x, q.y).norm()
    }
}

#[test]
fn a_gap_with_a_tip_on_the_way() {
    // Through the middle, where the series of the distance goes on as if it had changed its sign.
    let mut motion = Ring.simulate(State::new([-0.3, -0.4], [0.3, 0.4]));
    let end = *motion.advance_to(10.0).unwrap();
    for (value, expected) in end.q.into_iter().chain(end.v).zip([0.3, 0.4, 0.3, 0.4]) {
        close_on(1.0, value, expected, 1e-12);
    }
}

/// A force by the number of a mode, which the speed switches.
struct Modes {
    threshold: f64,
}

#[lagrangian(coordinates = [x])]
impl Modes {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn drive(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let mode = if v.x > self.threshold { 2.0 } else { 0.0 };
        let force = if mode > 1.5 {
            0.3
        } else if mode > 0.5 {
            0.5
        } else {
            0.2 * q.x
        };
        force - q.x
    }
}

/// The same force, written out.
struct Written {
    threshold: f64,
}

#[lagrangian(coordinates = [x])]
impl Written {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn drive(&self, q: &Coordinates, v: &Velocities) -> f64 {
        if v.x > self.threshold { 0.3 - q.x } else { -0.8 * q.x }
    }
}

/// All that contains a switch leaps with it. A regime that the model does not have must not come between.
#[test]
fn modes_that_a_switch_numbers_change_with_it() {
    for step in 0..200 {
        let part = |k: f64| (k * f64::from(step) * 0.618).fract();
        let threshold = 0.6 * part(1.0) - 0.3;
        let start = State::new([2.0 * part(2.0) - 1.0], [2.0 * part(3.0) - 1.0]);
        let (modes, written) = (Modes { threshold }, Written { threshold });
        match (modes.simulate(start).advance_to(3.0), written.simulate(start).advance_to(3.0)) {
            (Ok(found), Ok(wanted)) => {
                close_on(1.0, found.q[0], wanted.q[0], 1e-9);
                close_on(1.0, found.v[0], wanted.v[0], 1e-9);
            }
            (Err(found), Err(wanted)) => {
                // Both are held at the threshold.
                close_on(1.0, found.t, wanted.t, 1e-9);
            }
            (found, wanted) => panic!("{found:?} {wanted:?}"),
        }
        let (mut modes, mut written) = (modes.stepper::<Jet<8>>(start), written.stepper::<Jet<8>>(start));
        for _ in 0..100 {
            let (Ok(found), Ok(wanted)) = (modes.step(0.01, &[]), written.step(0.01, &[])) else { break };
            close_on(1.0, found.v[0], wanted.v[0], 1e-9);
        }
    }
}

/// The magnitude of a force that a speed switches over.
struct Switched;

#[lagrangian(coordinates = [x])]
impl Switched {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn drive(&self, v: &Velocities) -> f64 {
        (if v.x > 0.7 { -3.0_f64 } else { 1.0 }).abs()
    }
}

#[test]
fn a_motion_is_not_held_where_its_force_leaps_over_zero() {
    let end = *Switched.simulate(State::new([0.0], [0.1])).advance_to(2.0).unwrap();
    close_on(1.0, end.q[0], 4.16, 1e-13);
    close_on(1.0, end.v[0], 4.9, 1e-13);
}

/// A controller with a limit whose reference steps at a time.
struct Stepped {
    steps: f64,
}

#[lagrangian(coordinates = [x], sensitivities = [self.steps])]
impl Stepped {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn control(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        let reference = if t > self.steps { 1.0 } else { -1.0 };
        (4.0 * (reference - q.x) - 3.0 * v.x).clamp(-2.0, 2.0)
    }
}

/// The same, limited in each branch.
struct Branched {
    steps: f64,
}

#[lagrangian(coordinates = [x], sensitivities = [self.steps])]
impl Branched {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn control(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        if t > self.steps {
            (4.0 * (1.0 - q.x) - 3.0 * v.x).clamp(-2.0, 2.0)
        } else {
            (4.0 * (-1.0 - q.x) - 3.0 * v.x).clamp(-2.0, 2.0)
        }
    }
}

#[test]
fn derivatives_go_through_a_limit_whose_argument_leaps() {
    for (steps, end) in [(0.7, 0.9), (0.7, 1.7), (1.3, 1.5), (1.3, 2.3), (2.0, 3.0)] {
        let start = State::new([-0.6], [0.2]);
        let (stepped, branched) = (Stepped { steps }, Branched { steps });
        let (stepped, branched) = (stepped.variational(), branched.variational());
        let (mut stepped, mut branched) = (stepped.motion(start).unwrap(), branched.motion(start).unwrap());
        let (found, wanted) = (stepped.advance_to(end).unwrap(), branched.advance_to(end).unwrap());
        for (found, wanted) in [
            (found.q_by_q[(0, 0)], wanted.q_by_q[(0, 0)]),
            (found.q_by_v[(0, 0)], wanted.q_by_v[(0, 0)]),
            (found.q_by_p[(0, 0)], wanted.q_by_p[(0, 0)]),
            (found.v_by_p[(0, 0)], wanted.v_by_p[(0, 0)]),
        ] {
            close_on(1.0, found, wanted, 1e-9);
        }
    }
}

#[test]
fn a_motion_goes_back_and_on_again_through_limits_that_leap() {
    for step in 0..100 {
        let part = |k: f64| (k * f64::from(step) * 0.618).fract();
        let system = Stepped { steps: 0.3 + 2.0 * part(1.0) };
        let start = State::new([2.0 * part(2.0) - 1.0], [2.0 * part(3.0) - 1.0]);
        let mut motion = system.simulate(start);
        let there = *motion.advance_to(3.0).unwrap();
        let back = *motion.advance_to(0.0).unwrap();
        let again = *motion.advance_to(3.0).unwrap();
        // The controller damps, so errors grow on the way back.
        close_on(1.0, back.q[0], start.q[0], 1e-7);
        close_on(1.0, again.q[0], there.q[0], 1e-7);
        close_on(1.0, again.v[0], there.v[0], 1e-7);
    }
}
