//! Constraints at run time: multipliers and reactions, starts that satisfy them, and projection back onto
//! them.
//!
//! The equations of a constrained motion are differentiated, so a numerical motion obeys the derivatives of
//! the constraints and drifts off the constraints themselves. After every step the state is moved back by the
//! smallest change in the metric of the mass matrix, coordinates first (f = 0), then velocities (df/dt = 0
//! and g = 0): Hairer and Wanner, *Solving Ordinary Differential Equations II*, VII.2; Lubich et al., *MEXX*,
//! 1992.

mod apart;
mod footing;
mod residuals;
mod retraction;
#[cfg(test)]
pub(crate) mod samples;
mod solution;
mod stages;
mod start;
mod tangential;

use core::ops::Deref;

use crate::linear::{Independence, Pattern, SaddlePoint};
use crate::number::real::Real;
use crate::system::System;
pub use crate::system::footing::Footing;
pub use crate::system::metric::Metric;
use crate::system::state::State;
pub use apart::land_apart;
pub use footing::land;
pub(crate) use residuals::Level;
pub use residuals::Residuals;
pub use retraction::project;
pub use solution::{check, finite, forces, independence, is_singular, matrix, regular};
pub use stages::accelerations;
pub(crate) use stages::settled_state;
pub(crate) use start::check_near;
pub use start::{begin, consistent, sound};
pub use tangential::tangential;

/// A system with constraints.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no constraints",
    label = "there are no reactions in this system",
    note = "a function with the role `#[holonomic]` or `#[nonholonomic]` makes one"
)]
pub trait Constrained<const N: usize, const K: usize = 0>: System<N, K> {
    /// The multipliers, a field for each constraint.
    type Reactions: Copy + core::fmt::Debug;

    /// The multipliers at a state under the inputs `u`; NaN or infinite where the equations have no solution.
    fn reactions_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
    ) -> Reactions<Self::Reactions>;
}

/// Multipliers λ of all constraints, by name. The generalized force of a constraint f is λ ∂f/∂q, with f as
/// it is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reactions<T> {
    multipliers: T,
    unique: bool,
}

impl<T> Reactions<T> {
    /// Multipliers, and whether the motion determines them.
    #[inline]
    pub fn new(multipliers: T, unique: bool) -> Self {
        Self { multipliers, unique }
    }

    /// Whether the motion determines each multiplier. Where constraints are redundant it does not: it
    /// determines the total force alone, and the multipliers are those of least Σ λ².
    #[inline]
    pub fn are_unique(&self) -> bool {
        self.unique
    }
}

impl<T> Deref for Reactions<T> {
    type Target = T;

    #[inline]
    fn deref(&self) -> &T {
        &self.multipliers
    }
}

/// Accelerations with multipliers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balance<R, const N: usize, const C: usize> {
    /// a.
    pub accelerations: [R; N],
    /// λ.
    pub multipliers: [R; C],
    /// How independent the constraints are.
    pub independence: Independence<R>,
}

/// The equations of a constrained motion at a state: M a − Aᵀλ = forces, A a = γ.
#[derive(Clone, Copy, Debug)]
pub struct Equations<P: SaddlePoint<R, N, C>, R, const N: usize, const C: usize> {
    /// The factors of M and A.
    pub saddle: P,
    /// A, rows by constraint.
    pub gradients: P::Gradients,
    /// All forces except those of constraints, minus the bias.
    pub forces: [R; N],
    /// γ: the value of A a for which d²f/dt², or dg/dt of a nonholonomic constraint, vanishes.
    pub gamma: [R; C],
}

impl<P: SaddlePoint<R, N, C>, R: Real, const N: usize, const C: usize> Equations<P, R, N, C> {
    /// The solution of the equations; NaN if they have none.
    #[inline(always)]
    pub fn balance(&self) -> Balance<R, N, C> {
        let (mut accelerations, multipliers) = self.saddle.solve_motion(&self.forces, &self.gamma);
        if self.saddle.vanishing().is_some() || self.saddle.negative().is_some() {
            accelerations = [R::from_f64(f64::NAN); N];
        }
        Balance { accelerations, multipliers, independence: self.saddle.independence() }
    }
}

/// The equations and residuals that generated code gives for `C` scalar constraints.
pub trait Surface<const N: usize, const K: usize, const C: usize>: System<N, K> {
    /// The factors of M and A.
    type Saddle: SaddlePoint<Self::Scalar, N, C> + Clone;

    /// The places of A that can differ from zero, where most cannot.
    const PATTERN: &'static Pattern = &Pattern::NONE;

    /// Which constraints are holonomic.
    const HOLONOMIC: [bool; C] = [true; C];

    /// The equations at a state, factored.
    fn equations_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
    ) -> Equations<Self::Saddle, Self::Scalar, N, C>;

    /// Their solution.
    #[inline(always)]
    fn balance_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
    ) -> Balance<Self::Scalar, N, C> {
        self.equations_at(constants, t, q, v, u).balance()
    }

    /// How far a state is off the constraints.
    fn residuals_at(
        &self,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
    ) -> Residuals<Self::Scalar, C>;

    /// The factors of M and A, and A without the forces.
    fn saddle_at(
        &self,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
    ) -> Factors<Self, N, K, C>;
}

/// The factors of M and A, and A.
pub(crate) type Factors<S, const N: usize, const K: usize, const C: usize> = (
    <S as Surface<N, K, C>>::Saddle,
    <<S as Surface<N, K, C>>::Saddle as SaddlePoint<<S as System<N, K>>::Scalar, N, C>>::Gradients,
);

/// [`Surface::saddle_at`] where it is rarely asked for: one copy in a program, instead of one in each caller.
#[cold]
#[inline(never)]
fn factors<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
) -> Factors<S, N, K, C>
where
    S: Surface<N, K, C>,
{
    system.saddle_at(state.t, &state.q, &state.v)
}

/// The largest entry of an array, and where it is.
fn worst<R: Real, const C: usize>(values: impl Fn(usize) -> R::Lane) -> (usize, R::Lane) {
    let mut worst = (0, num_traits::Zero::zero());
    for c in 0..C {
        let value = values(c);
        if value > worst.1 {
            worst = (c, value);
        }
    }
    worst
}

/// The same state with changes of its coordinates and velocities.
fn moved<R: Real, const N: usize>(state: &State<R, N>, q: &[R; N], v: &[R; N], share: R) -> State<R, N> {
    let mut next = *state;
    for i in 0..N {
        next.q[i] = R::mul_add(share, q[i], next.q[i]);
        next.v[i] = R::mul_add(share, v[i], next.v[i]);
    }
    next
}
