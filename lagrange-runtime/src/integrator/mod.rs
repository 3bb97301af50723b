//! Methods of integration. One method, one file; coefficients are data in `tableau`.
//!
//! A fixed-step method implements [`FixedStep`] and runs in a [`Stepper`](crate::Stepper). A method with
//! error control and dense output implements [`Adaptive`] and runs in a [`Simulation`](crate::Simulation):
//! [`Jets`], Taylor series for smooth systems, and [`Dop853`], Dormand–Prince 8(5,3).

pub(crate) mod adaptive;
pub(crate) mod agreement;
pub(crate) mod beside;
pub(crate) mod dense;
pub(crate) mod dop853;
mod gauss;
pub(crate) mod hidden;
mod jet;
pub(crate) mod jets;
pub(crate) mod landing;
pub(crate) mod lengths;
mod rk4;
#[cfg(test)]
pub(crate) mod samples;
mod slopes;
mod splitting;
pub(crate) mod step_size;
mod tableau;
pub(crate) mod vanishing;

pub use adaptive::Dop853;
pub use gauss::{Gauss, Gauss4, Gauss6, Gauss8, LastStep};
pub use jet::Jet;
pub use jets::Jets;
pub use rk4::Rk4;
pub use splitting::{
    BlanesMoan, BlanesMoan4, BlanesMoan6, LastSplit, Leapfrog, Yoshida, Yoshida4, Yoshida6, Yoshida8,
};

use crate::system::error::Cause;
pub use crate::system::limits::Limits;
pub use crate::system::method::{Adaptive, FixedStep, Terms};
use crate::system::state::State;
use slopes::Slope;

/// The right-hand side of q″ = a(t, q, v).
pub(crate) trait Field<R, const N: usize> {
    /// a(t, q, v). NaN or infinite where the equations have no solution.
    fn accelerations(&self, t: R, q: &[R; N], v: &[R; N]) -> [R; N];
    /// Why it is not finite there.
    fn cause(&self, t: R, q: &[R; N], v: &[R; N]) -> Cause;
    /// The part of a change of coordinates and velocities along the constraints at a state.
    fn along(&self, _state: &State<R, N>, change: Slope<R, N>) -> Slope<R, N> {
        change
    }
}
