//! Identities that hold for every mechanical system, checked on its generated methods at random states.
//!
//! With p = ∂L/∂v, h = v·p − L (the Jacobi integral; T + V where they are the same) and the applied forces Q
//! − ∂D/∂v:
//!
//! 1. M = ∂p/∂v, and M is symmetric to the last bit;
//! 2. M a + bias = applied forces;
//! 3. dp/dt = ∂L/∂q + applied forces along the motion, with L from p and h alone;
//! 4. dh/dt = power − ∂L/∂t along the motion.
//!
//! Derivatives are differences of order eight, so nothing here shares code with the generator.

use lagrangian::State;
use nalgebra::SMatrix;

use super::close::{all_close_on_largest, close_on};
use super::difference::{derivative, moved, rate, slope};
use super::sample::Samples;

type Scalar<'a, const N: usize> = Box<dyn Fn(&State<f64, N>) -> f64 + 'a>;
type Vector<'a, const N: usize> = Box<dyn Fn(&State<f64, N>) -> [f64; N] + 'a>;
type Matrix<'a, const N: usize> = Box<dyn Fn(&State<f64, N>) -> SMatrix<f64, N, N> + 'a>;

/// The generated methods of one system.
pub struct Model<'a, const N: usize> {
    /// M.
    pub mass_matrix: Matrix<'a, N>,
    /// b.
    pub bias: Vector<'a, N>,
    /// p.
    pub momenta: Vector<'a, N>,
    /// a.
    pub accelerations: Vector<'a, N>,
    /// Q − ∂D/∂v.
    pub applied_forces: Vector<'a, N>,
    /// v·(Q − ∂D/∂v).
    pub power: Scalar<'a, N>,
    /// h.
    pub jacobi_integral: Scalar<'a, N>,
}

/// The methods of a system: `model!(system)`, with `forces` if it has applied forces, and `jacobi` if its
/// Jacobi integral is not its energy; with `inputs = [..]` held if it has inputs.
macro_rules! model {
    ($system:expr) => {
        model!(@ $system, |_| Default::default(), |_| 0.0, |s| $system.energy(s))
    };
    ($system:expr, jacobi) => {
        model!(@ $system, |_| Default::default(), |_| 0.0, |s| $system.jacobi_integral(s))
    };
    ($system:expr, forces) => {
        model!(@ $system, |s| $system.applied_forces(s), |s| $system.power(s), |s| $system.energy(s))
    };
    ($system:expr, forces, jacobi) => {
        model!(@ $system, |s| $system.applied_forces(s), |s| $system.power(s), |s| $system.jacobi_integral(s))
    };
    ($system:expr, inputs = $inputs:expr) => {
        $crate::support::identities::Model {
            mass_matrix: Box::new(|s| $system.mass_matrix(s)),
            bias: Box::new(|s| $system.bias(s)),
            momenta: Box::new(|s| $system.momenta(s)),
            accelerations: Box::new(|s| $system.accelerations(s, &$inputs).expect("model: a regular state")),
            applied_forces: Box::new(|s| $system.applied_forces(s, &$inputs)),
            power: Box::new(|s| $system.power(s, &$inputs)),
            jacobi_integral: Box::new(|s| $system.energy(s)),
        }
    };
    (@ $system:expr, $applied:expr, $power:expr, $jacobi:expr) => {
        $crate::support::identities::Model {
            mass_matrix: Box::new(|s| $system.mass_matrix(s)),
            bias: Box::new(|s| $system.bias(s)),
            momenta: Box::new(|s| $system.momenta(s)),
            accelerations: Box::new(|s| $system.accelerations(s).expect("model: a regular state")),
            applied_forces: Box::new($applied),
            power: Box::new($power),
            jacobi_integral: Box::new($jacobi),
        }
    };
}
pub(crate) use model;

/// The number of states at which the identities are checked.
const STATES: usize = 10;

/// Step of the differences: the systems vary over lengths and times of order one, with higher harmonics.
const STEP: f64 = 0.004;

/// The accuracy of differences, relative to the size of the terms.
const TOLERANCE: f64 = 1e-10;

impl<const N: usize> Model<'_, N> {
    /// Checks all identities at states with every number in [low, high).
    #[track_caller]
    pub fn holds(&self, low: f64, high: f64) {
        let mut samples = Samples::new(N as u64);
        for _ in 0..STATES {
            let state = samples.state(low, high);
            self.mass_is_the_slope_of_the_momenta(&state);
            self.accelerations_solve(&state);
            self.lagranges_equations_hold(&state);
            self.the_jacobi_integral_balances(&state);
        }
    }

    /// L by Legendre's transformation.
    fn lagrangian(&self, state: &State<f64, N>) -> f64 {
        let p = (self.momenta)(state);
        state.v.iter().zip(p).map(|(v, p)| v * p).sum::<f64>() - (self.jacobi_integral)(state)
    }

    #[track_caller]
    fn mass_is_the_slope_of_the_momenta(&self, state: &State<f64, N>) {
        let mass = (self.mass_matrix)(state);
        assert_eq!(mass, mass.transpose());
        let columns: Vec<f64> =
            (0..N).flat_map(|i| derivative(STEP, |x| (self.momenta)(&moved(state, N + i, x)))).collect();
        all_close_on_largest(columns, mass.as_slice(), TOLERANCE);
    }

    #[track_caller]
    fn accelerations_solve(&self, state: &State<f64, N>) {
        let (mass, a) = ((self.mass_matrix)(state), (self.accelerations)(state));
        let (bias, applied) = ((self.bias)(state), (self.applied_forces)(state));
        for i in 0..N {
            let terms = (0..N).map(|j| mass[(i, j)] * a[j]);
            let scale = terms.clone().map(f64::abs).sum::<f64>() + bias[i].abs() + applied[i].abs();
            close_on(scale.max(1e-3), terms.sum::<f64>() + bias[i], applied[i], 1e-12);
        }
    }

    #[track_caller]
    fn lagranges_equations_hold(&self, state: &State<f64, N>) {
        let (a, applied) = ((self.accelerations)(state), (self.applied_forces)(state));
        let scale = (self.jacobi_integral)(state).abs() + self.lagrangian(state).abs();
        for i in 0..N {
            let change = rate(STEP, state, &a, |s| (self.momenta)(s)[i]);
            let force = slope(STEP, |x| self.lagrangian(&moved(state, i, x)));
            let scale = (scale + change.abs() + force.abs()).max(1e-3);
            close_on(scale, change, force + applied[i], TOLERANCE);
        }
    }

    #[track_caller]
    fn the_jacobi_integral_balances(&self, state: &State<f64, N>) {
        let a = (self.accelerations)(state);
        let change = rate(STEP, state, &a, |s| (self.jacobi_integral)(s));
        let explicit = slope(STEP, |x| self.lagrangian(&state.at_time(state.t + x)));
        let power = (self.power)(state);
        let dot: f64 = state.v.iter().zip((self.applied_forces)(state)).map(|(v, q)| v * q).sum();
        close_on(power.abs().max(1.0), power, dot, 1e-13);
        let scale = (self.jacobi_integral)(state).abs() + self.lagrangian(state).abs() + power.abs();
        close_on(scale.max(1e-3), change, power - explicit, TOLERANCE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x″ = −x + cos t − 0.1 x′ with mass 2; `wrong` picks one method to spoil by a hundred-millionth.
    fn oscillator(wrong: usize) -> Model<'static, 1> {
        let spoil = move |method: usize| if method == wrong { 1.0 + 1e-8 } else { 1.0 };
        let force = |s: &State<f64, 1>| -0.2 * s.v[0];
        Model {
            mass_matrix: Box::new(move |_| SMatrix::from([[2.0 * spoil(1)]])),
            bias: Box::new(move |s| [(2.0 * s.q[0] - 2.0 * s.t.cos()) * spoil(2)]),
            momenta: Box::new(move |s| [2.0 * s.v[0] * spoil(3)]),
            accelerations: Box::new(move |s| [(-s.q[0] + s.t.cos() + force(s) / 2.0) * spoil(4)]),
            applied_forces: Box::new(move |s| [force(s) * spoil(5)]),
            power: Box::new(move |s| s.v[0] * force(s) * spoil(6)),
            jacobi_integral: Box::new(move |s| {
                s.v[0] * s.v[0] * spoil(7) + s.q[0] * s.q[0] - 2.0 * s.q[0] * s.t.cos() * spoil(8)
            }),
        }
    }

    #[test]
    fn a_right_model_passes() {
        oscillator(0).holds(0.5, 1.5);
    }

    #[test]
    fn a_small_mistake_in_any_method_is_found() {
        for wrong in 1..=8 {
            let verdict = std::panic::catch_unwind(|| oscillator(wrong).holds(0.5, 1.5));
            assert!(verdict.is_err(), "method {wrong} is wrong and passes");
        }
    }
}
