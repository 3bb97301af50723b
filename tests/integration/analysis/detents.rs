//! Functions that are narrow or flat beside a step: equilibria in detents, derivatives at the zero of a high
//! power.

use lagrangian::prelude::*;

use crate::support::sample::Samples;

/// A pendulum with teeth: narrow wells of one depth.
struct Teeth {
    depth: f64,
    count: f64,
    sharpness: f64,
}

#[lagrangian(coordinates = [x], jacobians)]
impl Teeth {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        -q.x.cos()
    }

    #[potential]
    fn wells(&self, q: &Coordinates) -> f64 {
        -self.depth * (self.sharpness * ((self.count * q.x).cos() - 1.0)).exp()
    }
}

impl Teeth {
    fn force(&self, x: f64) -> f64 {
        let well = (self.sharpness * ((self.count * x).cos() - 1.0)).exp();
        -x.sin() - self.depth * self.count * self.sharpness * (self.count * x).sin() * well
    }

    /// Where the force changes its sign downhill of a place, in steps of this length.
    fn rests(&self, mut x: f64, step: f64) -> f64 {
        let side = self.force(x).signum();
        while self.force(x) * side > 0.0 {
            x += side * step;
        }
        x
    }
}

#[test]
fn the_first_well_downhill_is_found() {
    let mut samples = Samples::new(1);
    for _ in 0..300 {
        let count = samples.number(3.0, 48.0).round();
        let sharpness = 10_f64.powf(samples.number(1.5, 3.0));
        // The steepest slope of exp(−s x²/2) is √(s/e), so a well of this depth just holds the pendulum.
        let least = (std::f64::consts::E / sharpness).sqrt() / count;
        let depth = least * 10_f64.powf(samples.number(0.3, 2.0));
        let teeth = Teeth { depth, count, sharpness };
        let guess = samples.number(-3.0, 3.0);
        let step = 0.01 / (count * sharpness.sqrt());
        let expected = teeth.rests(guess, step);
        let found = teeth.equilibrium([guess], &[]).unwrap().state.q[0];
        assert!((found - expected).abs() <= 2.0 * step, "{guess}: {found} instead of {expected}");
    }
}

/// A rotor with a torque that vanishes to a high order at half a turn.
struct Rotor {
    torque: f64,
}

#[lagrangian(coordinates = [x], jacobians)]
impl Rotor {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn push(&self, q: &Coordinates) -> f64 {
        self.torque * (0.5 + 0.5 * q.x.cos()).powi(8)
    }
}

#[test]
fn derivatives_pass_the_zero_of_a_high_power() {
    let mut samples = Samples::new(2);
    for _ in 0..40 {
        let rotor = Rotor { torque: samples.number(-0.1, 0.1) };
        let (x, v) = (samples.number(-1.0, 1.0), samples.number(0.8, 2.0));
        let end = |v: f64| {
            let start = State::new([x], [v]);
            rotor.simulate(start).with_tolerance(1e-13).advance_to(8.0).unwrap().q[0]
        };
        let expected = (end(v + 1e-4) - end(v - 1e-4)) / 2e-4;
        let variational = rotor.variational();
        let mut motion = variational.motion(State::new([x], [v])).unwrap().with_tolerance(1e-11);
        let found = motion.advance_to(8.0).unwrap().q_by_v[0];
        assert!((found - expected).abs() <= 1e-5 * expected.abs().max(1.0), "{found} {expected}");
    }
}
