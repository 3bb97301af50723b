//! The references of series.

use lagrangian::{Dop853, Series, Smooth, State};

use crate::support::close::{all_close, all_close_on_largest, close_on};
use crate::support::motion::numbers;

/// Orders of the series that are looked at.
const ORDERS: usize = 12;

/// The series of a motion in units of `h` \[s].
pub fn series<S, const N: usize, const K: usize>(
    system: &S,
    start: &State<f64, N>,
    inputs: &[f64; K],
    h: f64,
) -> Series<f64, N, ORDERS>
where
    S: Smooth<N, K, Scalar = f64>,
{
    let mut tables = S::Tables::<ORDERS>::default();
    let mut series = Series::default();
    let constants = system.jet_constants();
    let State { t, q, v } = start;
    assert!(system.jet_at(&constants, *t, q, v, inputs, h, ORDERS, &mut tables, &mut series));
    series
}

/// Checks the series of a motion and the motion: against accelerations, against the equations along the
/// series, and against Dormand–Prince at several times up to `end`.
#[track_caller]
pub fn agrees<S, const N: usize, const K: usize>(
    system: &S,
    start: State<f64, N>,
    inputs: [f64; K],
    end: f64,
    tolerance: f64,
) where
    S: Smooth<N, K, Scalar = f64>,
{
    obeys(system, &start, &inputs);
    let mut jets = system.simulate_with::<lagrangian::Jets>(start).with_tolerance(1e-15).with_inputs(inputs);
    let mut reference = system.simulate_with::<Dop853>(start).with_tolerance(1e-15).with_inputs(inputs);
    for part in [0.1, 0.35, 1.0] {
        let t = start.t + part * end;
        jets.advance_to(t).expect("jets: no obstacle");
        reference.advance_to(t).expect("reference: no obstacle");
        all_close(numbers(jets.state()), numbers(reference.state()), tolerance);
    }
    assert!(jets.steps().accepted < 5000, "{:?}", jets.steps());
}

/// Checks that the series satisfies q′ = v and v′ = a(t, q, v), at its start and at points near it, and that
/// its coefficients are those of the unit of time.
#[track_caller]
pub fn obeys<S, const N: usize, const K: usize>(system: &S, start: &State<f64, N>, inputs: &[f64; K])
where
    S: Smooth<N, K, Scalar = f64>,
{
    let constants = system.constants();
    let accelerations = |s: &State<f64, N>| system.accelerations_at(&constants, s.t, &s.q, &s.v, inputs);
    let unit = series(system, start, inputs, 1.0);
    all_close_on_largest(unit.q[0], start.v, 1e-14);
    all_close_on_largest(unit.v[0], accelerations(start), 1e-12);
    // Half a unit is exact in binary, and backward is as good as forward.
    let half = series(system, start, inputs, -0.5);
    for k in 0..ORDERS {
        let power = (-0.5_f64).powi(k as i32 + 1);
        let scaled = |row: [f64; N]| row.map(|x| x * power);
        assert_eq!((half.q[k], half.v[k]), (scaled(unit.q[k]), scaled(unit.v[k])), "order {}", k + 1);
    }
    // The truncated series leaves a defect of its last order: coefficients up to it are right when the defect
    // falls by its full power. Sizes of the coefficients say how far the series may be trusted.
    let largest = |row: &[f64; N]| row.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let scale = unit.v.iter().map(largest).fold(1.0, f64::max);
    let growth = (1..ORDERS)
        .map(|k| largest(&unit.v[k]).max(largest(&unit.q[k])).powf(1.0 / (k + 1) as f64))
        .fold(1.0, f64::max);
    let h = 0.03 / growth;
    for side in [h, -h] {
        let (gain_q, gain_v) = unit.gain(side, ORDERS);
        let mut state = start.at_time(start.t + side);
        let mut rate = [0.0; N];
        for i in 0..N {
            state.q[i] += gain_q[i];
            state.v[i] += gain_v[i];
            for k in (0..ORDERS).rev() {
                rate[i] = rate[i] * side + (k + 1) as f64 * unit.v[k][i];
            }
        }
        let expected = accelerations(&state);
        let size = largest(&expected).max(scale.min(largest(&unit.v[0]).max(1e-3)));
        for i in 0..N {
            close_on(size, rate[i], expected[i], 1e-12);
        }
    }
}
