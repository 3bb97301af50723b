//! Motions with known ends: accuracy, landing, sampling, inputs, and failures.

extern crate std;
use core::f64::consts::{PI, TAU};
use std::vec::Vec;

use super::*;
use crate::integrator::Rk4;
use crate::integrator::samples::{
    BlowUp, Driven, Kepler, Oscillator, Undefined, Vanishing, distance, driven, pericentre,
};

#[test]
fn one_kepler_period_closes() {
    let start = pericentre(0.6);
    let mut motion = Kepler.simulate(start).with_tolerance(1e-15);
    let end = *motion.advance_to(TAU).unwrap();
    assert!(distance(&end, &start) < 1e-12, "{:e}", distance(&end, &start));
    let mut coarse = Kepler.simulate(start).with_tolerance(1e-6);
    let error = distance(coarse.advance_to(TAU).unwrap(), &start);
    assert!((1e-9..1e-2).contains(&error), "a tolerance has an effect: {error:e}");
    assert!(coarse.steps().evaluations * 3 < motion.steps().evaluations);
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn energy_drifts_by_rounding_alone_over_a_thousand_periods() {
    let mut motion = Kepler.simulate(pericentre(0.1)).with_tolerance(1e-15);
    let before = motion.energy();
    motion.advance_to(1000.0 * TAU).unwrap();
    assert!((motion.energy() - before).abs() < 1e-12, "{:e}", motion.energy() - before);
}

#[test]
fn a_motion_lands_exactly_forward_and_backward() {
    let mut motion = Driven.simulate(driven(0.3)).with_tolerance(1e-13);
    for t in [0.3 + 1e-9, 1.0, 7.7, 7.7, 7.7 - 1e-6, -3.1, 0.3] {
        let state = *motion.advance_to(t).unwrap();
        assert_eq!(state.t, t);
        assert!(distance(&state, &driven(t)) < 3e-11, "t = {t}: {:e}", distance(&state, &driven(t)));
    }
    let steps = motion.steps();
    motion.advance_by(0.0).unwrap();
    assert_eq!(motion.steps(), steps, "no way to go costs nothing");
}

#[test]
fn samples_are_as_good_as_the_steps_and_do_not_shorten_them() {
    let mut motion = Driven.simulate(driven(0.0)).with_tolerance(1e-10);
    for (k, state) in motion.every(0.01).take(1001).enumerate() {
        let state = state.unwrap();
        assert_eq!(state.t, k as f64 * 0.01);
        assert!(distance(&state, &driven(state.t)) < 1e-8, "t = {}", state.t);
    }
    assert_eq!(motion.t(), 10.0);
    assert!(motion.steps().accepted < 120, "{:?}", motion.steps());
}

#[test]
fn samples_run_backward_too() {
    let mut motion = Driven.simulate(driven(5.0));
    let last = motion.every(-0.25).take(41).last().unwrap().unwrap();
    assert_eq!(last.t, -5.0);
    assert!(distance(&last, &driven(-5.0)) < 1e-8);
}

#[test]
fn advancing_after_a_sample_loses_nothing() {
    let mut motion = Driven.simulate(driven(0.0)).with_tolerance(1e-13);
    for (sample, target) in [(0.05, 9.0), (0.01, 9.02), (-0.03, 8.0), (0.02, 8.01)] {
        let t = motion.t() + sample;
        assert_eq!(motion.every(sample).nth(1).unwrap().unwrap().t, t);
        let state = motion.advance_to(target).unwrap();
        assert!(distance(state, &driven(target)) < 1e-11, "{:e}", distance(state, &driven(target)));
    }
}

#[test]
fn held_inputs_act_from_the_visible_state_on() {
    let mut motion = Oscillator.simulate(State::at_rest([1.0]));
    motion.advance_to(PI).unwrap();
    motion.set_inputs([-1.0]);
    let rest = motion.advance_by(3.0).unwrap();
    // The force balances the spring at q = −1, where the motion stood.
    assert!(distance(rest, &State::at_rest([-1.0])) < 1e-9);
    let mut forced = Oscillator.simulate(State::at_rest([0.0])).with_inputs([2.0]);
    assert!((forced.advance_to(PI).unwrap().q[0] - 4.0).abs() < 1e-9);
    assert_eq!(forced.inputs(), [2.0]);
}

#[test]
fn inputs_changed_between_samples_join_without_a_jump() {
    let mut motion = Oscillator.simulate(State::at_rest([1.0]));
    let sampled = motion.every(0.1).nth(3).unwrap().unwrap();
    motion.set_inputs([5.0]);
    assert_eq!(*motion.state(), sampled);
    let next = motion.advance_by(1e-6).unwrap();
    assert!(distance(next, &sampled) < 1e-5);
}

#[test]
fn feedback_acts_inside_the_steps() {
    // A spring of stiffness 3 on top of the one of stiffness 1: frequency 2.
    let mut motion = Oscillator.simulate(State::at_rest([1.0])).with_control(|state| [-3.0 * state.q[0]]);
    assert!((motion.advance_to(PI).unwrap().q[0] - 1.0).abs() < 1e-8);
    assert!((motion.advance_by(PI / 2.0).unwrap().q[0] + 1.0).abs() < 1e-8);
}

#[test]
fn a_step_limit_is_kept() {
    let mut motion = Oscillator.simulate(State::at_rest([1.0])).with_step_limit(0.01);
    motion.advance_to(1.0).unwrap();
    assert!(motion.steps().accepted >= 99);
}

#[test]
fn a_blow_up_is_an_error_at_its_time() {
    let mut motion = BlowUp.simulate(State::new([1.0], [1.0]));
    let error = motion.advance_to(2.0).unwrap_err();
    assert_eq!(error.cause, Cause::StepTooSmall);
    assert!((error.t - 1.0).abs() < 1e-9, "{error:?}");
    assert_eq!(motion.t(), error.t);
    assert!(motion.state().is_finite());
}

#[test]
fn the_cause_that_forced_short_steps_is_the_one_reported() {
    let start = State::new([1.0], [1.0]);
    let mut motion = Vanishing.simulate(start);
    let error = motion.advance_to(5.0).unwrap_err();
    assert_eq!(error.cause, Cause::SingularMassMatrix { pivot: 0, name: crate::system::name::Name::NONE });
    assert!((error.t - 1.0).abs() < 1e-12, "{error:?}");
    // The way back is open: the tiny steps before the failure are forgotten.
    assert!((motion.advance_to(0.5).unwrap().q[0] - 1.5).abs() < 1e-14);
    let error = Undefined.simulate(start).advance_to(5.0).unwrap_err();
    assert_eq!(error.cause, Cause::NotFinite);
    assert!((error.t - 1.0).abs() < 1e-12, "{error:?}");
}

#[test]
fn samples_reach_up_to_the_error_and_then_end() {
    let mut motion = Undefined.simulate(State::new([1.0], [1.0]));
    let samples: Vec<_> = motion.every(0.3).take(10).collect();
    assert_eq!(samples.len(), 5);
    assert!(samples[..4].iter().all(Result::is_ok));
    assert_eq!(samples[4].unwrap_err().cause, Cause::NotFinite);
    assert_eq!(motion.state(), &samples[3].unwrap());
}

#[test]
fn bad_arguments_are_refused_and_change_nothing() {
    let start = State::new([1.0], [0.0]);
    let cause = |motion: &mut Simulation<'_, _, _, _, 1, 1>, t| motion.advance_to(t).unwrap_err().cause;
    assert_eq!(cause(&mut Oscillator.simulate(start), f64::NAN), Cause::InvalidTime);
    assert_eq!(cause(&mut Oscillator.simulate(start).with_tolerance(-1.0), 1.0), Cause::InvalidTolerance);
    assert_eq!(cause(&mut Oscillator.simulate(start).with_step_limit(0.0), 1.0), Cause::InvalidStep);
    assert_eq!(cause(&mut Oscillator.simulate(start).with_max_steps(3), 100.0), Cause::TooManySteps);
    let mut motion = Oscillator.simulate(start);
    for dt in [0.0, f64::NAN] {
        let mut samples = motion.every(dt);
        assert_eq!(samples.next().unwrap().unwrap_err().cause, Cause::InvalidStep);
        assert_eq!(samples.next(), None);
    }
    assert_eq!(motion.state(), &start);
}

#[test]
fn a_bad_start_is_not_finite() {
    let mut motion = Oscillator.simulate(State::new([f64::NAN], [0.0]));
    assert_eq!(motion.advance_to(1.0).unwrap_err().cause, Cause::NotFinite);
    let mut motion = Undefined.simulate(State::new([3.0], [0.0]));
    assert_eq!(motion.advance_to(1.0).unwrap_err(), MotionError { cause: Cause::NotFinite, t: 0.0 });
    let mut motion = Vanishing.simulate(State::new([3.0], [0.0]));
    assert_eq!(
        motion.advance_to(1.0).unwrap_err().cause,
        Cause::SingularMassMatrix { pivot: 0, name: crate::system::name::Name::NONE }
    );
}

#[test]
fn too_many_steps_can_be_continued() {
    let mut motion = Driven.simulate(driven(0.0)).with_max_steps(5);
    let mut calls = 0;
    while motion.advance_to(20.0).is_err() {
        calls += 1;
        assert!(calls < 100);
    }
    assert!(calls > 5);
    assert!(distance(motion.state(), &driven(20.0)) < 1e-8);
}

#[test]
fn a_stepper_keeps_its_last_good_state() {
    let mut motion = Undefined.stepper::<Rk4>(State::new([1.0], [1.0]));
    for _ in 0..9 {
        motion.step(0.1, &[]).unwrap();
    }
    let good = *motion.state();
    assert_eq!(motion.step(0.2, &[]).unwrap_err(), MotionError { cause: Cause::NotFinite, t: good.t });
    assert_eq!(motion.step(f64::NAN, &[]).unwrap_err().cause, Cause::InvalidStep);
    assert_eq!(motion.state(), &good);
}

#[test]
#[cfg_attr(miri, ignore = "takes minutes there")]
fn a_stepper_counts_time_without_drift() {
    let mut motion = Oscillator.stepper::<Rk4>(State::at_rest([1.0]));
    for _ in 0..1_000_000 {
        motion.step(0.001, &[0.0]).unwrap();
    }
    assert!((motion.state().t - 1000.0).abs() < 2e-13);
}

#[test]
fn a_step_that_is_lost_in_the_time_is_an_error() {
    use crate::system::error::Magnitude;
    for (t, dt, spacing) in
        [(1e17, 1.0, 16.0), (-1e17, 3.0, 16.0), (1e17, -1.0, 16.0), (1.0, 1e-17, f64::EPSILON)]
    {
        let start = driven(0.0).at_time(t);
        let mut motion = Driven.simulate(start);
        let lost = |error: &MotionError<f64>| match error.cause {
            Cause::TimeTooCoarse { spacing: Magnitude(found) } => {
                error.t == t && (f64::from(found) / spacing - 1.0).abs() < 1e-6
            }
            _ => false,
        };
        let error = motion.advance_by(dt).unwrap_err();
        assert!(lost(&error), "{error:?}");
        let mut samples = motion.every(dt);
        assert_eq!(samples.next(), Some(Ok(start)));
        let error = samples.next().unwrap().unwrap_err();
        assert!(lost(&error) && samples.next().is_none(), "{error:?}");
        assert_eq!(*motion.state(), start);
        assert_eq!(motion.advance_by(0.0), Ok(&start));
    }
}
