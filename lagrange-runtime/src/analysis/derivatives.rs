//! [`Derivatives`]: what follows from the derivatives of the equations of motion.

use super::{
    Equilibrium, EquilibriumError, InverseDynamics, LinearModel, Parametric, Response, Sensitivities,
    Tangent, equilibrium, inverse_dynamics, linear_model, response, sensitive,
};
#[cfg(feature = "std")]
use super::{Mode, blur, modes};
use crate::number::real::Ordered;
use crate::system::System;
use crate::system::error::MotionError;
use crate::system::linearized::{Jacobians, Linearized, jacobians};
use crate::system::state::State;

/// What follows from the derivatives of the equations, of any system whose attribute asks for them.
///
/// Each method names the derivatives that it needs. They are generated for `jacobians` in the attribute, and
/// those by parameters for `sensitivities`, of a system without contacts and dry friction. Where they are
/// missing the compiler says so, and what to do instead.
pub trait Derivatives<const N: usize, const K: usize = 0>: System<N, K> {
    /// ∂a/∂q, ∂a/∂v and ∂a/∂u at a state under the inputs `u`: M⁻¹ times the derivatives of r at the
    /// accelerations there.
    ///
    /// # Errors
    /// A singular mass matrix, or a value that is not finite.
    fn jacobians(
        &self,
        state: &State<Self::Scalar, N>,
        u: &[Self::Scalar; K],
    ) -> Result<Jacobians<Self::Scalar, N, K>, MotionError<Self::Scalar>>
    where
        Self: Linearized<N, K> + Sized,
    {
        jacobians(self, state, u)
    }

    /// Derivatives of accelerations and multipliers by coordinates, velocities, time and inputs.
    ///
    /// # Errors
    /// A singular mass matrix or constraints without a solution, with the time; a value that is not finite.
    #[inline]
    fn response<const C: usize>(
        &self,
        state: &State<Self::Scalar, N>,
        u: &[Self::Scalar; K],
    ) -> Result<Response<Self::Scalar, N, K, C>, MotionError<Self::Scalar>>
    where
        Self: Tangent<N, K, C> + Sized,
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
    fn equilibrium<const C: usize>(
        &self,
        guess: impl Into<State<Self::Scalar, N>>,
        u: &[Self::Scalar; K],
    ) -> Result<Equilibrium<Self::Scalar, N, C>, EquilibriumError>
    where
        Self: Tangent<N, K, C> + Sized,
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
    /// found, and its stability is
    /// [`Undecided`](super::Stability::Undecided). All else is as for
    /// [`equilibrium`](Self::equilibrium).
    ///
    /// # Errors
    /// [`EquilibriumError`]: constraints that cannot be met or that move, a negative mass, a coordinate with
    /// too few digits, forces that fade on the way, or no equilibrium in reach.
    #[inline]
    fn stationary_point<const C: usize>(
        &self,
        guess: impl Into<State<Self::Scalar, N>>,
        u: &[Self::Scalar; K],
    ) -> Result<Equilibrium<Self::Scalar, N, C>, EquilibriumError>
    where
        Self: Tangent<N, K, C> + Sized,
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
    fn linearize<const C: usize>(
        &self,
        state: &State<Self::Scalar, N>,
        u: &[Self::Scalar; K],
    ) -> Result<LinearModel<Self::Scalar, N, K>, MotionError<Self::Scalar>>
    where
        Self: Tangent<N, K, C> + Sized,
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
    fn modes<const C: usize>(
        &self,
        state: &State<Self::Scalar, N>,
        u: &[Self::Scalar; K],
    ) -> Result<std::vec::Vec<Mode<N>>, MotionError<Self::Scalar>>
    where
        Self: Tangent<N, K, C> + Sized,
        Self::Scalar: Ordered + Into<f64>,
    {
        let model = linear_model::linearize(self, state, u, true)?;
        let blur = blur::blur(self, state, u, &model);
        modes::modes(&model, &blur).map_err(|cause| MotionError { cause, t: state.t })
    }

    /// The generalized forces that a motion with accelerations `a` needs, with all inputs at zero: M a − f,
    /// and the part of them that the constraints cannot bear.
    ///
    /// # Errors
    /// A singular mass matrix under constraints, or constraints without a solution, with the time; a value
    /// that is not finite.
    #[inline]
    fn inverse_dynamics<const C: usize>(
        &self,
        state: &State<Self::Scalar, N>,
        a: &[Self::Scalar; N],
    ) -> Result<InverseDynamics<Self::Scalar, N, C>, MotionError<Self::Scalar>>
    where
        Self: Tangent<N, K, C> + Sized,
    {
        inverse_dynamics::inverse_dynamics(self, state, a)
    }

    /// Derivatives of accelerations and multipliers by the parameters at a fixed state.
    ///
    /// # Errors
    /// A singular mass matrix or constraints without a solution, with the time; a value that is not finite.
    fn sensitivities<const C: usize, const P: usize>(
        &self,
        state: &State<Self::Scalar, N>,
        u: &[Self::Scalar; K],
    ) -> Result<Sensitivities<Self::Scalar, N, C, P>, MotionError<Self::Scalar>>
    where
        Self: Parametric<N, K, C, P> + Sized,
    {
        sensitive::sensitivities(self, state, u)
    }
}

impl<S: System<N, K>, const N: usize, const K: usize> Derivatives<N, K> for S {}
