//! [`Tangent`]: the derivatives of the equations of motion with their constraints; and [`Derivatives`]: what
//! follows from them.
//!
//! With r = f + Aᵀλ − M a the equations of motion are r = 0 and A a − γ = 0. Generated code has the
//! derivatives of both at any given accelerations and multipliers, so that no inverse is differentiated;
//! everything else is here:
//!
//! | method | what it gives |
//! | --- | --- |
//! | [`Derivatives::response`] | derivatives of accelerations and multipliers |
//! | [`Derivatives::equilibrium`] | where the system comes to rest, and how stable that is |
//! | [`Derivatives::stationary_point`] | where it can rest, stable or not |
//! | [`Derivatives::linearize`] | M, C, G, K and ẋ = A x + B u about a state |
//! | [`Derivatives::modes`] | frequencies, damping ratios and shapes of small oscillations |
//! | [`Derivatives::inverse_dynamics`] | forces that a given motion needs |
//! | [`Derivatives::sensitivities`] | derivatives of accelerations and multipliers by parameters |
//! | [`Sensitive::variational`] | the motion with its derivatives by the start and by parameters |
//! | [`Variational::monodromy`] | Floquet multipliers of a periodic motion |
#[cfg(feature = "std")]
mod blur;
mod derivatives;
mod equilibrium;
pub mod inertia;
mod inverse_dynamics;
mod linear_model;
#[cfg(feature = "std")]
mod modes;
#[cfg(feature = "std")]
mod monodromy;
mod reduced;
mod response;
mod sensitive;
mod turning;
mod variational;
pub mod verify;

use crate::constraints::{Balance, Residuals};
use crate::linear::stored::Stored;
use crate::number::real::Real;
use crate::system::linearized::Linearized;
pub use derivatives::Derivatives;
pub use equilibrium::{Equilibrium, EquilibriumError, FoundBy, Stability};
pub use inverse_dynamics::InverseDynamics;
pub use linear_model::{Basis, LinearModel};
#[cfg(feature = "std")]
pub use modes::Mode;
#[cfg(feature = "std")]
pub use monodromy::Monodromy;
pub use reduced::{reduced, reduced_by_inputs, reduced_residual};
pub use response::Response;
pub use sensitive::{ByParameters, Parametric, Sensitive, Sensitivities};
pub use variational::{Transition, Variational, VariationalMotion};

/// r = f + Aᵀλ − M a, and A a − γ of the constraints: both zero on the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Imbalance<R, const N: usize, const C: usize> {
    /// r.
    pub forces: [R; N],
    /// A a − γ.
    pub conditions: [R; C],
}

/// M, A, and the derivatives of r = f + Aᵀλ − M a and of the constraints at given accelerations and
/// multipliers; rows are equations.
#[derive(Clone, Debug, PartialEq)]
pub struct Variation<R, const N: usize, const K: usize, const C: usize> {
    /// M = −∂r/∂a.
    pub mass: Stored<[[R; N]; N]>,
    /// ∂r/∂q.
    pub by_q: Stored<[[R; N]; N]>,
    /// ∂r/∂v.
    pub by_v: Stored<[[R; N]; N]>,
    /// ∂r/∂t.
    pub by_t: [R; N],
    /// ∂r/∂u.
    pub by_u: Stored<[[R; K]; N]>,
    /// A, so that ∂r/∂λ = Aᵀ.
    pub gradients: Stored<[[R; N]; C]>,
    /// ∂w/∂q, where w = df/dt of the holonomic constraints and g of the others; ∂w/∂v is A.
    pub rates_by_q: Stored<[[R; N]; C]>,
    /// ∂(A a − γ)/∂q.
    pub conditions_by_q: Stored<[[R; N]; C]>,
    /// ∂(A a − γ)/∂v.
    pub conditions_by_v: Stored<[[R; N]; C]>,
    /// ∂(A a − γ)/∂t.
    pub conditions_by_t: [R; C],
}

impl<R: Real, const N: usize, const K: usize, const C: usize> Variation<R, N, K, C> {
    /// Zeros, for generated code to fill in.
    #[inline]
    #[must_use]
    pub fn zero() -> Self {
        Self {
            mass: Stored::zeros(),
            by_q: Stored::zeros(),
            by_v: Stored::zeros(),
            by_t: [R::zero(); N],
            by_u: Stored::zeros(),
            gradients: Stored::zeros(),
            rates_by_q: Stored::zeros(),
            conditions_by_q: Stored::zeros(),
            conditions_by_v: Stored::zeros(),
            conditions_by_t: [R::zero(); C],
        }
    }
}

/// Where a generated function is evaluated: a state with accelerations `a`, multipliers and inputs.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a, R, const N: usize, const K: usize, const C: usize> {
    /// Time \[s].
    pub t: R,
    /// Coordinates.
    pub q: &'a [R; N],
    /// Velocities.
    pub v: &'a [R; N],
    /// Accelerations.
    pub a: &'a [R; N],
    /// Multipliers λ.
    pub multipliers: &'a [R; C],
    /// Inputs.
    pub u: &'a [R; K],
}

/// A system of `N` coordinates, `K` inputs and `C` scalar constraints whose attribute asks for `jacobians`.
/// [`Derivatives`] has what is done with them.
#[diagnostic::on_unimplemented(
    message = "the derivatives of the equations of `{Self}` are not generated",
    label = "this needs `jacobians`, and a system without contacts and dry friction",
    note = "say so in the attribute: `#[lagrangian(coordinates = […], jacobians)]`",
    note = "a system with contacts or dry friction has derivatives of its motions alone, by `variational`; ask a second type \
            that has no `unilateral` or `friction` functions for equilibria, linear models and modes"
)]
pub trait Tangent<const N: usize, const K: usize = 0, const C: usize = 0>: Linearized<N, K> {
    /// Which constraints are holonomic.
    const HOLONOMIC: [bool; C];

    /// Which constraints have a gradient that depends on time. That of f(q) − g(t) does not. Of a constraint
    /// on velocities the terms without velocities count as well.
    const TURNS: [bool; C];

    /// Accelerations and multipliers. NaN or infinite where the equations have no solution.
    fn balanced_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
    ) -> Balance<Self::Scalar, N, C>;

    /// How far a state is off the constraints.
    fn deviations_at(
        &self,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
    ) -> Residuals<Self::Scalar, C>;

    /// r and A a − γ.
    fn imbalance_at(
        &self,
        constants: &Self::Constants,
        place: &Place<'_, Self::Scalar, N, K, C>,
    ) -> Imbalance<Self::Scalar, N, C>;

    /// M, A, and the derivatives of r and of A a − γ.
    fn variation_at(
        &self,
        constants: &Self::Constants,
        place: &Place<'_, Self::Scalar, N, K, C>,
    ) -> Variation<Self::Scalar, N, K, C>;
}
