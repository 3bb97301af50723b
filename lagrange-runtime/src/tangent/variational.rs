//! The motion together with its derivatives by the start and by parameters: the variational equations
//! δq̈ = (∂a/∂q) δq + (∂a/∂v) δv + ∂a/∂p (Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.,
//! § I.14).
//!
//! They are never written down. The system runs on numbers that carry their derivatives ([`Dual`]), so that its own method, of
//! its own order, gives the derivatives of what it computes: of Taylor series, of multipliers, of projections. Steps follow the
//! errors of the derivatives as they follow those of the motion.

use nalgebra::SMatrix;

use super::Sensitive;
use crate::error::MotionError;
use crate::integrator::adaptive::Steps;
use crate::real::{Dual, Ordered, Real};
use crate::simulation::{Held, Simulation};
use crate::state::State;
use crate::system::System;

/// A system whose states carry their derivatives by `N` initial coordinates, `N` initial velocities and `P` parameters.
#[derive(Clone, Copy, Debug)]
pub struct Variational<
    S: Sensitive<N, K, C, P, D>,
    const N: usize,
    const K: usize,
    const C: usize,
    const P: usize,
    const D: usize,
> {
    system: S::Over<Dual<S::Scalar, D>>,
}

/// A motion with derivatives as an ordinary motion.
type Carrying<'a, R, T, const N: usize, const K: usize, const D: usize> =
    Simulation<'a, T, Held<Dual<R, D>, K>, <T as System<N, K>>::Method, N, K>;

/// On the heap where there is one: the tables of a Taylor series are 2`N` + `P` + 1 times as large as those of the motion.
#[cfg(feature = "std")]
type Place<T> = std::boxed::Box<T>;
#[cfg(not(feature = "std"))]
type Place<T> = T;

fn placed<T>(content: T) -> Place<T> {
    #[cfg(feature = "std")]
    return Place::new(content);
    #[cfg(not(feature = "std"))]
    return content;
}

/// A motion with its derivatives, by the method of the system, [`Jets`](crate::Jets) or [`Dop853`](crate::Dop853).
pub struct VariationalMotion<
    'a,
    S,
    const N: usize,
    const K: usize,
    const C: usize,
    const P: usize,
    const D: usize,
> where
    S: Sensitive<N, K, C, P, D>,
    S::Scalar: Ordered,
{
    simulation: Place<Carrying<'a, S::Scalar, S::Over<Dual<S::Scalar, D>>, N, K, D>>,
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

impl<R: Real, const N: usize, const P: usize> Transition<R, N, P> {
    /// From directions in the order of [`seeded`].
    fn of<const D: usize>(state: &State<Dual<R, D>, N>) -> Self {
        let State { t, q, v } = state;
        let slope = |x: &Dual<R, D>, direction: usize| x.slopes.get(direction).copied().unwrap_or(R::zero());
        Self {
            state: State { t: t.value, q: q.map(|q| q.value), v: v.map(|v| v.value) },
            q_by_q: SMatrix::from_fn(|i, j| slope(&q[i], j)),
            q_by_v: SMatrix::from_fn(|i, j| slope(&q[i], N + j)),
            v_by_q: SMatrix::from_fn(|i, j| slope(&v[i], j)),
            v_by_v: SMatrix::from_fn(|i, j| slope(&v[i], N + j)),
            q_by_p: SMatrix::from_fn(|i, j| slope(&q[i], 2 * N + j)),
            v_by_p: SMatrix::from_fn(|i, j| slope(&v[i], 2 * N + j)),
        }
    }

    /// An entry of the state-transition matrix, 2`N` × 2`N`, coordinates before velocities; zero outside.
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> R {
        let block = match (row < N, column < N) {
            (true, true) => &self.q_by_q,
            (true, false) => &self.q_by_v,
            (false, true) => &self.v_by_q,
            (false, false) => &self.v_by_v,
        };
        let within = |i: usize| if i < N { i } else { i - N };
        block.get((within(row), within(column))).copied().unwrap_or(R::zero())
    }
}

/// A state that varies with its coordinates in the first `N` directions and with its velocities in the next.
fn seeded<R: Real, const N: usize, const D: usize>(start: &State<R, N>) -> State<Dual<R, D>, N> {
    State {
        t: Dual::constant(start.t),
        q: core::array::from_fn(|i| Dual::variable(start.q[i], i)),
        v: core::array::from_fn(|i| Dual::variable(start.v[i], N + i)),
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const P: usize, const D: usize>
    Variational<S, N, K, C, P, D>
where
    S: Sensitive<N, K, C, P, D>,
    S::Scalar: Ordered,
{
    /// The system with derivatives.
    pub(super) fn new(system: &S) -> Self {
        const { assert!(D == 2 * N + P, "directions: initial coordinates, initial velocities, parameters") };
        Self {
            system: system.over(|value, parameter| match parameter {
                Some(parameter) => Dual::variable(value, 2 * N + parameter),
                None => Dual::constant(value),
            }),
        }
    }

    /// A motion from a state, with inputs at zero. Of a constrained system the derivatives at the start are those of the
    /// nearest consistent state, so that every column obeys the constraints.
    ///
    /// # Errors
    /// What is wrong with the constraints at the start.
    pub fn motion(
        &self,
        start: State<S::Scalar, N>,
    ) -> Result<VariationalMotion<'_, S, N, K, C, P, D>, MotionError<S::Scalar>> {
        let mut varied = seeded(&start);
        if C > 0 {
            let failed = |cause| MotionError { cause, t: start.t };
            let constants = self.system.constants();
            self.system.check_start_at(&constants, &varied).map_err(failed)?;
            self.system.project_at(&constants, &mut varied).map_err(failed)?;
        }
        Ok(VariationalMotion { simulation: placed(Simulation::new(&self.system, varied)) })
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const P: usize, const D: usize>
    VariationalMotion<'_, S, N, K, C, P, D>
where
    S: Sensitive<N, K, C, P, D>,
    S::Scalar: Ordered,
{
    /// Tolerated local error of the motion and of its derivatives, relative to the size of each component; see
    /// [`Simulation::with_tolerance`].
    #[must_use]
    pub fn with_tolerance(mut self, tolerance: S::Scalar) -> Self {
        self.simulation.limit(|limits| {
            (limits.relative, limits.absolute) = (Dual::constant(tolerance), None);
        });
        self
    }

    /// Tolerated local error of a component y: `absolute` + `relative` · |y|. In a column of derivatives `absolute` is relative
    /// to its largest component: columns are solutions of linear equations, which have no scale.
    #[must_use]
    pub fn with_tolerances(mut self, relative: S::Scalar, absolute: S::Scalar) -> Self {
        self.simulation.limit(|limits| {
            (limits.relative, limits.absolute) = (Dual::constant(relative), Some(Dual::constant(absolute)));
        });
        self
    }

    /// Longest step \[s]; see [`Simulation::with_step_limit`].
    #[must_use]
    pub fn with_step_limit(mut self, longest: S::Scalar) -> Self {
        self.simulation.limit(|limits| limits.step = Some(Dual::constant(longest)));
        self
    }

    /// Steps that one call of `advance_to` may take, rejected ones included.
    #[must_use]
    pub fn with_max_steps(mut self, steps: u64) -> Self {
        self.simulation.limit(|limits| limits.attempts = steps);
        self
    }

    /// Holds these inputs.
    #[must_use]
    pub fn with_inputs(mut self, inputs: [S::Scalar; K]) -> Self {
        self.set_inputs(inputs);
        self
    }

    /// Holds these inputs from here on.
    pub fn set_inputs(&mut self, inputs: [S::Scalar; K]) {
        self.simulation.set_inputs(inputs.map(Dual::constant));
    }

    /// Goes on to time `t` \[s], forward or backward.
    ///
    /// # Errors
    /// Why and when the motion or a derivative cannot go on; it stays at its last good state.
    pub fn advance_to(
        &mut self,
        t: S::Scalar,
    ) -> Result<Transition<S::Scalar, N, P>, MotionError<S::Scalar>> {
        match self.simulation.advance_to(Dual::constant(t)) {
            Ok(state) => Ok(Transition::of(state)),
            Err(error) => Err(MotionError { cause: error.cause, t: error.t.value }),
        }
    }

    /// The state with its derivatives.
    #[must_use]
    pub fn transition(&self) -> Transition<S::Scalar, N, P> {
        Transition::of(self.simulation.state())
    }

    /// What the motion has cost so far.
    #[must_use]
    pub fn steps(&self) -> Steps {
        self.simulation.steps()
    }
}
