//! Identities that hold for every constrained system, checked on its generated methods at states on its
//! constraints.
//!
//! With w = df/dt of the holonomic constraints and w = g of the nonholonomic ones, A = ∂w/∂v, Q = applied
//! forces:
//!
//! 1. M a + bias = Q + Aᵀ λ, and the reaction forces are the rows of A times λ;
//! 2. A = ∂w/∂v; w = df/dt along the velocities where f is holonomic;
//! 3. w stays zero along the accelerations;
//! 4. the power of the reactions is v·Aᵀ λ, and the rate of the energy its derivative along the motion.
//!
//! Derivatives are differences of order eight, so nothing here shares code with the generator.

use lagrangian::State;
use nalgebra::SMatrix;

use super::close::{all_close_on_largest, close_on};
use super::difference::{derivative, moved, rate};

type Scalar<'a, const N: usize> = Box<dyn Fn(&State<f64, N>) -> f64 + 'a>;
type Vector<'a, const N: usize, const C: usize> = Box<dyn Fn(&State<f64, N>) -> [f64; C] + 'a>;
type Rows<'a, const N: usize, const C: usize> = Box<dyn Fn(&State<f64, N>) -> [[f64; N]; C] + 'a>;
type Matrix<'a, const N: usize, const C: usize> = Box<dyn Fn(&State<f64, N>) -> SMatrix<f64, C, N> + 'a>;

/// The generated methods of one constrained system.
pub struct Bound<'a, const N: usize, const C: usize> {
    /// M.
    pub mass_matrix: Matrix<'a, N, N>,
    /// b.
    pub bias: Vector<'a, N, N>,
    /// a.
    pub accelerations: Vector<'a, N, N>,
    /// Q − ∂D/∂v.
    pub applied_forces: Vector<'a, N, N>,
    /// λ.
    pub reactions: Vector<'a, N, C>,
    /// λ ∂f/∂q.
    pub reaction_forces: Rows<'a, N, C>,
    /// v·Aᵀ λ.
    pub reaction_power: Scalar<'a, N>,
    /// T + V.
    pub energy: Scalar<'a, N>,
    /// d(T + V)/dt.
    pub energy_rate: Scalar<'a, N>,
    /// f, or g.
    pub residuals: Vector<'a, N, C>,
    /// w.
    pub rates: Vector<'a, N, C>,
    /// A.
    pub jacobian: Matrix<'a, N, C>,
    /// Which constraints are holonomic.
    pub holonomic: [bool; C],
}

/// The methods of a system and which of its constraints are holonomic: `bound!(system, [true, false])`, with
/// `forces` if it has applied forces, with `inputs = [..]` held if it has inputs.
macro_rules! bound {
    ($system:expr, $holonomic:expr) => {
        bound!(@ $system, $holonomic, |_| Default::default(),)
    };
    ($system:expr, $holonomic:expr, forces) => {
        bound!(@ $system, $holonomic, |s| $system.applied_forces(s),)
    };
    ($system:expr, $holonomic:expr, inputs = $inputs:expr) => {
        bound!(@ $system, $holonomic, |s| $system.applied_forces(s, &$inputs), &$inputs)
    };
    (@ $system:expr, $holonomic:expr, $applied:expr, $($inputs:expr)?) => {
        $crate::support::constrained::Bound {
            mass_matrix: Box::new(|s| $system.mass_matrix(s)),
            bias: Box::new(|s| $system.bias(s)),
            accelerations: Box::new(|s| $system.accelerations(s $(, $inputs)?).expect("bound: a regular state")),
            applied_forces: Box::new($applied),
            reactions: Box::new(|s| (*$system.reactions(s $(, $inputs)?).expect("bound: a regular state")).into()),
            reaction_forces: Box::new(|s| {
                $system.reaction_forces(s $(, $inputs)?).expect("bound: a regular state").into()
            }),
            reaction_power: Box::new(|s| {
                $system.reaction_power(s $(, $inputs)?).expect("bound: a regular state")
            }),
            energy: Box::new(|s| $system.energy(s)),
            energy_rate: Box::new(|s| $system.energy_rate(s $(, $inputs)?).expect("bound: a regular state")),
            residuals: Box::new(|s| $system.constraint_residuals(s)),
            rates: Box::new(|s| $system.constraint_rates(s)),
            jacobian: Box::new(|s| $system.constraint_jacobian(s)),
            holonomic: $holonomic,
        }
    };
}
pub(crate) use bound;

/// Step of the differences: the systems vary over lengths and times of order one, with higher harmonics.
const STEP: f64 = 0.004;

/// The accuracy of differences, relative to the size of the terms.
const TOLERANCE: f64 = 1e-10;

impl<const N: usize, const C: usize> Bound<'_, N, C> {
    /// Checks all identities at states on the constraints.
    #[track_caller]
    pub fn holds(&self, states: impl IntoIterator<Item = State<f64, N>>) {
        let mut count = 0;
        for state in states {
            self.the_equations_of_motion_hold(&state);
            self.gradients_are_derivatives(&state);
            self.rates_are_derivatives(&state);
            self.the_constraints_stay(&state);
            self.power_and_energy_balance(&state);
            count += 1;
        }
        assert!(count > 0, "bound: states to check");
    }

    #[track_caller]
    fn the_equations_of_motion_hold(&self, state: &State<f64, N>) {
        let (mass, a, bias) = ((self.mass_matrix)(state), (self.accelerations)(state), (self.bias)(state));
        let (applied, rows, lambda) =
            ((self.applied_forces)(state), (self.jacobian)(state), (self.reactions)(state));
        for (c, forces) in (self.reaction_forces)(state).into_iter().enumerate() {
            let expected: [f64; N] = std::array::from_fn(|i| lambda[c] * rows[(c, i)]);
            all_close_on_largest(forces, expected, 1e-14);
        }
        for i in 0..N {
            let inertia = (0..N).map(|j| mass[(i, j)] * a[j]);
            let reaction = (0..C).map(|c| rows[(c, i)] * lambda[c]);
            let scale = inertia.clone().chain(reaction.clone()).map(f64::abs).sum::<f64>();
            let scale = (scale + bias[i].abs() + applied[i].abs()).max(1e-3);
            close_on(scale, inertia.sum::<f64>() + bias[i], applied[i] + reaction.sum::<f64>(), 1e-12);
        }
    }

    #[track_caller]
    fn gradients_are_derivatives(&self, state: &State<f64, N>) {
        let rows = (self.jacobian)(state);
        let columns: Vec<f64> =
            (0..N).flat_map(|i| derivative(STEP, |x| (self.rates)(&moved(state, N + i, x)))).collect();
        all_close_on_largest(columns, rows.as_slice(), TOLERANCE);
    }

    #[track_caller]
    fn rates_are_derivatives(&self, state: &State<f64, N>) {
        // Off the constraints, where a rate that is always zero would show.
        let fast = State { v: std::array::from_fn(|i| 1.3 * state.v[i] + 0.1 * (i + 1) as f64), ..*state };
        let rates = (self.rates)(&fast);
        for c in 0..C {
            let expected = if self.holonomic[c] {
                rate(STEP, &fast, &[0.0; N], |s| (self.residuals)(s)[c])
            } else {
                (self.residuals)(&fast)[c]
            };
            let scale = fast.v.iter().fold(1.0, |scale: f64, v| scale.max(v.abs()));
            close_on(scale, rates[c], expected, TOLERANCE);
        }
    }

    #[track_caller]
    fn the_constraints_stay(&self, state: &State<f64, N>) {
        let (rows, a) = ((self.jacobian)(state), (self.accelerations)(state));
        for c in 0..C {
            let change = rate(STEP, state, &a, |s| (self.rates)(s)[c]);
            let scale: f64 = (0..N).map(|i| (rows[(c, i)] * a[i]).abs()).sum();
            close_on(scale.max(1.0), change, 0.0, TOLERANCE);
        }
    }

    #[track_caller]
    fn power_and_energy_balance(&self, state: &State<f64, N>) {
        let power: Vec<f64> = (self.reaction_forces)(state)
            .iter()
            .flat_map(|forces| forces.iter().zip(state.v).map(|(force, v)| force * v))
            .collect();
        let scale = power.iter().map(|x| x.abs()).sum::<f64>().max(1.0);
        close_on(scale, (self.reaction_power)(state), power.iter().sum(), 1e-12);
        let change = rate(STEP, state, &(self.accelerations)(state), |s| (self.energy)(s));
        let scale = scale.max((self.energy)(state).abs()).max(change.abs());
        close_on(scale, (self.energy_rate)(state), change, TOLERANCE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point of mass 2 with drag on the moving line f = y − x/2 − t²; `wrong` picks one method to spoil by
    /// 1e-8.
    fn lift(wrong: usize) -> Bound<'static, 2, 1> {
        let spoil = move |method: usize| if method == wrong { 1.0 + 1e-8 } else { 1.0 };
        let drag = |s: &State<f64, 2>| [-0.3 * s.v[0], -0.3 * s.v[1]];
        // With n = (−1/2, 1): n·a = 2, λ = (2 m − n·Q)/(5/4).
        let lambda = move |s: &State<f64, 2>| (4.0 - (drag(s)[1] - 0.5 * drag(s)[0])) / 1.25;
        let a = move |s: &State<f64, 2>| {
            let (drag, lambda) = (drag(s), lambda(s));
            [(drag[0] - 0.5 * lambda) / 2.0, (drag[1] + lambda) / 2.0]
        };
        let power = move |s: &State<f64, 2>| lambda(s) * 2.0 * s.t;
        Bound {
            mass_matrix: Box::new(move |_| SMatrix::from([[2.0 * spoil(1), 0.0], [0.0, 2.0]])),
            bias: Box::new(move |_| [(1.0 - spoil(2)) * 10.0, 0.0]),
            accelerations: Box::new(move |s| a(s).map(|a| a * spoil(3))),
            applied_forces: Box::new(move |s| drag(s).map(|x| x * spoil(4))),
            reactions: Box::new(move |s| [lambda(s) * spoil(5)]),
            reaction_forces: Box::new(move |s| [[-0.5 * lambda(s) * spoil(6), lambda(s)]]),
            reaction_power: Box::new(move |s| power(s) * spoil(7)),
            energy: Box::new(move |s| (s.v[0].powi(2) + s.v[1].powi(2)) * spoil(8)),
            energy_rate: Box::new(move |s| (power(s) + s.v[0] * drag(s)[0] + s.v[1] * drag(s)[1]) * spoil(9)),
            residuals: Box::new(move |s| [(s.q[1] - 0.5 * s.q[0] - s.t * s.t) * spoil(10)]),
            rates: Box::new(move |s| [(s.v[1] - 0.5 * s.v[0] - 2.0 * s.t) * spoil(11)]),
            jacobian: Box::new(move |_| SMatrix::from([[-0.5 * spoil(12)], [1.0]])),
            holonomic: [wrong != 13],
        }
    }

    fn state() -> State<f64, 2> {
        State::new([1.0, 0.5 + 0.49], [2.0, 1.0 + 1.4]).at_time(0.7)
    }

    #[test]
    fn a_right_system_passes() {
        lift(0).holds([state()]);
    }

    #[test]
    fn a_small_mistake_in_any_method_is_found() {
        for wrong in 1..=13 {
            let verdict = std::panic::catch_unwind(|| lift(wrong).holds([state()]));
            assert!(verdict.is_err(), "method {wrong} is wrong and passes");
        }
    }
}
