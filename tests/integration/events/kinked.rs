//! Events of functions with kinks and jumps, which may be constant wherever a step is sampled.

use lagrangian::Dop853;
use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

/// An oscillator, x = x₀ cos t + v₀ sin t.
struct Oscillator {
    part: f64,
    rate: f64,
    shift: f64,
}

#[lagrangian(coordinates = [x])]
impl Oscillator {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        0.5 * q.x * q.x
    }

    fn signal(&self, q: &Coordinates, t: f64) -> f64 {
        q.x + self.part * (self.rate * t).sin() + self.shift
    }

    #[event]
    fn floored(&self, q: &Coordinates, t: f64) -> f64 {
        self.signal(q, t).max(0.0) - 0.02
    }

    #[event]
    fn capped(&self, q: &Coordinates, t: f64) -> f64 {
        self.signal(q, t).min(0.05)
    }

    #[event]
    fn folded_twice(&self, q: &Coordinates, t: f64) -> f64 {
        ((self.signal(q, t).abs() - 0.5).abs() - 0.1).min(0.02)
    }

    #[event]
    fn flag(&self, q: &Coordinates, t: f64) -> f64 {
        if self.signal(q, t) > 0.3 { 1.0 } else { -0.5 }
    }

    #[event]
    fn banded(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        self.signal(q, t).clamp(-0.1, 0.1) + if v.x > 0.2 { 0.05 } else { -0.05 }
    }
}

#[test]
fn events_with_kinks_are_all_met() {
    let mut samples = Samples::new(3);
    let end = 8.0;
    let mut counts = [0; 5];
    for _ in 0..40 {
        let model =
            Oscillator { part: samples.unit(), rate: samples.number(1.0, 30.0), shift: samples.unit() };
        let [x, v] = [samples.unit(), samples.unit()];
        let at = |t: f64| State { t, q: [x * t.cos() + v * t.sin()], v: [v * t.cos() - x * t.sin()] };
        for (event, count) in [
            OscillatorEvent::Floored,
            OscillatorEvent::Capped,
            OscillatorEvent::FoldedTwice,
            OscillatorEvent::Flag,
            OscillatorEvent::Banded,
        ]
        .into_iter()
        .zip(&mut counts)
        {
            // Changes of sign between places that are 1e-3 apart, by bisection.
            let is_above = |t: f64| lagrangian::Guard::value(&event, &model, &at(t)) > 0.0;
            let mut expected = Vec::new();
            for place in 0..8000 {
                let [mut low, mut high] = [place, place + 1].map(|place| end * f64::from(place) / 8000.0);
                let before = is_above(low);
                if is_above(high) != before {
                    for _ in 0..40 {
                        let middle = 0.5 * (low + high);
                        *(if is_above(middle) == before { &mut low } else { &mut high }) = middle;
                    }
                    expected.push((high, if before { Crossing::Falling } else { Crossing::Rising }));
                }
            }
            *count += expected.len();
            let start = at(0.0);
            let by_series: Vec<_> = model.simulate(start).events(event, end).map(Result::unwrap).collect();
            let others =
                model.simulate_with::<Dop853>(start).events(event, end).map(Result::unwrap).collect();
            for found in [by_series, others] {
                // Two changes of sign nearer than 1e-3 are missed by the places.
                let mut found = found.iter().filter(|event| event.crossing != Crossing::Touching);
                for &(t, crossing) in &expected {
                    let event = found
                        .find(|event| event.state.t > t - 1e-7)
                        .unwrap_or_else(|| panic!("{event:?} at {t}"));
                    assert_eq!(event.crossing, crossing, "at {t}");
                    close_on(1.0, event.state.t, t, 1e-8);
                }
            }
        }
    }
    assert!(counts.iter().all(|&count| count > 100), "{counts:?}");
}
