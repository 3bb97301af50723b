//! What rounding leaves of a motion after many switches.

use lagrangian::prelude::*;

/// V = |x|.
struct Valley;

#[lagrangian(coordinates = [x])]
impl Valley {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2)
    }

    #[potential]
    fn depth(&self, q: &Coordinates) -> f64 {
        q.x.abs()
    }
}

/// Between switches a motion is a parabola, so rounding is all that changes its energy: an ulp at a switch at
/// most, which add up to the root of their number.
#[test]
fn a_thousand_switches_change_the_energy_by_no_more_than_rounding_does() {
    let switches = 1000_u32;
    for depth in (0..15).map(|k| 0.7 + 0.061 * f64::from(k)) {
        for tolerance in [1e-10, 1e-14] {
            let mut motion = Valley.simulate(State::new([depth], [0.0])).with_tolerance(tolerance);
            for _ in 0..switches {
                motion.advance_to_switch(1e5).unwrap().expect("a switch");
            }
            // The place of a switch lies on either side of the bottom.
            let t = motion.state().t + 0.1;
            motion.advance_to(t).unwrap();
            let State { q: [x], v: [v], .. } = *motion.state();
            let gained = (0.5 * v * v + x.abs() - depth) / depth;
            let bound = f64::EPSILON * f64::from(switches).sqrt();
            assert!(gained.abs() < bound, "{depth} at {tolerance:e}: {gained:e}");
        }
    }
}

/// A ball that bounces to 9/16 of its height.
struct Ball;

#[lagrangian(coordinates = [y])]
impl Ball {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.5 * v.y.powi(2)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral(restitution = 0.75)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

/// The velocity is rounded where the ball meets the floor, where it leaves it, and where time is rounded. The
/// variance of a rounding is a twelfth of an ulp squared, so that an impact changes the energy by an ulp at
/// random, and 20 impacts by √20 of them.
#[test]
fn impacts_leave_the_energy_that_restitution_leaves() {
    let (balls, impacts) = (200, 20);
    let mut sum = 0.0;
    for height in (0..balls).map(|k| 0.7 + 0.0061 * f64::from(k)) {
        let mut motion = Ball.simulate(State::new([height], [0.0])).with_tolerance(1e-12);
        for _ in 0..impacts {
            motion.advance_to_switch(1e5).unwrap().expect("an impact");
        }
        let t = motion.t() + 0.01 * motion.state().v[0].abs();
        motion.advance_to(t).unwrap();
        let State { q: [y], v: [v], .. } = *motion.state();
        let left = 0.5625_f64.powi(impacts);
        let gained = (0.5 * v * v + 9.81 * y) / (9.81 * height * left) - 1.0;
        sum += (gained / f64::EPSILON).powi(2);
    }
    let deviation = (sum / f64::from(balls)).sqrt();
    assert!(deviation < f64::from(impacts).sqrt(), "{deviation} ulps");
}
