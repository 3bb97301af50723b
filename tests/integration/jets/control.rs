//! The adaptive method: tolerance, direction, samples, inputs, limits.

use lagrangian::prelude::*;

use crate::support::close::{all_close, between, close};
use crate::support::motion::numbers;

/// An elastic pendulum with a motor.
struct Pendulum {
    k: f64,
}

#[lagrangian(coordinates = [theta, r], inputs = [motor, pull])]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta.sin(), -q.theta.cos()) * q.r
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).y + 0.5 * self.k * (q.r - 1.0).powi(2)
    }

    #[force(on = theta)]
    fn motor(&self, v: &Velocities, u: &Inputs) -> f64 {
        u.motor - 0.1 * v.theta
    }

    #[force(on = r)]
    fn pull(&self, u: &Inputs) -> f64 {
        u.pull
    }
}

const PENDULUM: Pendulum = Pendulum { k: 40.0 };

fn start() -> State<f64, 2> {
    State::new([1.0, 1.1], [0.5, 0.2])
}

fn distance(a: &State<f64, 2>, b: &State<f64, 2>) -> f64 {
    a.iter().zip(b.iter()).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// Another method at the finest tolerance.
fn reference(times: impl IntoIterator<Item = f64>) -> Vec<State<f64, 2>> {
    let mut motion = PENDULUM.simulate_with::<Dop853>(start()).with_tolerance(1e-15).with_inputs([0.3, -0.2]);
    times.into_iter().map(|t| *motion.advance_to(t).unwrap()).collect()
}

#[test]
fn the_error_obeys_the_tolerance_over_its_whole_range() {
    let exact = reference([5.0])[0];
    for exponent in 3..=16 {
        let tolerance = 10.0_f64.powi(-exponent);
        let mut motion = PENDULUM.simulate(start()).with_tolerance(tolerance).with_inputs([0.3, -0.2]);
        let error = distance(motion.advance_to(5.0).unwrap(), &exact);
        assert!(error < 30.0 * tolerance + 1e-13, "{tolerance:e}: {error:e}");
        assert!(error > 1e-3 * tolerance || tolerance < 1e-11, "{tolerance:e}: {error:e}");
        between(20.0, motion.steps().evaluations as f64, 200.0);
    }
    let mut finest = PENDULUM.simulate(start()).with_tolerance(0.0).with_inputs([0.3, -0.2]);
    assert!(distance(finest.advance_to(5.0).unwrap(), &exact) < 1e-13);
    let mut absolute = PENDULUM.simulate(start()).with_tolerances(0.0, 1e-6).with_inputs([0.3, -0.2]);
    assert!(distance(absolute.advance_to(5.0).unwrap(), &exact) < 1e-4);
}

#[test]
fn the_way_back_ends_at_the_start() {
    let mut motion = PENDULUM.simulate(start()).with_tolerance(1e-15);
    for t in [3.0, -2.0, 4.0, 0.0] {
        motion.advance_to(t).unwrap();
    }
    all_close(numbers(motion.state()), numbers(&start()), 1e-12);
    assert_eq!(motion.t(), 0.0);
    // A turn inside a step, and turns much shorter than one.
    for t in [0.11, 0.1, 0.12, -0.01, 1e-9, -1e-9, 0.0] {
        motion.advance_to(t).unwrap();
    }
    all_close(numbers(motion.state()), numbers(&start()), 1e-12);
}

#[test]
fn samples_are_the_states_at_their_times() {
    for dt in [0.003, 0.37, 2.1, -0.003, -0.37] {
        let count = if f64::abs(dt) < 0.1 { 200 } else { 8 };
        let times: Vec<f64> = (0..count).map(|k| f64::from(k) * dt).collect();
        let exact = reference(times.iter().copied());
        let mut sampled = PENDULUM.simulate(start()).with_tolerance(1e-14).with_inputs([0.3, -0.2]);
        let mut advanced = PENDULUM.simulate(start()).with_tolerance(1e-14).with_inputs([0.3, -0.2]);
        let samples: Vec<_> = sampled.every(dt).take(times.len()).map(Result::unwrap).collect();
        for ((sample, exact), t) in samples.iter().zip(&exact).zip(&times) {
            let state = advanced.advance_to(*t).unwrap();
            assert_eq!((sample.t, state), (*t, sample));
            assert!(distance(sample, exact) < 1e-12, "{t}: {:e}", distance(sample, exact));
        }
        // Dense output is free.
        assert_eq!(sampled.steps(), advanced.steps());
        assert!(sampled.steps().evaluations < 200);
    }
}

#[test]
fn inputs_change_from_the_state_that_the_caller_sees() {
    let plan = [(0.35, [0.0, 0.0]), (0.5, [4.0, -1.0]), (1.7, [-4.0, 0.0]), (2.0, [0.0, 3.0])];
    let mut jets = PENDULUM.simulate(start()).with_tolerance(1e-15);
    let mut other = PENDULUM.simulate_with::<Dop853>(start()).with_tolerance(1e-15);
    for (t, inputs) in plan {
        jets.set_inputs(inputs);
        other.set_inputs(inputs);
        jets.advance_to(t).unwrap();
        other.advance_to(t).unwrap();
        all_close(numbers(jets.state()), numbers(other.state()), 1e-12);
    }
    // Between samples, too.
    let mut jets = PENDULUM.simulate(start()).with_tolerance(1e-15);
    let mut other = PENDULUM.simulate_with::<Dop853>(start()).with_tolerance(1e-15);
    for (k, (_, inputs)) in plan.into_iter().enumerate() {
        let sample = jets.every(0.01).nth(3).unwrap().unwrap();
        other.advance_to(0.03 * (k + 1) as f64).unwrap();
        all_close(numbers(&sample), numbers(other.state()), 1e-12);
        jets.set_inputs(inputs);
        other.set_inputs(inputs);
    }
}

#[test]
fn a_step_limit_holds_and_costs_one_expansion_a_step() {
    let exact = reference([1.0])[0];
    let with_inputs = || PENDULUM.simulate(start()).with_inputs([0.3, -0.2]);
    for (limit, steps) in [(0.01, 101), (1e-3, 1001), (1e-4, 10_001)] {
        let mut motion = with_inputs().with_step_limit(limit);
        assert!(distance(motion.advance_to(1.0).unwrap(), &exact) < 1e-11);
        let counts = motion.steps();
        assert!(counts.accepted.abs_diff(steps) <= 1, "{counts:?}");
        assert!(counts.rejected <= 3, "{counts:?}");
    }
    let mut motion = with_inputs().with_step_limit(1e9);
    motion.advance_to(1.0).unwrap();
    let mut unlimited = with_inputs();
    assert_eq!(motion.state(), unlimited.advance_to(1.0).unwrap());
}

#[test]
fn a_late_start_loses_nothing_but_the_resolution_of_time() {
    let mut early = PENDULUM.simulate(start()).with_tolerance(1e-15);
    let early = early.advance_to(2.0).unwrap();
    for late in [1e3, 1e6, -1e9] {
        let mut motion = PENDULUM.simulate(start().at_time(late)).with_tolerance(1e-15);
        let state = motion.advance_to(late + 2.0).unwrap();
        assert!(distance(&state.at_time(2.0), early) < 1e-12 + 1e-14 * f64::abs(late));
    }
}

#[test]
fn a_tolerance_may_change_between_calls() {
    let exact = reference([2.0])[0];
    let mut motion = PENDULUM.simulate(start()).with_tolerance(1e-14).with_inputs([0.3, -0.2]);
    motion.advance_to(0.5).unwrap();
    let mut motion = motion.with_tolerance(1e-6);
    motion.advance_to(0.6).unwrap();
    let mut motion = motion.with_tolerance(1e-14);
    let state = motion.every(0.7).nth(2).unwrap().unwrap();
    close(state.t, 2.0, 1e-15);
    between(1e-13, distance(&state, &exact), 1e-4);
}

#[test]
fn a_stiff_spring_takes_short_steps_and_no_wrong_ones() {
    let stiff = Pendulum { k: 1e6 };
    let start = State::new([1.0, 1.0], [0.0, 0.0]);
    let mut motion = stiff.simulate(start).with_tolerance(1e-12);
    let energy = motion.energy();
    let mut other = stiff.simulate_with::<Dop853>(start).with_tolerance(1e-13);
    motion.advance_to(0.5).unwrap();
    all_close(motion.state().q, other.advance_to(0.5).unwrap().q, 1e-10);
    // The friction takes a little; the spring does not creep.
    between(-0.5, motion.energy() - energy, 0.0);
    assert!(motion.steps().rejected < 5, "{:?}", motion.steps());
}
