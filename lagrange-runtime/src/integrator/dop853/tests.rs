//! Measured orders of the step and of the dense output, and what samples cost.

use super::*;
use crate::integrator::samples::{Driven, distance, driven};
use crate::system::System;

/// [`Driven`] in the form that the integrator takes.
struct Plain;

impl Field<f64, 1> for Plain {
    fn accelerations(&self, t: f64, q: &[f64; 1], v: &[f64; 1]) -> [f64; 1] {
        Driven.accelerations_at(&(), t, q, v, &[])
    }

    fn cause(&self, _: f64, _: &[f64; 1], _: &[f64; 1]) -> Cause {
        Cause::NotFinite
    }
}

/// A tolerance that no error exceeds.
fn loose() -> Limits<f64> {
    Limits { absolute: Some(1e30), ..Limits::new() }
}

fn step(motion: &mut Dop853Memory<f64, 1>, h: f64) {
    motion.start = motion.end;
    motion.slopes[0] = motion.slope.unwrap_or_else(|| motion.slope_at_end(&Plain).unwrap());
    motion.dense = None;
    assert!(motion.attempt(&Plain, &loose(), h, &mut none()).unwrap() < 1.0);
}

fn error(steps: u32) -> f64 {
    let mut motion = Dop853Memory::new(driven(0.3));
    for _ in 0..steps {
        step(&mut motion, 4.0 / f64::from(steps));
    }
    distance(&motion.end.state, &driven(4.3))
}

/// No attempts so far.
fn none<const N: usize>() -> Attempts<f64, N> {
    Attempts::new(0.0, f64::EPSILON)
}

#[test]
fn dop853_is_of_eighth_order() {
    let order = (error(8) / error(16)).log2();
    assert!((7.5..8.7).contains(&order), "measured order {order}");
}

#[test]
fn the_dense_output_is_of_seventh_order() {
    // Order 7 of the polynomial is an error of h⁸ inside one step.
    let error = |h: f64| {
        let mut motion = Dop853Memory::new(driven(1.1));
        step(&mut motion, h);
        let t = 1.1 + 0.37 * h;
        distance(&motion.sample(&Plain, 0.37).unwrap(), &driven(t))
    };
    let order = (error(0.4) / error(0.2)).log2();
    assert!((7.3..8.7).contains(&order), "measured order {order}");
}

#[test]
fn samples_at_the_ends_are_the_ends_and_cost_nothing() {
    let mut motion = Dop853Memory::new(driven(0.3));
    step(&mut motion, 0.4);
    let before = motion.counts;
    for (part, end) in [(0.0, motion.start.state), (1.0, motion.end.state)] {
        assert_eq!(motion.sample(&Plain, part), Ok(end));
    }
    assert_eq!(motion.counts, before);
    motion.sample(&Plain, 0.5).unwrap();
    motion.sample(&Plain, 0.6).unwrap();
    assert_eq!(motion.counts.evaluations, before.evaluations + 3);
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn compensation_keeps_what_rounding_takes() {
    let (mut sum, mut residue, mut plain) = (1.0, 0.0, 1.0);
    for _ in 0..1_000_000 {
        (sum, residue) = add(sum, residue, 1e-17);
        plain += 1e-17;
    }
    assert_eq!(plain, 1.0);
    assert!((sum - (1.0 + 1e-11)).abs() < 3e-16);
}

/// [`Driven`] up to a place, beyond which nothing has a value; notes the furthest place asked for.
struct Edge {
    at: f64,
    furthest: core::cell::Cell<f64>,
}

impl Field<f64, 1> for Edge {
    fn accelerations(&self, t: f64, q: &[f64; 1], v: &[f64; 1]) -> [f64; 1] {
        self.furthest.set(self.furthest.get().max(q[0]));
        if q[0] > self.at { [f64::NAN] } else { Plain.accelerations(t, q, v) }
    }

    fn cause(&self, t: f64, q: &[f64; 1], v: &[f64; 1]) -> Cause {
        if self.accelerations(t, q, v)[0].is_nan() { Cause::NotFinite } else { Cause::StepTooSmall }
    }
}

#[test]
fn a_step_does_not_end_where_accelerations_have_no_value() {
    // A step whose end lies beyond all its stages, so that these have values.
    let attempt = |at: f64, h: f64| {
        let edge = Edge { at, furthest: core::cell::Cell::new(0.0) };
        let mut motion = Dop853Memory::new(driven(0.3));
        (motion.start, motion.slopes[0]) = (motion.end, motion.slope_at_end(&edge).unwrap());
        let result = motion.attempt(&edge, &loose(), h, &mut none());
        (result, motion.end.state, edge.furthest.get())
    };
    let (mut found, begin) = (0, driven(0.3));
    for k in 1..20 {
        let h = 0.05 * f64::from(k);
        let (_, end, furthest) = attempt(f64::INFINITY, h);
        let stages = attempt(end.q[0] * (1.0 - f64::EPSILON), h);
        if furthest == end.q[0] && stages.0.is_err() {
            assert_eq!((stages.0, stages.1), (Err(Cause::NotFinite), begin));
            found += 1;
        }
    }
    assert!(found > 0);
}

/// The same motion twice.
struct Both;

impl Field<f64, 2> for Both {
    fn accelerations(&self, t: f64, q: &[f64; 2], v: &[f64; 2]) -> [f64; 2] {
        core::array::from_fn(|i| Plain.accelerations(t, &[q[i]], &[v[i]])[0])
    }

    fn cause(&self, _: f64, _: &[f64; 2], _: &[f64; 2]) -> Cause {
        Cause::NotFinite
    }
}

#[test]
fn the_error_of_motions_side_by_side_is_that_of_one() {
    let one = driven(0.3);
    let mut single = Dop853Memory::new(one);
    single.slopes[0] = single.slope_at_end(&Plain).unwrap();
    let mut both = Dop853Memory::new(State { t: one.t, q: [one.q[0]; 2], v: [one.v[0]; 2] });
    both.slopes[0] = both.slope_at_end(&Both).unwrap();
    let limits = Limits::new();
    let errors =
        [single.attempt(&Plain, &limits, 0.5, &mut none()), both.attempt(&Both, &limits, 0.5, &mut none())];
    let [Ok(single), Ok(both)] = errors else { panic!("{errors:?}") };
    assert!(single > 0.0 && (both / single - 1.0).abs() < 1e-14, "{single} {both}");
}

/// A constant acceleration up to a time, from which on nothing has a value; notes where a cause is asked for.
struct Until {
    time: f64,
    asked: core::cell::Cell<Option<State<f64, 1>>>,
}

impl Field<f64, 1> for Until {
    fn accelerations(&self, t: f64, _: &[f64; 1], _: &[f64; 1]) -> [f64; 1] {
        [if t < self.time { -3.0 } else { f64::NAN }]
    }

    fn cause(&self, t: f64, q: &[f64; 1], v: &[f64; 1]) -> Cause {
        self.asked.set(Some(State { t, q: *q, v: *v }));
        Cause::NotFinite
    }
}

#[test]
fn the_cause_of_a_failure_is_asked_for_at_the_stage_that_failed() {
    let until = Until { time: 2.4, asked: core::cell::Cell::new(None) };
    let start = State::new([1.0], [2.0]).at_time(2.0);
    let mut motion = Dop853Memory::new(start);
    (motion.start, motion.slopes[0]) = (motion.end, motion.slope_at_end(&until).unwrap());
    let _ = motion.attempt(&until, &loose(), 0.5, &mut none());
    assert_eq!(motion.failed_stage(&until, 0.5), Cause::NotFinite);
    let State { t, q, v } = until.asked.get().unwrap();
    let way = t - start.t;
    assert!(t >= 2.4 && (v[0] - (2.0 - 3.0 * way)).abs() < 1e-13, "{t} {v:?}");
    assert!((q[0] - (1.0 + 2.0 * way - 1.5 * way * way)).abs() < 1e-13, "{t} {q:?}");
}

#[test]
fn the_first_probe_takes_a_part_of_a_time_of_the_state() {
    let probe = |q, v, a| first::probe(&State::new([q], [v]), &Slope { q: [v], v: [a] });
    // √(‖q‖/‖a‖), else ‖v‖/‖a‖, else ‖q‖/‖v‖.
    for (q, v, a, time) in [(8.0, 3.0, 2.0, 2.0), (0.0, 3.0, 12.0, 0.25), (6.0, 3.0, 0.0, 2.0)] {
        let found: f64 = probe(q, v, a);
        assert!((found - 0.01 * time).abs() < 1e-16, "{q} {v} {a}: {found}");
    }
    assert_eq!(probe(1.0, 0.0, 0.0), 1e-6);
}
