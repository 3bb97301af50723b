//! [`Tangent`]: the derivatives of the equations of motion with their constraints, and what follows from
//! them.
//!
//! With r = f + Aᵀλ − M a the equations of motion are r = 0 and A a − γ = 0. Generated code has the
//! derivatives of both at any given accelerations and multipliers, so that no inverse is differentiated;
//! everything else is here:
//!
//! | method | what it gives |
//! | --- | --- |
//! | [`Tangent::response`] | derivatives of accelerations and multipliers |
//! | [`Tangent::equilibrium`] | where the system comes to rest, and how stable that is |
//! | [`Tangent::stationary_point`] | where it can rest, stable or not |
//! | [`Tangent::linearize`] | M, C, G, K and ẋ = A x + B u about a state |
//! | [`Tangent::modes`] | frequencies, damping ratios and shapes of small oscillations |
//! | [`Tangent::inverse_dynamics`] | forces that a given motion needs |
//! | [`Parametric::sensitivities`] | derivatives of accelerations and multipliers by parameters |
//! | [`Sensitive::variational`] | the motion with its derivatives by the start and by parameters |
//! | [`Variational::monodromy`] | Floquet multipliers of a periodic motion |
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
use crate::number::real::{Ordered, Real};
use crate::system::error::MotionError;
use crate::system::linearized::Linearized;
use crate::system::state::State;
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
#[diagnostic::on_unimplemented(
    message = "the derivatives of the equations of `{Self}` are not generated",
    label = "this needs `jacobians`",
    note = "say so in the attribute: `#[lagrangian(coordinates = […], jacobians)]`",
    note = "a system with contacts or dry friction has derivatives of its motions alone, by `variational`"
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

    /// Derivatives of accelerations and multipliers by coordinates, velocities, time and inputs.
    ///
    /// # Errors
    /// A singular mass matrix or constraints without a solution, with the time; a value that is not finite.
    #[inline]
    fn response(
        &self,
        state: &State<Self::Scalar, N>,
        u: &[Self::Scalar; K],
    ) -> Result<Response<Self::Scalar, N, K, C>, MotionError<Self::Scalar>>
    where
        Self: Sized,
    {
        response::response(self, state, u)
    }

    /// Where the system comes to rest from a guess, under steady inputs: coordinates q with f(t, q, 0, u) +
    /// Aᵀλ = 0 on the constraints, at a minimum of the potential energy downhill of the guess.
    ///
    /// By the principle of virtual work, f(t, q, 0, u) · δq = 0 for all δq that the constraints allow
    /// (Lanczos, *The Variational Principles of Mechanics*, chapter III); of the places where this holds
    /// a system with the least damping settles at a minimum of its potential energy. In rotating
    /// coordinates f contains the gradient of T₀, and the minima are those of V − T₀; forces of inputs
    /// count where they have a potential on the constraints, as forces of constant direction do.
    ///
    /// * Steps of trust regions lead down along forces and along negative curvature, and cross no hill; the
    ///   last digits are those of Newton's method (Nocedal and Wright, *Numerical Optimization*, 2nd ed.,
    ///   chapter 4).
    /// * A guess that is an equilibrium up to rounding is the answer, whatever its stability: π for the angle
    ///   of a pendulum means the top. From 3.14 it falls. [`stationary_point`](Self::stationary_point) finds
    ///   the top from there as well, and with it what only gyroscopic forces hold, like the triangular points
    ///   of Lagrange.
    /// * Where forces have no potential (followers, circulation), and under nonholonomic constraints, it is
    ///   the same as [`stationary_point`](Self::stationary_point); [`Equilibrium::found_by`] tells.
    ///
    /// The guess is a state, whose velocities do not count, or coordinates alone. It need not obey the
    /// constraints. Singular stiffness (a family of equilibria, a bifurcation) and redundant constraints
    /// do no harm.
    ///
    /// # Errors
    /// [`EquilibriumError`]: constraints that cannot be met or that move, a constraint whose gradient turns
    /// with time, a negative mass, a coordinate with too few digits, energy that falls without end, or no
    /// equilibrium in reach.
    #[inline]
    fn equilibrium(
        &self,
        guess: impl Into<State<Self::Scalar, N>>,
        u: &[Self::Scalar; K],
    ) -> Result<Equilibrium<Self::Scalar, N, C>, EquilibriumError>
    where
        Self: Sized,
        Self::Scalar: Ordered,
    {
        equilibrium::equilibrium(self, guess.into(), u).map_err(|error| error.named(&Self::NAMES))
    }

    /// An equilibrium near a guess, under steady inputs, of any stability: a minimum of the potential energy,
    /// a saddle, or a maximum. [`Equilibrium::stability`] tells which.
    ///
    /// Levenberg–Marquardt steps in the null space of A with exact derivatives. Nonholonomic constraints
    /// restrict δq by G δq = 0 but not the positions: with them equilibria come in families, and the one
    /// found is near the guess. Where the gradient of a constraint turns with time, the balance of forces is
    /// found, and its stability is [`Stability::Undecided`]. All else is as for
    /// [`equilibrium`](Self::equilibrium).
    ///
    /// # Errors
    /// [`EquilibriumError`]: constraints that cannot be met or that move, a negative mass, a coordinate with
    /// too few digits, forces that fade on the way, or no equilibrium in reach.
    #[inline]
    fn stationary_point(
        &self,
        guess: impl Into<State<Self::Scalar, N>>,
        u: &[Self::Scalar; K],
    ) -> Result<Equilibrium<Self::Scalar, N, C>, EquilibriumError>
    where
        Self: Sized,
        Self::Scalar: Ordered,
    {
        equilibrium::stationary_point(self, guess.into(), u).map_err(|error| error.named(&Self::NAMES))
    }

    /// The linear equations of small deviations from a state, or from the motion through it: mass, damping,
    /// gyroscopic and stiffness matrices, and ẋ = A x + B u + drift on the tangent space of the
    /// constraints.
    ///
    /// About a motion the matrices are those of this moment, and on constraints so is the basis: as the state
    /// moves on, both change.
    ///
    /// # Errors
    /// A singular mass matrix or constraints without a solution, with the time; a value that is not finite;
    /// [`Cause::PositionViolated`](crate::Cause::PositionViolated) or `VelocityViolated` for a state off the
    /// constraints; [`Cause::TurningConstraint`](crate::Cause::TurningConstraint), where the gradient of a
    /// constraint turns by itself.
    #[inline]
    fn linearize(
        &self,
        state: &State<Self::Scalar, N>,
        u: &[Self::Scalar; K],
    ) -> Result<LinearModel<Self::Scalar, N, K>, MotionError<Self::Scalar>>
    where
        Self: Sized,
        Self::Scalar: Ordered,
    {
        linear_model::linearize(self, state, u, false)
    }

    /// Natural frequencies, damping ratios and shapes of small oscillations about a state, in the order of
    /// frequencies.
    ///
    /// A conjugate pair of eigenvalues λ \[1/s] gives one mode. A real eigenvalue gives as many modes as its
    /// multiplicity, so critical damping gives two equal modes. λ = 0 is different: a free motion that
    /// nothing restores gives one mode for each independent shape, although it is a double root. Zeros are
    /// exact: an eigenvalue that rounding of the entries could have made of zero is zero. Parts of the system
    /// that do not act on each other are treated separately, each to its own precision.
    ///
    /// Where forces have a potential or do no work (no damping, symmetric stiffness, any gyroscopic forces),
    /// eigenvalues lie symmetrically about both axes. There a real part smaller than its own error is set to
    /// zero, so the state is stable, as far as linear equations tell, if `eigenvalue.re <= 0.0` for all
    /// modes.
    ///
    /// About a state that moves under constraints these are the eigenvalues of the linear equations frozen at
    /// that moment. In general they are not frequencies of a motion: describe such a state by coordinates in
    /// which it is at rest. The same holds without constraints where the linear equations change with time or
    /// along the motion. A constraint whose gradient turns with time, as that of a whirling hoop in
    /// coordinates of space, is refused. Deviations of an orientation are seen in axes that turn with the
    /// body, where a steady spin of a body about an axis of symmetry, or a free one about a principal axis,
    /// has equations that do not change.
    ///
    /// Golub and Van Loan, *Matrix Computations*, 4th ed., chapters 7 and 8.
    ///
    /// # Errors
    /// Those of [`linearize`](Self::linearize), and [`Cause::NoEigenvalues`](crate::Cause::NoEigenvalues).
    #[cfg(feature = "std")]
    #[inline]
    fn modes(
        &self,
        state: &State<Self::Scalar, N>,
        u: &[Self::Scalar; K],
    ) -> Result<std::vec::Vec<Mode<N>>, MotionError<Self::Scalar>>
    where
        Self: Sized,
        Self::Scalar: Ordered + Into<f64>,
    {
        let model = linear_model::linearize(self, state, u, true)?;
        modes::modes(&model).map_err(|cause| MotionError { cause, t: state.t })
    }

    /// The generalized forces that a motion with accelerations `a` needs, with all inputs at zero: M a − f,
    /// and the part of them that the constraints cannot bear.
    ///
    /// # Errors
    /// A singular mass matrix under constraints, or constraints without a solution, with the time; a value
    /// that is not finite.
    #[inline]
    fn inverse_dynamics(
        &self,
        state: &State<Self::Scalar, N>,
        a: &[Self::Scalar; N],
    ) -> Result<InverseDynamics<Self::Scalar, N, C>, MotionError<Self::Scalar>>
    where
        Self: Sized,
    {
        inverse_dynamics::inverse_dynamics(self, state, a)
    }
}
