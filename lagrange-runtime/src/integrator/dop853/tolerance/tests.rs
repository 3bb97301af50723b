//! Tolerances in any units, and motions with rounding errors and jumps that no step makes small.

use crate::integrator::Field;
use crate::integrator::dop853::Dop853Memory;
use crate::system::error::{Cause, MotionError};
use crate::system::limits::Limits;
use crate::system::state::State;

/// A system by its accelerations.
struct Law<A>(A);

impl<const N: usize, A: Fn(f64, &[f64; N], &[f64; N]) -> [f64; N]> Field<f64, N> for Law<A> {
    fn accelerations(&self, t: f64, q: &[f64; N], v: &[f64; N]) -> [f64; N] {
        (self.0)(t, q, v)
    }

    fn cause(&self, _: f64, _: &[f64; N], _: &[f64; N]) -> Cause {
        Cause::NotFinite
    }
}

/// The state at `end`, and the attempts it took.
fn moved<const N: usize>(
    law: impl Fn(f64, &[f64; N], &[f64; N]) -> [f64; N],
    (q, v): ([f64; N], [f64; N]),
    limits: Limits<f64>,
    end: f64,
) -> Result<(State<f64, N>, u64), MotionError<f64>> {
    let law = Law(law);
    let mut motion = Dop853Memory::new(State { t: 0.0, q, v });
    let mut left = 1_000_000;
    while motion.end.state.t != end {
        motion.step(&law, &limits, end, true, &mut left)?;
    }
    Ok((motion.end.state, 1_000_000 - left))
}

fn to(relative: f64) -> Limits<f64> {
    Limits { relative, ..Limits::new() }
}

#[test]
fn units_of_length_and_time_do_not_matter() {
    // A pendulum with a length scale and a time scale: q = length · angle, released from rest.
    for length in [1e-200, 1e-100, 1e-12, 1.0, 1e12, 1e100, 1e200] {
        for time in [1e-40, 1e-9, 1.0, 1e9, 1e40] {
            let law = |_: f64, q: &[f64; 1], _: &[f64; 1]| [-(q[0] / length).sin() * (length / time) / time];
            let (state, attempts) = moved(law, ([length], [0.0]), to(1e-12), 10.0 * time).unwrap();
            let energy = 0.5 * (state.v[0] / length * time).powi(2) - (state.q[0] / length).cos();
            assert!((energy + 1.0_f64.cos()).abs() < 1e-10, "{length} {time}: {energy}");
            assert!(attempts < 300, "{length} {time}: {attempts} attempts");
        }
    }
}

#[test]
fn a_small_fast_motion_beside_a_large_slow_one_is_as_accurate() {
    let (small, fast) = (1e-13, 100.0);
    let law = |_: f64, q: &[f64; 2], _: &[f64; 2]| [-q[0], -fast * fast * q[1]];
    let (state, _) = moved(law, ([1.0, small], [0.0, 0.0]), to(1e-12), 10.0).unwrap();
    let errors = [state.q[0] - 10.0_f64.cos(), state.q[1] / small - 1000.0_f64.cos()];
    assert!(errors.iter().all(|error| error.abs() < 1e-8), "{errors:?}");
}

#[test]
fn an_absolute_tolerance_of_the_caller_is_kept() {
    let limits = Limits { absolute: Some(1e-6), ..to(1e-12) };
    let law = |_: f64, q: &[f64; 1], _: &[f64; 1]| [-q[0]];
    let (_, few) = moved(law, ([1e-6], [0.0]), limits, 100.0).unwrap();
    let (_, many) = moved(law, ([1e-6], [0.0]), to(1e-12), 100.0).unwrap();
    assert!(3 * few < many, "{few} {many}");
}

#[test]
fn roundings_alone_end_no_motion() {
    // A weight on a spring whose force at rest is a rounding error.
    let spring = |_: f64, q: &[f64; 1], _: &[f64; 1]| [-(30.0 * (q[0] + 0.1) - 3.0)];
    for start in [0.0, 1e-17, 1e-16, 3e-16, 1e-15] {
        let (state, attempts) = moved(spring, ([start], [0.0]), to(1e-10), 10.0).unwrap();
        assert!(state.q[0].abs() < 1e-14 && state.v[0].abs() < 1e-13, "{start}: {state:?}");
        // The force is a staircase of about 70 steps at the most, each of which is a jump.
        assert!(attempts < 200_000, "{start}: {attempts}");
    }
    // A pendulum upside down: its force is smaller than an ulp of π, and its velocity grows from that.
    let pendulum = |_: f64, q: &[f64; 1], _: &[f64; 1]| [-q[0].sin()];
    let (state, attempts) = moved(pendulum, ([core::f64::consts::PI], [0.0]), to(1e-10), 10.0).unwrap();
    assert!((state.q[0] - core::f64::consts::PI).abs() < 1e-11, "{state:?}");
    assert!(attempts < 20_000, "{attempts}");
}

#[test]
fn a_jump_costs_the_tolerance_in_any_unit() {
    // a = −J sign q from q = J/2: parabolas of period 4 s.
    for jump in [1e-30, 1e-12, 1.0, 1e12] {
        for relative in [1e-6, 1e-8, 1e-10] {
            let law = |_: f64, q: &[f64; 1], _: &[f64; 1]| [-jump * q[0].signum()];
            let (state, attempts) = moved(law, ([0.5 * jump], [0.0]), to(relative), 40.0).unwrap();
            let errors = [state.q[0] / jump - 0.5, state.v[0] / jump];
            assert!(
                errors.iter().all(|error| error.abs() < 1e3 * relative),
                "{jump} {relative}: {errors:?} {attempts}"
            );
            assert!(attempts < 3_000, "{jump} {relative}: {attempts}");
        }
    }
}

#[test]
fn forces_of_nothing_but_noise_are_passed_over() {
    // Noise of 1e-17, as at a rest where two forces of 1 are in balance.
    let noise = |t: f64, q: &[f64; 1], _: &[f64; 1]| {
        let bits = (t.to_bits() ^ q[0].to_bits().rotate_left(17)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        [1e-17 * ((bits >> 32) as f64 / 2.0_f64.powi(31) - 1.0)]
    };
    let (state, attempts) = moved(noise, ([0.0], [0.0]), to(1e-10), 10.0).unwrap();
    assert!(state.q[0].abs() < 1e-14 && attempts < 3_000, "{state:?} {attempts}");
}

#[test]
fn a_singularity_is_still_an_error() {
    // q = (1 − t)^(2/3), which falls into the centre at t = 1.
    let law = |_: f64, q: &[f64; 1], _: &[f64; 1]| [-2.0 / (9.0 * q[0] * q[0])];
    let error = moved(law, ([1.0], [-2.0 / 3.0]), to(1e-10), 2.0).unwrap_err();
    assert!((error.t - 1.0).abs() < 1e-6, "{error:?}");
}
