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
