//! Events of functions that are narrow beside a step.

use lagrangian::Dop853;
use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

/// A mass that flies through a narrow beam of light, and a lamp that flashes.
struct Beam {
    width: f64,
    flash: f64,
}

#[lagrangian(coordinates = [x])]
impl Beam {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[event]
    fn lit(&self, q: &Coordinates) -> f64 {
        (-(q.x / self.width).powi(2)).exp() - 0.5
    }

    #[event]
    fn seen(&self, t: f64) -> f64 {
        ((t - self.flash) / self.width).cosh().powi(-2) - 0.5
    }

    #[event]
    fn passed(&self, q: &Coordinates) -> f64 {
        q.x - 1.0
    }
}

#[test]
fn narrow_events_are_met_from_afar() {
    let mut samples = Samples::new(1);
    for _ in 0..60 {
        let width = 10_f64.powf(samples.number(-5.0, -0.5));
        let speed = samples.number(0.5, 2.0);
        let (distance, flash) = (samples.number(3.0, 10.0), samples.number(3.0, 30.0));
        let beam = Beam { width, flash };
        let start = State::new([-distance], [speed]);
        let (at, half) = (distance / speed, width * 2.0_f64.ln().sqrt() / speed);
        let lit = [(at - half, Crossing::Rising), (at + half, Crossing::Falling)];
        let half = width * 2.0_f64.sqrt().acosh();
        let seen = [(flash - half, Crossing::Rising), (flash + half, Crossing::Falling)];
        for (event, expected) in [(BeamEvent::Lit, lit), (BeamEvent::Seen, seen)] {
            let found: Vec<_> = beam.simulate(start).events(event, 40.0).map(Result::unwrap).collect();
            let others =
                beam.simulate_with::<Dop853>(start).events(event, 40.0).map(Result::unwrap).collect();
            for found in [found, others] {
                assert_eq!(found.len(), 2, "{event:?} {width} {start:?}: {found:?}");
                for (event, (t, crossing)) in found.iter().zip(expected) {
                    assert_eq!(event.crossing, crossing);
                    close_on(t, event.state.t, t, 1e-13);
                }
            }
        }
        let passed: Vec<_> = beam.simulate(start).events(BeamEvent::Passed, 40.0).collect();
        assert_eq!(passed.len(), 1);
    }
}
