//! How many digits of a motion through switches are true: the same motion with 31 digits.

use lagrangian::DoubleDouble;
use lagrangian::prelude::*;

/// The states at the first switches of a motion from a start.
macro_rules! at_switches {
    ($system:expr, $start:expr, $tolerance:expr, $count:expr) => {{
        let system = $system;
        let mut motion = system.simulate($start).with_tolerance($tolerance);
        let far = (1e3).into();
        let next = |_| motion.advance_to_switch(far).unwrap().expect("it goes on").state;
        (0..$count).map(next).collect::<Vec<_>>()
    }};
}
pub(crate) use at_switches;

/// The same numbers with 31 digits.
pub fn widened<const N: usize>(states: &[State<f64, N>]) -> Vec<State<DoubleDouble, N>> {
    states
        .iter()
        .map(|state| State { t: state.t.into(), q: state.q.map(Into::into), v: state.v.map(Into::into) })
        .collect()
}

/// The largest deviation of times, coordinates and velocities from the expected ones, as a part of the
/// largest of their kind.
pub fn deviation<const N: usize>(
    found: &[State<DoubleDouble, N>],
    expected: &[State<DoubleDouble, N>],
) -> f64 {
    assert_eq!(found.len(), expected.len());
    let largest = |numbers: Vec<DoubleDouble>| {
        assert!(numbers.iter().all(|x| x.is_finite()));
        numbers.iter().fold(0.0, |most: f64, x| most.max(x.high().abs()))
    };
    let numbers = |states: &[State<DoubleDouble, N>], kind| -> Vec<DoubleDouble> {
        let of = |state: &State<DoubleDouble, N>| match kind {
            0 => vec![state.t],
            1 => state.q.to_vec(),
            _ => state.v.to_vec(),
        };
        states.iter().flat_map(of).collect()
    };
    let deviations = (0..3).map(|kind| {
        let expected = numbers(expected, kind);
        let apart = numbers(found, kind).iter().zip(&expected).map(|(&a, &b)| a - b).collect();
        largest(apart) / largest(expected)
    });
    deviations.fold(0.0, f64::max)
}

/// Asserts that a motion at a tolerance of 1e-13, and one of 31 digits at 1e-22, are those of 31 digits at
/// 1e-27 within these bounds.
#[track_caller]
pub fn agree<const N: usize>(
    double: &[State<f64, N>],
    digits: [&[State<DoubleDouble, N>]; 2],
    [by_double, by_digits]: [f64; 2],
) {
    let [coarse, fine] = digits;
    let deviations = [deviation(&widened(double), fine), deviation(coarse, fine)];
    println!("deviations {deviations:?}");
    assert!(deviations[0] <= by_double && deviations[1] <= by_digits, "{deviations:?}");
}
