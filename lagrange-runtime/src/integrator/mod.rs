//! Methods of integration. One method, one file; coefficients are data in `tableau`.
//!
//! A fixed-step method implements [`FixedStep`] and runs in a [`Stepper`](crate::Stepper). Dormand–Prince 8(5,3)
//! carries error control and dense output and runs in a [`Simulation`](crate::Simulation).

pub(crate) mod dense;
pub(crate) mod dop853;
mod rk4;
#[cfg(test)]
pub(crate) mod samples;
pub(crate) mod step_size;
mod tableau;

pub use rk4::Rk4;

use crate::error::{Cause, MotionError};
use crate::real::Real;
use crate::state::State;
use crate::system::System;

/// A method that takes steps of a size chosen by the caller. `default()` is its memory before the first step.
pub trait FixedStep<S: System<N, K>, const N: usize, const K: usize>: Default {
    /// The state after a step of `h` from `from`, with the inputs `u` held. The time of the result is `from.t + h`.
    ///
    /// # Errors
    /// The cause that the system reports at a stage. A result that is not finite is left to the caller.
    fn step(
        &mut self,
        system: &S,
        constants: &S::Constants,
        from: &State<S::Scalar, N>,
        h: S::Scalar,
        u: &[S::Scalar; K],
    ) -> Result<State<S::Scalar, N>, Cause>;
}

/// An error at `state`, with [`Cause::NotFinite`] where a NaN only looks like a singular matrix.
///
/// A factorisation stops at a NaN as it stops at a zero pivot, but the energy tells them apart.
#[cold]
pub(crate) fn diagnose<S: System<N, K>, const N: usize, const K: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    cause: Cause,
) -> MotionError<S::Scalar> {
    let finite = state.is_finite() && system.energy_at(constants, state.t, &state.q, &state.v).is_finite();
    let cause = match cause {
        Cause::SingularMassMatrix { .. } if !finite => Cause::NotFinite,
        other => other,
    };
    MotionError { cause, t: state.t }
}
