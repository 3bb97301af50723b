//! The motion together with its derivatives by the start and by parameters: the variational equations
//! δq̈ = (∂a/∂q) δq + (∂a/∂v) δv + ∂a/∂p (Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.,
//! § I.14).
//!
//! The integrator works on numbers that carry their derivatives ([`Varied`]), so what comes out is the derivative of the very
//! sums that the motion is made of. Derivatives of the accelerations are generated; they are never formed as matrices but
//! applied to the columns, with one factorisation an evaluation.

use nalgebra::SMatrix;
use num_traits::Zero;

use super::response::{Factored, factored};
use super::{Place, Sensitive, Varied};
use crate::error::{Cause, MotionError};
use crate::integrator::Dop853;
use crate::linear::{Saddle, SaddlePoint};
use crate::real::{Ordered, Real};
use crate::simulation::{Held, Simulation};
use crate::state::State;
use crate::system::System;

/// A system whose states carry their derivatives: any integrator that takes a [`System`] takes it.
///
/// The energy is a plain number: its derivatives are not carried.
#[derive(Clone, Copy, Debug)]
pub struct Variational<'a, S, const N: usize, const K: usize, const C: usize, const P: usize> {
    system: &'a S,
}

/// A motion with its derivatives, by Dormand–Prince 8(5,3) under the control of the error of the motion.
pub struct VariationalMotion<'a, S, const N: usize, const K: usize, const C: usize, const P: usize>
where
    S: Sensitive<N, K, C, P>,
    S::Scalar: Ordered,
{
    simulation:
        Simulation<'a, Variational<'a, S, N, K, C, P>, Held<Varied<S::Scalar, N, P>, K>, Dop853, N, K>,
}

/// A state and its derivatives by the start and by parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transition<R, const N: usize, const P: usize = 0> {
    /// The state.
    pub state: State<R, N>,
    /// ∂q/∂q₀, and so on: the state-transition matrix in four blocks.
    pub q_by_q: SMatrix<R, N, N>,
    /// ∂q/∂v₀.
    pub q_by_v: SMatrix<R, N, N>,
    /// ∂v/∂q₀.
    pub v_by_q: SMatrix<R, N, N>,
    /// ∂v/∂v₀.
    pub v_by_v: SMatrix<R, N, N>,
    /// ∂q/∂p.
    pub q_by_p: SMatrix<R, N, P>,
    /// ∂v/∂p.
    pub v_by_p: SMatrix<R, N, P>,
}

impl<R: Real, const N: usize, const P: usize> From<&State<Varied<R, N, P>, N>> for Transition<R, N, P> {
    fn from(state: &State<Varied<R, N, P>, N>) -> Self {
        let State { q, v, .. } = state;
        Self {
            state: plain(state),
            q_by_q: SMatrix::from_fn(|i, j| q[i].by_q[j]),
            q_by_v: SMatrix::from_fn(|i, j| q[i].by_v[j]),
            v_by_q: SMatrix::from_fn(|i, j| v[i].by_q[j]),
            v_by_v: SMatrix::from_fn(|i, j| v[i].by_v[j]),
            q_by_p: SMatrix::from_fn(|i, j| q[i].by_p[j]),
            v_by_p: SMatrix::from_fn(|i, j| v[i].by_p[j]),
        }
    }
}

/// The state without derivatives.
fn plain<R: Real, const N: usize, const P: usize>(state: &State<Varied<R, N, P>, N>) -> State<R, N> {
    State { t: state.t.value, q: state.q.map(|q| q.value), v: state.v.map(|v| v.value) }
}

impl<'a, S, const N: usize, const K: usize, const C: usize, const P: usize> Variational<'a, S, N, K, C, P>
where
    S: Sensitive<N, K, C, P>,
    S::Scalar: Ordered,
{
    /// The system with derivatives.
    pub(super) fn new(system: &'a S) -> Self {
        Self { system }
    }

    /// A motion from a state, with inputs at zero. Of a constrained system the derivatives at the start are those of the
    /// nearest consistent state, so that every column obeys the constraints.
    ///
    /// # Errors
    /// What is wrong with the constraints at the start.
    pub fn motion(
        &'a self,
        start: State<S::Scalar, N>,
    ) -> Result<VariationalMotion<'a, S, N, K, C, P>, MotionError<S::Scalar>> {
        let mut varied = State {
            t: Varied::constant(start.t),
            q: start.q.map(Varied::constant),
            v: start.v.map(Varied::constant),
        };
        for (i, (q, v)) in varied.q.iter_mut().zip(&mut varied.v).enumerate() {
            q.by_q[i] = num_traits::One::one();
            v.by_v[i] = num_traits::One::one();
        }
        if C > 0 {
            let failed = |cause| MotionError { cause, t: start.t };
            self.along_constraints(&self.system.constants(), &mut varied).map_err(failed)?;
        }
        Ok(VariationalMotion { simulation: Simulation::new(self, varied) })
    }

    /// Moves the derivatives of a state onto the tangent space of the constraints.
    fn along_constraints(
        &self,
        constants: &S::Constants,
        state: &mut State<Varied<S::Scalar, N, P>, N>,
    ) -> Result<(), Cause> {
        let zero = S::Scalar::zero();
        let State { t, q, v } = plain(state);
        let (a, multipliers, u) = ([zero; N], [zero; C], [zero; K]);
        let place = Place { t, q: &q, v: &v, a: &a, multipliers: &multipliers, u: &u };
        let variation = self.system.variation_at(constants, &place);
        let by_p = self.system.by_parameters_at(constants, &place);
        let saddle = Saddle::factor_indefinite(&variation.mass, &variation.gradients);
        crate::constraints::regular(&saddle)?;
        let none = [zero; N];
        for direction in 0..2 * N + P {
            let of_parameter = |rows: &[[S::Scalar; P]; C], c: usize| match direction.checked_sub(2 * N) {
                Some(p) => rows[c][p],
                None => zero,
            };
            let (dq, dv) = (slope(&state.q, direction), slope(&state.v, direction));
            let off = core::array::from_fn(|c| {
                let moved = S::HOLONOMIC[c].then(|| along(&variation.gradients[c], &dq));
                -(moved.unwrap_or(zero) + of_parameter(&by_p.positions, c))
            });
            let dq = added(&dq, &saddle.solve(&none, &off).0);
            let off = core::array::from_fn(|c| {
                let rate = along(&variation.gradients[c], &dv) + along(&variation.rates_by_q[c], &dq);
                -(rate + of_parameter(&by_p.rates, c))
            });
            let dv = added(&dv, &saddle.solve(&none, &off).0);
            set_slope(&mut state.q, direction, &dq);
            set_slope(&mut state.v, direction, &dv);
        }
        Ok(())
    }
}

/// One derivative of each number.
fn slope<R: Real, const N: usize, const P: usize>(of: &[Varied<R, N, P>; N], direction: usize) -> [R; N] {
    of.map(|x| x.slopes().nth(direction).unwrap_or(R::zero()))
}

fn set_slope<R: Real, const N: usize, const P: usize>(
    of: &mut [Varied<R, N, P>; N],
    direction: usize,
    slopes: &[R; N],
) {
    for (x, &slope) in of.iter_mut().zip(slopes) {
        if let Some(to) = x.slopes_mut().nth(direction) {
            *to = slope;
        }
    }
}

fn along<R: Real, const M: usize>(row: &[R; M], direction: &[R; M]) -> R {
    row.iter().zip(direction).fold(R::zero(), |sum, (&a, &b)| R::mul_add(a, b, sum))
}

fn added<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> [R; N] {
    core::array::from_fn(|i| a[i] + b[i])
}

impl<S, const N: usize, const K: usize, const C: usize, const P: usize> System<N, K>
    for Variational<'_, S, N, K, C, P>
where
    S: Sensitive<N, K, C, P>,
    S::Scalar: Ordered,
{
    type Scalar = Varied<S::Scalar, N, P>;
    type Method = Dop853;
    type Constants = S::Constants;
    const CONSTRAINED: bool = S::CONSTRAINED;

    #[inline]
    fn constants(&self) -> Self::Constants {
        self.system.constants()
    }

    fn accelerations_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
    ) -> [Self::Scalar; N] {
        let state = plain(&State { t, q: *q, v: *v });
        let inputs = u.map(|u| u.value);
        let Ok(Factored { balance, variation, saddle }) = factored(self.system, constants, &state, &inputs)
        else {
            return [Varied::constant(S::Scalar::from_f64(f64::NAN)); N];
        };
        let a = balance.accelerations;
        let place = Place {
            t: state.t,
            q: &state.q,
            v: &state.v,
            a: &a,
            multipliers: &balance.multipliers,
            u: &inputs,
        };
        let by_p = self.system.by_parameters_at(constants, &place);
        let mut accelerations = a.map(Varied::constant);
        for direction in 0..2 * N + P {
            let (dq, dv) = (slope(q, direction), slope(v, direction));
            let du: [S::Scalar; K] = u.map(|u| u.slopes().nth(direction).unwrap_or(S::Scalar::zero()));
            let dt = t.slopes().nth(direction).unwrap_or(S::Scalar::zero());
            let parameter = direction.checked_sub(2 * N);
            let force = core::array::from_fn(|i| {
                let by_state = along(&variation.by_q[i], &dq) + along(&variation.by_v[i], &dv);
                let by_rest = variation.by_t[i] * dt + along(&variation.by_u[i], &du);
                by_state + by_rest + parameter.map_or(S::Scalar::zero(), |p| by_p.forces[i][p])
            });
            let condition = core::array::from_fn(|c| {
                let by_state =
                    along(&variation.conditions_by_q[c], &dq) + along(&variation.conditions_by_v[c], &dv);
                let by_parameter = parameter.map_or(S::Scalar::zero(), |p| by_p.conditions[c][p]);
                -(by_state + variation.conditions_by_t[c] * dt + by_parameter)
            });
            set_slope(&mut accelerations, direction, &saddle.solve(&force, &condition).0);
        }
        accelerations
    }

    fn check_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
    ) -> Result<(), Cause> {
        let state = plain(&State { t, q: *q, v: *v });
        self.system.check_at(constants, state.t, &state.q, &state.v)
    }

    fn check_start_at(
        &self,
        constants: &Self::Constants,
        start: &State<Self::Scalar, N>,
    ) -> Result<(), Cause> {
        self.system.check_start_at(constants, &plain(start))
    }

    fn project_at(
        &self,
        constants: &Self::Constants,
        state: &mut State<Self::Scalar, N>,
    ) -> Result<(), Cause> {
        if C == 0 {
            return Ok(());
        }
        let mut values = plain(state);
        self.system.project_at(constants, &mut values)?;
        for (x, value) in state.q.iter_mut().zip(values.q).chain(state.v.iter_mut().zip(values.v)) {
            x.value = value;
        }
        self.along_constraints(constants, state)
    }

    #[inline]
    fn energy_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
    ) -> Self::Scalar {
        let state = plain(&State { t, q: *q, v: *v });
        Varied::constant(self.system.energy_at(constants, state.t, &state.q, &state.v))
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const P: usize> VariationalMotion<'_, S, N, K, C, P>
where
    S: Sensitive<N, K, C, P>,
    S::Scalar: Ordered,
{
    /// Tolerated local error of the motion; see [`Simulation::with_tolerance`].
    #[must_use]
    pub fn with_tolerance(self, tolerance: S::Scalar) -> Self {
        Self { simulation: self.simulation.with_tolerance(Varied::constant(tolerance)) }
    }

    /// Holds these inputs.
    #[must_use]
    pub fn with_inputs(self, inputs: [S::Scalar; K]) -> Self {
        Self { simulation: self.simulation.with_inputs(inputs.map(Varied::constant)) }
    }

    /// Goes on to time `t` \[s].
    ///
    /// # Errors
    /// Why and when the motion cannot go on; it stays at its last good state.
    pub fn advance_to(
        &mut self,
        t: S::Scalar,
    ) -> Result<Transition<S::Scalar, N, P>, MotionError<S::Scalar>> {
        match self.simulation.advance_to(Varied::constant(t)) {
            Ok(state) => Ok(state.into()),
            Err(error) => Err(MotionError { cause: error.cause, t: error.t.value }),
        }
    }

    /// The state with its derivatives.
    #[must_use]
    pub fn transition(&self) -> Transition<S::Scalar, N, P> {
        self.simulation.state().into()
    }
}
