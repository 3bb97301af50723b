//! Events of functions with kinks and jumps, which may be constant wherever a step is sampled, and of functions
//! that are flat where they cross zero.

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
    fn plain(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        self.signal(q, t) - 0.6 * v.x
    }

    #[event]
    fn cubed(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        self.plain(q, v, t).powi(3)
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
    let end = 5.0;
    let mut counts = [0; 5];
    for _ in 0..12 {
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
            // Changes of sign between places that are 2e-3 apart, by bisection.
            let is_above = |t: f64| lagrangian::Guard::value(&event, &model, &at(t)) > 0.0;
            let mut expected = Vec::new();
            for place in 0..2500 {
                let [mut low, mut high] = [place, place + 1].map(|place| end * f64::from(place) / 2500.0);
                let before = is_above(low);
                if is_above(high) != before {
                    for _ in 0..12 {
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
                // Two changes of sign nearer than 2e-3 are missed by the places.
                let mut found = found.iter().filter(|event| event.crossing != Crossing::Touching);
                for &(t, crossing) in &expected {
                    let event = found
                        .find(|event| event.state.t > t - 1e-5)
                        .unwrap_or_else(|| panic!("{event:?} at {t}"));
                    assert_eq!(event.crossing, crossing, "at {t}");
                    close_on(1.0, event.state.t, t, 1e-6);
                }
            }
        }
    }
    assert!(counts.iter().all(|&count| count > 30), "{counts:?}");
}

#[test]
fn a_function_that_crosses_zero_flatly_does_so_once() {
    let mut samples = Samples::new(4);
    for _ in 0..60 {
        let model =
            Oscillator { part: samples.unit(), rate: samples.number(1.0, 40.0), shift: samples.unit() };
        let start = State::new([samples.unit()], [samples.unit()]);
        let of = |event| {
            let mut motion = model.simulate(start).with_tolerance(1e-12);
            motion.events(event, 5.0).take(100).map(Result::unwrap).collect::<Vec<_>>()
        };
        let (plain, cubed) = (of(OscillatorEvent::Plain), of(OscillatorEvent::Cubed));
        assert_eq!(plain.len(), cubed.len(), "{start:?}");
        for (plain, cubed) in plain.iter().zip(&cubed) {
            assert_eq!(plain.crossing, cubed.crossing);
            // The cube is zero up to rounding errors within a millionth.
            close_on(1.0, cubed.state.t, plain.state.t, 1e-5);
        }
    }
}
