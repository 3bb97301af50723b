//! Methods of integration. One method, one file; coefficients are data in `tableau`.
//!
//! A fixed-step method implements [`FixedStep`] and runs in a [`Stepper`](crate::Stepper). Dormand–Prince
//! 8(5,3) carries error control and dense output and runs in a [`Simulation`](crate::Simulation).

pub(crate) mod adaptive;
pub(crate) mod dense;
pub(crate) mod dop853;
mod gauss;
mod jet;
pub(crate) mod jets;
pub(crate) mod landing;
mod lengths;
mod rk4;
#[cfg(test)]
pub(crate) mod samples;
mod slopes;
mod splitting;
pub(crate) mod step_size;
mod tableau;
mod terms;

pub use adaptive::{Adaptive, Dop853};
pub use gauss::{Gauss, Gauss4, Gauss6, Gauss8, LastStep};
pub use jet::Jet;
pub use jets::Jets;
pub use rk4::Rk4;
pub use splitting::{
    BlanesMoan, BlanesMoan4, BlanesMoan6, LastSplit, Leapfrog, Yoshida, Yoshida4, Yoshida6, Yoshida8,
};
pub use step_size::Limits;
pub use terms::Terms;

use crate::error::Cause;
use crate::real::Real;
use crate::state::State;
use crate::system::System;

/// A method that takes steps of a size chosen by the caller.
pub trait FixedStep<S: System<N, K>, const N: usize, const K: usize> {
    /// What the method remembers between steps. It belongs to one system with its constants. It survives
    /// failed steps and changes of the inputs, so a method checks whether it still applies.
    type Memory: Copy + core::fmt::Debug;

    /// The memory before the first step.
    fn begin(system: &S) -> Self::Memory;

    /// The state after a step of `h` from `from`, with the inputs `u` held. The time of the result is `from.t
    /// + h`. A result that is not finite is left to the caller.
    ///
    /// # Errors
    /// Why the equations of an implicit method could not be solved.
    fn step(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        from: &State<S::Scalar, N>,
        h: S::Scalar,
        u: &[S::Scalar; K],
    ) -> Result<State<S::Scalar, N>, Cause>;
}

/// The right-hand side of q″ = a(t, q, v).
pub(crate) trait Field<R, const N: usize> {
    /// a(t, q, v). NaN or infinite where the equations have no solution.
    fn accelerations(&self, t: R, q: &[R; N], v: &[R; N]) -> [R; N];
    /// Why it is not finite there.
    fn cause(&self, t: R, q: &[R; N], v: &[R; N]) -> Cause;
    /// The part of a change of coordinates or velocities along the constraints at a state.
    fn along(&self, _state: &State<R, N>, change: [R; N]) -> [R; N] {
        change
    }
}

/// Why the motion fails at a state.
#[cold]
pub(crate) fn diagnose<S: System<N, K>, const N: usize, const K: usize>(
    system: &S,
    constants: &S::Constants,
    t: S::Scalar,
    q: &[S::Scalar; N],
    v: &[S::Scalar; N],
) -> Cause {
    if q.iter().chain(v).all(|x| x.is_finite()) && t.is_finite() {
        system.check_at(constants, t, q, v).err().unwrap_or(Cause::NotFinite).named(&S::NAMES)
    } else {
        Cause::NotFinite
    }
}
