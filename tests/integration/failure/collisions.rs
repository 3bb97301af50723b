//! Bodies that fall into each other: accelerations without bound at a known time.

use lagrangian::prelude::*;

use crate::support::close::{between, close};

struct Kepler;

#[lagrangian(coordinates = [x, y])]
impl Kepler {
    #[point(mass = 1.0)]
    fn planet(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn sun(&self, q: &Coordinates) -> f64 {
        -1.0 / self.planet(q).norm()
    }
}

/// Falling from rest at distance 1 takes a quarter of √2 half turns.
const FALL: f64 = std::f64::consts::PI / (2.0 * std::f64::consts::SQRT_2);

fn dropped() -> State<f64, 2> {
    State::at_rest([1.0, 0.0])
}

#[test]
fn a_head_on_collision_is_an_error_at_its_time() {
    let mut motion = Kepler.simulate(dropped());
    let error = motion.advance_to(2.0).unwrap_err();
    assert!(matches!(error.cause, Cause::StepTooSmall | Cause::NotFinite), "{error}");
    close(error.t, FALL, 1e-7);
}

#[test]
fn the_last_good_state_is_kept() {
    let mut motion = Kepler.simulate(dropped());
    let error = motion.advance_to(2.0).unwrap_err();
    let state = *motion.state();
    assert!(state.is_finite());
    assert_eq!((state.t, motion.t()), (error.t, error.t));
    // It is a good one: nearly at the sun, at the speed that energy prescribes.
    between(0.0, state.q[0], 1e-3);
    close(state.v[0].powi(2) / 2.0 * state.q[0], 1.0, 1e-2);
}

#[test]
fn samples_end_with_the_error() {
    let mut motion = Kepler.simulate(dropped());
    let samples: Vec<_> = motion.every(0.25).take(100).collect();
    assert_eq!(samples.len(), 6);
    assert!(samples[..5].iter().all(Result::is_ok));
    close(samples[5].unwrap_err().t, FALL, 1e-6);
    assert_eq!(motion.t(), 1.0);
}

#[test]
fn a_start_in_the_sun_is_not_finite() {
    let error = Kepler.simulate(State::at_rest([0.0, 0.0])).advance_to(1.0).unwrap_err();
    assert_eq!(error, MotionError { cause: Cause::NotFinite, t: 0.0 });
}

#[test]
fn errors_travel_as_standard_errors() {
    fn run() -> Result<f64, Box<dyn std::error::Error>> {
        let mut motion = Kepler.simulate(dropped());
        Ok(motion.advance_to(2.0)?.q[0])
    }
    let error = run().unwrap_err();
    let text = error.to_string();
    assert!(text.starts_with("at t = 1.1107"), "{text}");
    assert!(error.source().is_some());
}
