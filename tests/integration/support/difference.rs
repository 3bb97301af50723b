//! Derivatives by central differences of order eight, and what follows from them: Jacobians and spectra.
//!
//! f′ ≈ Σₖ cₖ (f(x + kh) − f(x − kh)) / h, k = 1..4, with error h⁸ f⁽⁹⁾/630. At h = 0.005 the truncation of
//! functions of natural scale is below rounding, which is amplified by 1/h: about 1e-13 of |f| is reached, so
//! 1e-12 is a tolerance that a test may ask for. Functions that vary on a shorter scale take a smaller step.

use lagrangian::State;
use nalgebra::{Complex, DMatrix};

const COEFFICIENTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];

/// Step for functions that vary over lengths and times of order one.
pub const STEP: f64 = 0.005;

/// The derivative of a vector function at zero.
pub fn derivative<const N: usize>(h: f64, f: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    let mut sum = [0.0; N];
    for (k, coefficient) in (1..).zip(COEFFICIENTS) {
        let (above, below) = (f(f64::from(k) * h), f(-f64::from(k) * h));
        for (sum, (above, below)) in sum.iter_mut().zip(above.iter().zip(below)) {
            *sum += coefficient * (above - below) / h;
        }
    }
    sum
}

/// The derivative of a scalar function at zero.
pub fn slope(h: f64, f: impl Fn(f64) -> f64) -> f64 {
    derivative(h, |x| [f(x)])[0]
}

/// The total time derivative of f(t, q, v) along a motion with the accelerations `a`.
pub fn rate<const N: usize>(
    h: f64,
    state: &State<f64, N>,
    a: &[f64; N],
    f: impl Fn(&State<f64, N>) -> f64,
) -> f64 {
    slope(h, |x| {
        f(&State {
            t: state.t + x,
            q: std::array::from_fn(|i| state.q[i] + x * state.v[i]),
            v: std::array::from_fn(|i| state.v[i] + x * a[i]),
        })
    })
}

/// The state with one of its 2N numbers moved; coordinates come before velocities.
pub fn moved<const N: usize>(state: &State<f64, N>, index: usize, by: f64) -> State<f64, N> {
    let mut state = *state;
    match index.checked_sub(N) {
        None => state.q[index] += by,
        Some(velocity) => state.v[velocity] += by,
    }
    state
}

/// The matrix of d(q, v)/dt = (v, a) linearised at a state.
pub fn state_matrix<const N: usize>(
    h: f64,
    state: &State<f64, N>,
    accelerations: impl Fn(&State<f64, N>) -> [f64; N],
) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(2 * N, 2 * N);
    for i in 0..N {
        matrix[(i, N + i)] = 1.0;
    }
    for column in 0..2 * N {
        let slopes = derivative(h, |x| accelerations(&moved(state, column, x)));
        for (row, slope) in slopes.into_iter().enumerate() {
            matrix[(N + row, column)] = slope;
        }
    }
    matrix
}

/// Eigenvalues in ascending order of real, then of imaginary part, rounded to 1e-6 for the order alone.
pub fn eigenvalues(matrix: &DMatrix<f64>) -> Vec<Complex<f64>> {
    let mut values: Vec<_> = matrix.complex_eigenvalues().iter().copied().collect();
    let key = |value: &Complex<f64>| ((value.re * 1e6).round(), (value.im * 1e6).round());
    values.sort_by(|a, b| key(a).partial_cmp(&key(b)).expect("difference: finite eigenvalues"));
    values
}

/// The positive imaginary parts of a conservative system's eigenvalues, ascending.
pub fn frequencies(matrix: &DMatrix<f64>) -> Vec<f64> {
    let mut found: Vec<f64> =
        eigenvalues(matrix).iter().map(|value| value.im).filter(|im| *im > 0.0).collect();
    found.sort_by(f64::total_cmp);
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::support::close::{between, close};

    #[test]
    fn differences_of_smooth_functions_reach_twelve_digits() {
        close(slope(STEP, |x| (0.7 + x).sin()), 0.7_f64.cos(), 1e-13);
        close(slope(STEP, |x| (2.0 * (0.3 + x)).exp()), 2.0 * 0.6_f64.exp(), 1e-12);
    }

    #[test]
    fn differences_are_of_order_eight() {
        let error = |h: f64| (slope(h, |x| (3.0 * (0.3 + x)).exp()) / (3.0 * 0.9_f64.exp()) - 1.0).abs();
        between(7.8, (error(0.2) / error(0.1)).log2(), 8.2);
    }

    #[test]
    fn the_spectrum_of_an_oscillator_is_known() {
        let matrix = state_matrix(STEP, &State::new([0.1], [0.2]), |s| [-9.0 * s.q[0] - 1.5 * s.v[0]]);
        let [low, high] = eigenvalues(&matrix)[..] else { panic!("two eigenvalues") };
        close(low.re, -0.75, 1e-12);
        close(high.im, (9.0_f64 - 0.5625).sqrt(), 1e-12);
        assert_eq!(low.im, -high.im);
    }
}
