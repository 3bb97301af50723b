//! Events with known times: every kind of zero, every kind of search, every way to fail.

extern crate std;

use core::f64::consts::{FRAC_PI_2, PI, TAU};
use std::vec::Vec;

use super::*;
use crate::integrator::samples::{Driven, Kepler, Oscillator, Undefined, distance, driven, pericentre};
use crate::system::error::Cause;

/// A point in free fall, in any scalar.
struct Ball<R>(R);

static FALLING: Ball<f64> = Ball(9.81);
static FREE: Ball<f64> = Ball(0.0);

impl<R: Ordered> System<1> for Ball<R> {
    type Scalar = R;
    type Method = crate::integrator::Dop853;
    type Constants = ();

    fn constants(&self) {}

    fn accelerations_at(&self, (): &(), _: R, _: &[R; 1], _: &[R; 1], _: &[R; 0]) -> [R; 1] {
        [-self.0]
    }

    fn energy_at(&self, (): &(), _: R, q: &[R; 1], v: &[R; 1]) -> R {
        R::from_f64(0.5) * v[0] * v[0] + self.0 * q[0]
    }
}

fn position(state: &State<f64, 1>) -> f64 {
    state.q[0]
}

fn velocity(state: &State<f64, 1>) -> f64 {
    state.v[0]
}

fn radial(state: &State<f64, 2>) -> f64 {
    state.q[0] * state.v[0] + state.q[1] * state.v[1]
}

/// Times and kinds of all events, in the order in which they come.
fn all<const N: usize, const E: usize, S, C, M, G, const K: usize>(
    events: Events<'_, Simulation<'_, S, C, M, N, K>, G, f64, N, E>,
) -> Vec<(f64, Crossing)>
where
    S: System<N, K, Scalar = f64>,
    C: Control<f64, N, K>,
    M: Adaptive<S, C, N, K>,
    G: Guard<S, f64, N>,
{
    events.map(|event| event.map(|event| (event.state.t, event.crossing)).unwrap()).collect()
}

fn assert_times(found: &[(f64, Crossing)], expected: &[(f64, Crossing)], bound: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found.0 - expected.0).abs() < bound, "{found:?} is not {expected:?}");
        assert_eq!(found.1, expected.1, "{found:?}");
    }
}

use Crossing::{Falling, Rising, Touching};

#[test]
fn an_oscillator_passes_zero_twice_a_period() {
    let mut motion = Oscillator.simulate(State::at_rest([1.0])).with_tolerance(1e-14);
    let found = all(motion.events(position, 100.0));
    let expected: Vec<_> =
        (0..32).map(|k| (FRAC_PI_2 + PI * f64::from(k), if k % 2 == 0 { Falling } else { Rising })).collect();
    assert_times(&found, &expected, 1e-11);
    assert_eq!(motion.t(), 100.0);
    assert!((motion.state().q[0] - 100.0_f64.cos()).abs() < 1e-11);
}

#[test]
fn events_are_as_good_as_the_dense_output() {
    for tolerance in [1e-6, 1e-10] {
        let mut motion = Oscillator.simulate(State::at_rest([1.0])).with_tolerance(tolerance);
        let event = motion.advance_to_event(position, 10.0).unwrap().unwrap();
        assert!((event.state.t - FRAC_PI_2).abs() < 10.0 * tolerance, "{}", event.state.t - FRAC_PI_2);
        assert!(position(&event.state).abs() < 1e-15, "zero to rounding: {event:?}");
        assert_eq!(event.state, *motion.state());
    }
}

#[test]
fn repeated_calls_find_what_an_iterator_finds() {
    let start = pericentre(0.6);
    let mut motion = Kepler.simulate(start).with_tolerance(1e-14);
    let found = all(motion.events(radial, 50.0));
    let mut motion = Kepler.simulate(start).with_tolerance(1e-14);
    let mut again = Vec::new();
    while let Some(event) = motion.advance_to_event(radial, 50.0).unwrap() {
        again.push((event.state.t, event.crossing));
    }
    assert_times(&found, &again, 1e-12);
    let expected: Vec<_> =
        (1..16).map(|k| (PI * f64::from(k), if k % 2 == 1 { Falling } else { Rising })).collect();
    assert_times(&found, &expected, 1e-11);
    assert_eq!(motion.t(), 50.0);
    assert_eq!(motion.advance_to_event(radial, 50.0).unwrap(), None);
}

#[test]
fn samples_and_steps_between_do_not_repeat_an_event() {
    let mut motion = Kepler.simulate(pericentre(0.6)).with_tolerance(1e-13);
    let mut count = 0;
    while let Some(event) = motion.advance_to_event(radial, 40.0).unwrap() {
        count += 1;
        assert!((event.state.t - PI * f64::from(count)).abs() < 1e-10);
        assert_eq!(motion.every(0.125).next().unwrap().unwrap().t, event.state.t);
        match count % 3 {
            0 => assert!(motion.every(0.125).nth(3).unwrap().is_ok()),
            1 => assert!(motion.advance_by(1e-3).is_ok()),
            _ => {}
        }
    }
    assert_eq!(count, 12);
}

#[test]
fn short_searches_miss_nothing_wherever_they_end() {
    for parts in [1, 2, 3, 7, 64] {
        let mut motion = Oscillator.simulate(State::at_rest([1.0])).with_tolerance(1e-14);
        let mut found = Vec::new();
        for k in 1..=20 * parts {
            let until = FRAC_PI_2 * f64::from(k) / f64::from(parts);
            while let Some(event) = motion.advance_to_event(position, until).unwrap() {
                found.push((event.state.t, event.crossing));
            }
            assert_eq!(motion.t(), until);
        }
        let odd = found.iter().filter(|event| event.1 == Touching).count();
        let times: Vec<_> = found.iter().map(|event| event.0).collect();
        assert!(times.len() == 10 && odd == 0, "{parts} parts: {found:?}");
        for (k, t) in times.iter().enumerate() {
            assert!((t - FRAC_PI_2 - PI * k as f64).abs() < 1e-12, "{found:?}");
        }
    }
}

#[test]
fn backward_the_same_events_come_in_reverse() {
    let mut motion = Kepler.simulate(pericentre(0.3)).with_tolerance(1e-14);
    let mut forward = all(motion.events(radial, 20.0));
    let back = all(motion.events(radial, 0.5));
    forward.reverse();
    assert_times(&back, &forward, 1e-11);
    assert!(all(motion.events(radial, -20.0)).len() == 7);
    // There and back within a step.
    let mut motion = Oscillator.simulate(State::at_rest([1.0])).with_tolerance(1e-12);
    for _ in 0..3 {
        assert_times(&all(motion.events(position, 1.6)), &[(FRAC_PI_2, Falling)], 1e-10);
        assert_times(&all(motion.events(position, 1.5)), &[(FRAC_PI_2, Falling)], 1e-10);
    }
}

#[test]
fn what_grazes_is_one_event_and_what_misses_none() {
    for (offset, kinds) in [(0.0, &[Touching][..]), (1e-9, &[]), (-1e-9, &[Rising, Falling])] {
        // The motion is q = t without error.
        let guard = |state: &State<f64, 1>| state.q[0].sin() - (1.0 + offset);
        let mut motion = FREE.simulate(State::new([0.0], [1.0]));
        let found = all(motion.events(guard, 60.0));
        assert_eq!(found.len(), 10 * kinds.len(), "{offset:e}: {found:?}");
        for (k, turn) in found.chunks(kinds.len().max(1)).enumerate() {
            let top = FRAC_PI_2 + TAU * k as f64;
            let half = (2.0 * (-offset).max(0.0_f64)).sqrt();
            for (event, (kind, t)) in turn.iter().zip(kinds.iter().zip([top - half, top + half])) {
                assert_eq!(event.1, *kind, "{offset:e}: {found:?}");
                let bound = if half > 0.0 { 1e-8 } else { 3e-7 };
                assert!((event.0 - t).abs() < bound, "{offset:e}: {}", event.0 - t);
            }
        }
        let mut motion = FREE.simulate(State::new([0.0], [1.0]));
        let mut again = 0;
        while motion.advance_to_event(guard, 60.0).unwrap().is_some() {
            again += 1;
        }
        assert_eq!(again, found.len(), "repeated calls, {offset:e}");
    }
}

#[test]
fn directions_filter() {
    let mut motion = Oscillator.simulate(State::at_rest([1.0])).with_tolerance(1e-13);
    assert_eq!(all(motion.events(position, 20.0).rising()).len(), 3);
    let mut motion = Oscillator.simulate(State::at_rest([1.0])).with_tolerance(1e-13);
    assert_eq!(all(motion.events(position, 20.0).falling()).len(), 3);
    let mut motion = Oscillator.simulate(State::at_rest([1.0])).with_tolerance(1e-13);
    assert_eq!(all(motion.events(position, 20.0).touching()), []);
    let first = motion.events(position, 0.0).rising().next().unwrap().unwrap();
    assert!((first.state.t - 5.5 * PI).abs() < 1e-10);
}

#[test]
fn several_guards_in_the_order_of_time() {
    let mut motion = Oscillator.simulate(State::at_rest([1.0])).with_tolerance(1e-14);
    let guards: [fn(&State<f64, 1>) -> f64; 3] = [velocity, position, |state| state.q[0] * state.v[0]];
    let events: Vec<_> = motion.events_of(guards, 10.0).map(Result::unwrap).collect();
    let found: Vec<_> = events.iter().map(|event| event.index).collect();
    // The product is zero wherever one of the others is, at the same time but for rounding errors.
    assert_eq!(found.len(), 12);
    for (k, pair) in events.chunks(2).enumerate() {
        let quarter = FRAC_PI_2 * (k + 1) as f64;
        assert!(pair.iter().all(|event| (event.state.t - quarter).abs() < 1e-12), "{pair:?}");
        let mut indices = [pair[0].index, pair[1].index];
        indices.sort_unstable();
        assert_eq!(indices, [if k % 2 == 0 { 1 } else { 0 }, 2]);
    }
    let mut motion = Oscillator.simulate(State::at_rest([1.0]));
    let twice = motion.events_of([position, position], 4.0).map(|event| event.unwrap().index);
    assert_eq!(twice.collect::<Vec<_>>(), [0, 1]);
    let mut motion = Oscillator.simulate(State::at_rest([1.0]));
    let first = motion.advance_to_event_of(guards, 4.0).unwrap().unwrap();
    assert!(first.index == 1 || first.index == 2);
}

type Function<'a> = dyn Fn(&State<f64, 1>) -> f64 + 'a;

/// Zeros at exactly the same time, at different parts of an interval as rounding errors will have it.
#[test]
fn simultaneous_zeros_come_in_the_order_of_the_guards() {
    let ball = Ball(2.0);
    let mut tied = 0;
    for (k, ends) in (1..60).flat_map(|k| [(k, false), (k, true)]) {
        let (t, speed) = (f64::from(k) / 64.0, f64::from((k * 37) % 64 - 32) / 16.0);
        let start = State::new([t * t - speed * t], [speed]);
        let now = |state: &State<f64, 1>| state.t - t;
        let guards: [&Function; 4] = [&|state| now(state) + state.q[0], &position, &now, &position];
        let guards = guards.map(|guard| move |state: &State<f64, 1>| guard(state));
        let until = if ends { t } else { t + 0.1 };
        let mut motion = ball.simulate(start);
        let found: Vec<_> = motion.events_of(guards, until).map(Result::unwrap).collect();
        for pair in found.windows(2) {
            let (first, second) = (&pair[0], &pair[1]);
            let together = first.state.t == second.state.t;
            assert!(!together || first.index < second.index, "{t}, {speed}: {found:?}");
            tied += u32::from(together);
        }
    }
    assert!(tied > 100, "{tied}");
}

/// A guard is zero within rounding errors where the search ends, and does not show where it goes on to.
#[test]
fn zeros_at_the_end_of_a_search_come_in_the_order_of_the_guards() {
    for ulps in 0..=8 {
        let late = move |state: &State<f64, 1>| state.t - 1.0 - f64::from(ulps) * f64::EPSILON;
        let now = |state: &State<f64, 1>| state.t - 1.0;
        let guards: [&Function; 2] = [&late, &now];
        let guards = guards.map(|guard| move |state: &State<f64, 1>| guard(state));
        let mut motion = FREE.simulate(State::at_rest([1.0]));
        let found: Vec<_> = motion.events_of(guards, 1.0).map(Result::unwrap).collect();
        let of_two = [0, 1].map(|k| found.get(k).map(|event| (event.index, event.state.t)));
        assert_eq!(of_two, [Some((0, 1.0)), Some((1, 1.0))], "{ulps}: {found:?}");
    }
}

#[test]
fn a_ball_that_bounces_by_hand() {
    let (gravity, restitution) = (9.81_f64, 0.5_f64);
    let ball = Ball(gravity);
    let mut motion = ball.simulate(State::at_rest([1.0])).with_tolerance(1e-14);
    let (mut t, mut speed) = ((2.0 / gravity).sqrt(), (2.0 * gravity).sqrt());
    for bounce in 0..24 {
        let event = motion.advance_to_event(position, 1e6).unwrap();
        let event = event.unwrap_or_else(|| panic!("bounce {bounce} at a speed of {speed:e} is missed"));
        assert_eq!(event.crossing, Falling);
        assert!((event.state.t - t).abs() < 1e-13 * t, "{bounce}: {:e}", event.state.t - t);
        assert!((event.state.v[0] + speed).abs() < 1e-6 * speed, "{bounce}: {:?}", event.state);
        motion.set_state(State { v: [-restitution * event.state.v[0]], ..event.state });
        speed *= restitution;
        t += 2.0 * speed / gravity;
    }
}

#[test]
fn what_is_far_away_does_not_hide_what_is_near() {
    for height in [1e-3, 1e-6, 1e-9] {
        let mut motion = FALLING.simulate(State::at_rest([height]));
        let event = motion.advance_to_event(position, 1e8).unwrap().unwrap();
        let t = (2.0 * height / 9.81_f64).sqrt();
        assert!((event.state.t / t - 1.0).abs() < 1e-10, "{height:e}: {event:?}");
    }
    let top = 1.0 / 19.62;
    let nearly = move |state: &State<f64, 1>| state.q[0] - (top - 1e-9);
    let mut motion = FALLING.simulate(State::new([0.0], [1.0])).with_tolerance(1e-15);
    let found = all(motion.events(nearly, 1e4));
    assert_eq!(found.iter().map(|event| event.1).collect::<Vec<_>>(), [Rising, Falling]);
}

#[test]
fn a_state_that_is_set_is_checked_and_goes_on_from_there() {
    let mut motion = Oscillator.simulate(State::at_rest([1.0]));
    motion.advance_to(2.0).unwrap();
    motion.set_state(State::at_rest([3.0]).at_time(5.0));
    assert!((motion.advance_to(5.0 + PI).unwrap().q[0] + 3.0).abs() < 1e-8);
    motion.set_state(State::at_rest([f64::NAN]));
    assert_eq!(motion.advance_to(1.0).unwrap_err().cause, Cause::NotFinite);
    assert_eq!(motion.advance_to_event(position, 1.0).unwrap_err().cause, Cause::NotFinite);
    motion.set_state(State::at_rest([1.0]));
    assert_eq!(motion.t(), 0.0);
    assert!((motion.advance_to(PI).unwrap().q[0] + 1.0).abs() < 1e-8);
}

#[test]
fn many_zeros_within_one_step() {
    // One step of a free motion, a hundred zeros.
    let mut motion = FREE.simulate(State::new([0.0], [1.0]));
    let found = all(motion.events(|state: &State<f64, 1>| (TAU * state.q[0]).cos(), 50.0));
    assert_eq!(found.len(), 100);
    for (k, event) in found.iter().enumerate() {
        assert!((event.0 - 0.25 - 0.5 * k as f64).abs() < 1e-13, "{event:?}");
    }
}

#[test]
fn steep_guards_kinks_and_jumps_are_found_where_they_are() {
    let start = State::new([0.0], [1.0]);
    let steep = |state: &State<f64, 1>| ((state.q[0] - 0.3) * 1e6).tanh();
    let mut motion = FREE.simulate(start);
    assert_times(&all(motion.events(steep, 1.0)), &[(0.3, Rising)], 1e-14);
    let jump = |state: &State<f64, 1>| if state.q[0] < 0.3 { 2.0 } else { -1.0 };
    let mut motion = FREE.simulate(start);
    assert_times(&all(motion.events(jump, 1.0)), &[(0.3, Falling)], 1e-14);
    let kink = |state: &State<f64, 1>| (state.q[0] - 0.3).abs() - 0.1;
    let mut motion = FREE.simulate(start);
    assert_times(&all(motion.events(kink, 1.0)), &[(0.2, Falling), (0.4, Rising)], 1e-14);
    let cubic = |state: &State<f64, 1>| (state.q[0] - 0.3).powi(3);
    let mut motion = FREE.simulate(start);
    assert_times(&all(motion.events(cubic, 1.0)), &[(0.3, Rising)], 1e-4);
}

#[test]
fn guards_without_zeros_have_no_events() {
    let mut motion = Driven.simulate(driven(0.0));
    let guards: [fn(&State<f64, 1>) -> f64; 4] =
        [|_| 0.0, |_| 1.0, |state| state.q[0] - state.q[0], |state| state.q[0]];
    for guard in guards {
        assert_eq!(motion.advance_to_event(guard, motion.t() + 5.0).unwrap(), None);
    }
    assert!(distance(motion.state(), &driven(20.0)) < 1e-8);
}

#[test]
fn a_motion_starts_at_its_zero() {
    let mut motion = Oscillator.simulate(State::new([0.0], [1.0])).with_tolerance(1e-13);
    assert_times(&all(motion.events(position, 4.0)), &[(PI, Falling)], 1e-11);
    let mut motion = FALLING.simulate(State::at_rest([0.0]));
    assert_eq!(motion.advance_to_event(position, 10.0).unwrap(), None);
    // Late in time, where its resolution is what a guard is zero to.
    let mut motion = Oscillator.simulate(State::at_rest([1.0]).at_time(1e9)).with_tolerance(1e-13);
    for k in 0..5 {
        let event = motion.advance_to_event(position, 2e9).unwrap().unwrap();
        assert!((event.state.t - (1e9 + FRAC_PI_2 + PI * f64::from(k))).abs() < 3e-6);
    }
}

#[test]
fn time_is_a_guard() {
    let mut motion = Oscillator.simulate(State::at_rest([1.0]));
    let found = all(motion.events(|state: &State<f64, 1>| state.t - 2.5, 10.0));
    assert_eq!(found, [(2.5, Rising)]);
}

#[test]
fn single_precision() {
    let ball = Ball(9.81_f32);
    let mut motion = ball.simulate(State::at_rest([1.0_f32]));
    let fall = |state: &State<f32, 1>| state.q[0];
    let event = motion.advance_to_event(fall, 10.0).unwrap().unwrap();
    assert!((event.state.t - (2.0 / 9.81_f32).sqrt()).abs() < 2e-6);
    for _ in 0..6 {
        motion.set_state(State { v: [-0.5 * motion.state().v[0]], ..*motion.state() });
        assert_eq!(motion.advance_to_event(fall, 10.0).unwrap().unwrap().crossing, Falling);
    }
}

mod names;
