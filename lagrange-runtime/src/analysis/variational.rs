//! The motion together with its derivatives by the start and by parameters: the variational equations
//! δq̈ = (∂a/∂q) δq + (∂a/∂v) δv + ∂a/∂p (Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations
//! I*, 2nd ed., § I.14).
//!
//! They are never written down. The system runs on numbers that carry their derivatives ([`Dual`]), so that
//! its own method, of its own order, gives the derivatives of what it computes: of Taylor series, of
//! multipliers, of projections. Steps follow the errors of the derivatives as they follow those of the
//! motion.
//!
//! Through impacts, dry friction and kinks the time of each switch is differentiated as well
//! (`switching/saltation.rs`).
//!
//! A few directions are carried at once, and the motion is repeated for the others. So the memory is that of
//! a few motions, whatever the size of the system.

use nalgebra::SMatrix;

use super::Sensitive;
use crate::motion::simulation::Simulation;
use crate::number::elements::{Each, array};
use crate::number::real::{Dual, Ordered, Real};
use crate::system::System;
use crate::system::attitude::beside;
use crate::system::control::Held;
use crate::system::error::MotionError;
use crate::system::method::Steps;
use crate::system::state::State;

/// A system whose states carry their derivatives by `N` initial coordinates, `N` initial velocities and `P`
/// parameters, `D` of these at once.
#[derive(Clone, Copy, Debug)]
pub struct Variational<
    'a,
    S: Sensitive<N, K, C, P, D>,
    const N: usize,
    const K: usize,
    const C: usize,
    const P: usize,
    const D: usize,
> {
    system: &'a S,
    /// The system of the first pass.
    first: Varied<S, N, K, C, P, D>,
}

/// A system over dual numbers, and its motion by its own method.
type Varied<S, const N: usize, const K: usize, const C: usize, const P: usize, const D: usize> =
    <S as Sensitive<N, K, C, P, D>>::Over<Dual<<S as System<N, K>>::Scalar, D>>;
type Pass<'a, T, const N: usize, const K: usize> =
    Simulation<'a, T, Held<<T as System<N, K>>::Scalar, K>, <T as System<N, K>>::Method, N, K>;

/// On the heap if there is one. With D directions the tables of a Taylor series are D + 1 times as large as
/// those of the motion alone.
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

/// A motion with its derivatives, by the method of the system: [`Jets`](crate::Jets) or
/// [`Dop853`](crate::Dop853), with contacts or dry friction the one that follows switches by these.
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
    system: &'a S,
    /// The first pass. The others start anew in each call.
    simulation: Place<Pass<'a, Varied<S, N, K, C, P, D>, N, K>>,
    transition: Transition<S::Scalar, N, P>,
    /// The counts of the other passes.
    counts: Steps,
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
    /// A state that varies with itself.
    fn at(state: State<R, N>) -> Self {
        let (one, zero) = (SMatrix::from_fn(unit), SMatrix::from_fn(|_, _| R::zero()));
        let none = SMatrix::from_fn(|_, _| R::zero());
        Self { state, q_by_q: one, q_by_v: zero, v_by_q: zero, v_by_v: one, q_by_p: none, v_by_p: none }
    }

    /// The state with the directions from `first` on.
    pub(super) fn varied<const D: usize>(&self, first: usize) -> State<Dual<R, D>, N> {
        let with = |value: R, row: usize| Dual { value, slopes: array(|i| self.slope(row, first + i)) };
        let State { t, q, v } = &self.state;
        State { t: Dual::constant(*t), q: array(|i| with(q[i], i)), v: array(|i| with(v[i], N + i)) }
    }

    /// Takes a state and its directions from `first` on.
    pub(super) fn take<const D: usize>(&mut self, first: usize, state: &State<Dual<R, D>, N>) {
        let State { t, q, v } = state;
        self.state = State { t: t.value, q: q.each(|q| q.value), v: v.each(|v| v.value) };
        for (row, x) in state.q.iter().chain(&state.v).enumerate() {
            for (column, &slope) in (first..2 * N + P).zip(&x.slopes) {
                if let Some(entry) = self.slope_mut(row, column) {
                    *entry = slope;
                }
            }
        }
    }

    /// An entry of the state-transition matrix, 2`N` × 2`N`, coordinates before velocities; zero outside.
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> R {
        if column < 2 * N { self.slope(row, column) } else { R::zero() }
    }

    /// An entry of all columns, those of parameters last; zero outside.
    fn slope(&self, row: usize, column: usize) -> R {
        let (of, i) = split::<N>(row);
        let found = match (of, split::<N>(column)) {
            (0, (0, j)) => self.q_by_q.get((i, j)),
            (0, (1, j)) => self.q_by_v.get((i, j)),
            (0, (_, j)) => self.q_by_p.get((i, j)),
            (1, (0, j)) => self.v_by_q.get((i, j)),
            (1, (1, j)) => self.v_by_v.get((i, j)),
            (1, (_, j)) => self.v_by_p.get((i, j)),
            _ => None,
        };
        found.copied().unwrap_or(R::zero())
    }

    fn slope_mut(&mut self, row: usize, column: usize) -> Option<&mut R> {
        let (of, i) = split::<N>(row);
        match (of, split::<N>(column)) {
            (0, (0, j)) => self.q_by_q.get_mut((i, j)),
            (0, (1, j)) => self.q_by_v.get_mut((i, j)),
            (0, (_, j)) => self.q_by_p.get_mut((i, j)),
            (1, (0, j)) => self.v_by_q.get_mut((i, j)),
            (1, (1, j)) => self.v_by_v.get_mut((i, j)),
            (1, (_, j)) => self.v_by_p.get_mut((i, j)),
            _ => None,
        }
    }
}

/// Coordinates, velocities or what comes after them, and the index among these.
fn split<const N: usize>(index: usize) -> (usize, usize) {
    let kind = (index / N.max(1)).min(2);
    (kind, index - kind * N)
}

fn unit<R: Real>(i: usize, j: usize) -> R {
    if i == j { R::one() } else { R::zero() }
}

/// The system in the pass that begins with the direction `first`.
fn over<S, const N: usize, const K: usize, const C: usize, const P: usize, const D: usize>(
    system: &S,
    first: usize,
) -> Varied<S, N, K, C, P, D>
where
    S: Sensitive<N, K, C, P, D>,
{
    system.over(|value, parameter| match parameter.and_then(|listed| (2 * N + listed).checked_sub(first)) {
        Some(direction) => Dual::variable(value, direction),
        None => Dual::constant(value),
    })
}

impl<'a, S, const N: usize, const K: usize, const C: usize, const P: usize, const D: usize>
    Variational<'a, S, N, K, C, P, D>
where
    S: Sensitive<N, K, C, P, D>,
    S::Scalar: Ordered,
{
    /// The system with derivatives.
    pub(super) fn new(system: &'a S) -> Self {
        Self { system, first: over(system, 0) }
    }

    /// A motion from a state, with inputs at zero. Of a constrained system the derivatives at the start are
    /// those of the nearest consistent state, so that every column obeys the constraints; likewise of a
    /// system with contacts on those that are closed.
    ///
    /// # Errors
    /// What is wrong with constraints, contacts or frictions at the start.
    pub fn motion(
        &self,
        start: State<S::Scalar, N>,
    ) -> Result<VariationalMotion<'_, S, N, K, C, P, D>, MotionError<S::Scalar>> {
        let free = Transition::<_, N, P>::at(start);
        let mut transition = free;
        if <Varied<S, N, K, C, P, D> as System<N, K>>::SWITCHED {
            for first in passes::<N, P, D>() {
                let system = over(self.system, first);
                let mut pass: Place<Pass<'_, Varied<S, N, K, C, P, D>, N, K>> =
                    placed(Simulation::new(&system, free.varied(first)));
                transition.take(first, pass.settled().map_err(without_slopes)?);
            }
        } else if C > 0 {
            let failed = |cause| MotionError { cause, t: start.t };
            for first in passes::<N, P, D>() {
                let (system, mut varied) = (over(self.system, first), free.varied(first));
                let constants = system.constants();
                system.begin_at(&constants, &mut varied).map_err(failed)?;
                transition.take(first, &varied);
            }
        }
        let simulation = placed(Simulation::new(&self.first, transition.varied(0)));
        Ok(VariationalMotion { system: self.system, simulation, transition, counts: Steps::default() })
    }
}

/// An error of a motion of numbers with derivatives.
fn without_slopes<R: Real, const D: usize>(error: MotionError<Dual<R, D>>) -> MotionError<R> {
    MotionError { cause: error.cause, t: error.t.value }
}

/// The first direction of each pass.
pub(super) fn passes<const N: usize, const P: usize, const D: usize>() -> impl Iterator<Item = usize> {
    (0..2 * N + P).step_by(D.max(1))
}

impl<S, const N: usize, const K: usize, const C: usize, const P: usize, const D: usize>
    VariationalMotion<'_, S, N, K, C, P, D>
where
    S: Sensitive<N, K, C, P, D>,
    S::Scalar: Ordered,
{
    /// Tolerated local error of the motion and of its derivatives, relative to the size of each component;
    /// see [`Simulation::with_tolerance`].
    #[must_use]
    pub fn with_tolerance(mut self, tolerance: S::Scalar) -> Self {
        let limits = self.simulation.limits();
        (limits.relative, limits.absolute) = (Dual::constant(tolerance), None);
        self
    }

    /// Tolerated local error of a component y: `absolute` + `relative` · |y|. In a column of derivatives
    /// `absolute` is relative to its largest component: columns are solutions of linear equations, which
    /// have no scale.
    #[must_use]
    pub fn with_tolerances(mut self, relative: S::Scalar, absolute: S::Scalar) -> Self {
        let limits = self.simulation.limits();
        (limits.relative, limits.absolute) = (Dual::constant(relative), Some(Dual::constant(absolute)));
        self
    }

    /// Longest step \[s]; see [`Simulation::with_step_limit`].
    #[must_use]
    pub fn with_step_limit(mut self, longest: S::Scalar) -> Self {
        self.simulation.limits().step = Some(Dual::constant(longest));
        self
    }

    /// Steps that one call of `advance_to` may take, rejected ones included, for each `D` directions.
    #[must_use]
    pub fn with_max_steps(mut self, steps: u64) -> Self {
        self.simulation.limits().attempts = steps;
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
        self.simulation.set_inputs(inputs.each(Dual::constant));
    }

    /// Goes on to time `t` \[s], forward or backward.
    ///
    /// # Errors
    /// Why and when the motion or a derivative cannot go on. [`VariationalMotion::transition`] is then that
    /// before the call.
    pub fn advance_to(
        &mut self,
        t: S::Scalar,
    ) -> Result<Transition<S::Scalar, N, P>, MotionError<S::Scalar>> {
        let mut next = self.transition;
        for first in passes::<N, P, D>() {
            if first == 0 {
                next.take(first, self.simulation.advance_to(Dual::constant(t)).map_err(without_slopes)?);
                continue;
            }
            let system = over(self.system, first);
            let start = self.transition.varied(first);
            let mut pass: Place<Pass<'_, Varied<S, N, K, C, P, D>, N, K>> =
                placed(Simulation::new(&system, start));
            pass.set_inputs(self.simulation.inputs());
            *pass.limits() = *self.simulation.limits();
            let value = next.state;
            let end = pass.advance_to(Dual::constant(t)).map_err(without_slopes)?;
            next.take(first, &beside(S::ORIENTATIONS, end, &value, |x| x.value));
            next.state = value;
            let Steps { accepted, rejected, evaluations } = pass.steps();
            self.counts.accepted += accepted;
            self.counts.rejected += rejected;
            self.counts.evaluations += evaluations;
        }
        self.transition = next;
        Ok(next)
    }

    /// The state with its derivatives: the last one reached without error.
    #[must_use]
    pub fn transition(&self) -> Transition<S::Scalar, N, P> {
        self.transition
    }

    /// The cost of the motion so far: each `D` directions take steps of their own.
    #[must_use]
    pub fn steps(&self) -> Steps {
        let (first, others) = (self.simulation.steps(), self.counts);
        Steps {
            accepted: first.accepted + others.accepted,
            rejected: first.rejected + others.rejected,
            evaluations: first.evaluations + others.evaluations,
        }
    }
}
