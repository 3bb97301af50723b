//! Derivatives by parameters.

use nalgebra::SMatrix;

use super::response::{Factored, columns, factored};
use super::{Place, Tangent, Variational};
use crate::number::real::{Ordered, Real};
use crate::system::System;
use crate::system::error::{Cause, MotionError};
use crate::system::state::State;

/// Derivatives by `P` parameters; rows are equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByParameters<R, const N: usize, const C: usize, const P: usize> {
    /// ∂r/∂p of r = f + Aᵀλ − M a at given accelerations and multipliers.
    pub forces: [[R; P]; N],
    /// ∂(A a − γ)/∂p.
    pub conditions: [[R; P]; C],
    /// ∂f/∂p of the holonomic constraints, zero for the others.
    pub positions: [[R; P]; C],
    /// ∂w/∂p, where w = df/dt of the holonomic constraints and g of the others.
    pub rates: [[R; P]; C],
}

impl<R: Real, const N: usize, const C: usize, const P: usize> ByParameters<R, N, C, P> {
    /// Zeros, for generated code to fill in.
    #[inline]
    #[must_use]
    pub fn zero() -> Self {
        let zero = R::zero();
        Self {
            forces: [[zero; P]; N],
            conditions: [[zero; P]; C],
            positions: [[zero; P]; C],
            rates: [[zero; P]; C],
        }
    }
}

/// Derivatives of accelerations a and multipliers λ by parameters; a column each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensitivities<R, const N: usize, const C: usize, const P: usize> {
    /// ∂a/∂p.
    pub accelerations: SMatrix<R, N, P>,
    /// ∂λ/∂p.
    pub multipliers: SMatrix<R, C, P>,
}

/// A system whose motions have derivatives by the start and by the `P` parameters that its attribute lists as
/// `sensitivities` (`P` may be zero), in `D` directions at once; `C` counts constraints, contacts and
/// frictions.
#[diagnostic::on_unimplemented(
    message = "the derivatives of the motions of `{Self}` are not generated",
    label = "this needs `jacobians`, and `sensitivities = […]` for derivatives by parameters",
    note = "say so in the attribute: `#[lagrangian(coordinates = […], sensitivities = [self.mass])]`"
)]
pub trait Sensitive<
    const N: usize,
    const K: usize = 0,
    const C: usize = 0,
    const P: usize = 0,
    const D: usize = 0,
>: System<N, K>
{
    /// The parameters in the order of all columns, as they are written.
    const PARAMETERS: [&'static str; P];

    /// The same equations over another scalar.
    type Over<R: Real>: System<N, K, Scalar = R> + Copy + core::fmt::Debug;

    /// The system with each parameter replaced by a number of another scalar, such as [`Dual`](crate::Dual).
    /// `parameter` makes it from the value and, for those of [`Sensitive::PARAMETERS`], the index there.
    ///
    /// Whatever takes a system takes the result: `simulate`, steppers, batches. So derivatives by any
    /// combination of start and parameters are motions like others. So are second ones, by duals of duals,
    /// where there are no contacts, friction or kinks.
    fn over<R: Real>(&self, parameter: impl FnMut(Self::Scalar, Option<usize>) -> R) -> Self::Over<R>;

    /// The system with states that carry their derivatives by the start and by the parameters: its
    /// [`motion`](Variational::motion) has the state-transition matrix.
    fn variational(&self) -> Variational<'_, Self, N, K, C, P, D>
    where
        Self: Sized,
        Self::Scalar: Ordered,
    {
        Variational::new(self)
    }
}

/// A system whose equations have derivatives by the `P` parameters that its attribute lists as
/// `sensitivities`.
#[diagnostic::on_unimplemented(
    message = "the derivatives of the equations of `{Self}` by parameters are not generated",
    label = "this needs `sensitivities = […]`, and a system without contacts and dry friction",
    note = "say so in the attribute: `#[lagrangian(coordinates = […], sensitivities = [self.mass])]`",
    note = "a system with contacts or dry friction has derivatives of its motions alone, by `variational`"
)]
pub trait Parametric<const N: usize, const K: usize = 0, const C: usize = 0, const P: usize = 0>:
    Tangent<N, K, C>
{
    /// Derivatives of the equations by the parameters.
    fn by_parameters_at(
        &self,
        constants: &Self::Constants,
        place: &Place<'_, Self::Scalar, N, K, C>,
    ) -> ByParameters<Self::Scalar, N, C, P>;
}

/// The method of `Derivatives`.
pub(super) fn sensitivities<S, const N: usize, const K: usize, const C: usize, const P: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Result<Sensitivities<S::Scalar, N, C, P>, MotionError<S::Scalar>>
where
    S: Parametric<N, K, C, P>,
{
    let constants = system.constants();
    let Factored { balance, saddle, .. } = factored(system, &constants, state, u)?;
    let State { t, q, v } = state;
    let place = Place { t: *t, q, v, a: &balance.accelerations, multipliers: &balance.multipliers, u };
    let by_p = system.by_parameters_at(&constants, &place);
    let (accelerations, multipliers) = columns(&saddle, &by_p.forces, &by_p.conditions);
    if accelerations.iter().chain(&multipliers).all(|x| x.is_finite()) {
        Ok(Sensitivities { accelerations, multipliers })
    } else {
        Err(MotionError { cause: Cause::NotFinite, t: *t })
    }
}
