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
