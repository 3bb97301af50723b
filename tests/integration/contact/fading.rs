//! Limits of friction that fade to zero and come back: a brake that is let go, a clutch that breathes.

use lagrangian::prelude::*;

use crate::support::close::{close, close_on};
use crate::support::sample::Samples;

/// A disc with a brake of three kinds: a (1 + cos ωt), a max(sin ωt, 0), and a |sin ωt|.
macro_rules! brake {
    ($name:ident, $phase:ident, $limit:expr) => {
        struct $name {
            most: f64,
            rate: f64,
        }

        #[lagrangian(coordinates = [angle])]
        impl $name {
            #[kinetic]
            fn turning(&self, v: &Velocities) -> f64 {
                0.5 * v.angle * v.angle
            }

            fn limit(&self, t: f64) -> f64 {
                let $phase = self.rate * t;
                self.most * $limit
            }

            #[friction(limit = limit)]
            fn brake(&self, v: &Velocities) -> f64 {
                v.angle
            }
        }
    };
}

brake!(Breathing, phase, (1.0 + phase.cos()));
brake!(Pulsed, phase, phase.sin().max(0.0));
brake!(Rectified, phase, phase.sin().abs());

/// The speed that is left after whole turns of the phase.
fn left(fast: f64, mean: f64, most: f64, time: f64) -> f64 {
    fast - mean * most * time
}

#[test]
fn a_brake_that_fades_takes_its_part_each_time() {
    let mut samples = Samples::new(67);
    for _ in 0..40 {
        let (most, rate) = (samples.number(0.5, 4.0), samples.number(0.5, 4.0));
        let time = 6.0 * std::f64::consts::TAU / rate;
        let start = State::new([0.0], [2.0 * most * time + 1.0]);
        macro_rules! check {
            ($brake:expr, $mean:expr) => {
                let end = *$brake.simulate(start).with_tolerance(1e-11).advance_to(time).unwrap();
                let expected = left(start.v[0], $mean, most, time);
                close(end.v[0], expected, 1e-11);
            };
        }
        check!(Breathing { most, rate }, 1.0);
        check!(Pulsed { most, rate }, std::f64::consts::FRAC_1_PI);
        check!(Rectified { most, rate }, std::f64::consts::FRAC_2_PI);
    }
}

/// In a short step beside t = π nothing is seen but 1 + cos t ≈ 0 with its rounding errors.
#[test]
fn short_steps_pass_a_limit_that_touches_zero() {
    let breathing = Breathing { most: 2.0, rate: 1.0 };
    let (start, end): (State<f64, 1>, f64) = (State::new([0.0], [30.0]), 3.2);
    let expected = 30.0 - 2.0 * (end + end.sin());
    let mut motion = breathing.simulate(start).with_step_limit(0.002);
    close(motion.advance_to(end).unwrap().v[0], expected, 1e-9);
    for h in [0.0005, 0.002, 0.03] {
        let mut stepper = breathing.stepper::<Jet<6>>(start);
        while stepper.state().t < 3.2 {
            stepper.step(h, &[]).unwrap();
        }
        let state = stepper.state();
        close(state.v[0], 30.0 - 2.0 * (state.t + state.t.sin()), 1e-9);
    }
    // A motion that begins there has seen no larger limit.
    let late = State { t: 3.135, q: [0.0], v: [1.0] };
    let mut motion = breathing.simulate(late).with_step_limit(0.002);
    let lost = 2.0 * (end - 3.135 + end.sin() - 3.135_f64.sin());
    close_on(1.0, motion.advance_to(end).unwrap().v[0], 1.0 - lost, 1e-9);
}
