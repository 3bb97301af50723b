//! Rounding errors of many equal steps.

use lagrangian::prelude::*;

/// A mass on a spring.
struct Oscillator {
    frequency: f64,
}

#[lagrangian(coordinates = [x])]
impl Oscillator {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * (self.frequency * q.x).powi(2)
    }
}

/// A step changes amplitudes by an ulp at random and the energy by two. Many steps change it by the root of
/// their number.
#[test]
fn the_energy_of_equal_steps_drifts_as_a_random_walk() {
    let frequencies = (0..16).map(|k| 0.7 + 0.31 * f64::from(k));
    let mut sum = 0.0;
    for frequency in frequencies.clone() {
        let system = Oscillator { frequency };
        let start = State::new([0.7], [0.4]);
        let mut motion = system.simulate(start).with_tolerance(1e-15);
        motion.advance_to(5000.0 / frequency).unwrap();
        let steps = motion.steps().accepted as f64;
        let drift = (motion.energy() / system.energy(&start) - 1.0) / f64::EPSILON;
        sum += drift * drift / steps;
    }
    let deviation = (sum / frequencies.count() as f64).sqrt();
    assert!(deviation < 2.0, "{deviation} ulps a step");
}
