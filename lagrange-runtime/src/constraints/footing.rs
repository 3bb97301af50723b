//! How well the constraints determine a state: how independent they are there, and how well the state is
//! known.

use super::residuals::Level;
use super::retraction::{From, Retraction, slopes};
use super::{Equations, Surface};
use crate::linear::{Gradients, Independence, SaddlePoint};
use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::error::Cause;
use crate::system::footing::Footing;
use crate::system::state::{State, difference};

/// Rows may depend on each other on the constraints if their distance is at most this many times the way to
/// the constraints, relative to the coordinates.
const BESIDE: f64 = 16.0;

/// Moves the end of a step onto the constraints, as [`project`](super::project) does, and tells how well they
/// determine the state. With `inputs` the factors of the retraction give the accelerations as well.
///
/// # Errors
/// The constraint that stays violated or contradicts others, [`Cause::Undetermined`], [`Cause::NotFinite`].
#[inline]
pub fn land<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    state: &mut State<S::Scalar, N>,
    inputs: Option<&[S::Scalar; K]>,
) -> Result<Footing<S::Scalar, N>, Cause>
where
    S: Surface<N, K, C>,
{
    let reached = *state;
    let residuals = system.residuals_at(state.t, &state.q, &state.v);
    let (mut accelerations, mut ulps_a) = (None, [num_traits::Zero::zero(); N]);
    let mut retraction = match inputs {
        Some(inputs) => {
            let equations = system.equations_at(constants, state.t, &state.q, &state.v, inputs);
            let balance = equations.balance();
            if balance.independence.is_clear() {
                accelerations = Some(balance.accelerations);
            }
            let Equations { saddle, gradients, forces, .. } = equations;
            let borne = gradients.borne(&balance.multipliers);
            let retraction = Retraction::with(state, residuals, (saddle, gradients));
            let ulps = array(|i| S::Scalar::epsilon() * (forces[i].abs() + borne[i]));
            ulps_a = retraction.metric.accelerated(&ulps);
            retraction
        }
        None => Retraction::new(system, state, residuals),
    };
    if !residuals.are_roundings() {
        retraction.level(system, Level::Positions, From::Near)?;
        retraction.level(system, Level::Velocities, From::Near)?;
        *state = retraction.state;
    }
    // Rows that depend on each other on the constraints are independent beside them.
    if !retraction.is_known_from(&reached) {
        retraction.refresh(system);
    }
    slopes(system, state);
    let ulps = |level| retraction.metric.ulps(retraction.extent(level));
    Ok(Footing {
        independence: retraction.independence(system),
        accelerations,
        ulps_q: ulps(Level::Positions),
        ulps_v: ulps(Level::Velocities),
        ulps_a,
        metric: retraction.metric,
    })
}

impl<S, const N: usize, const K: usize, const C: usize> Retraction<S, N, K, C>
where
    S: Surface<N, K, C>,
{
    /// Whether the rows are as independent as the factors say. The factors are those of a state that was
    /// `reached` beside the constraints. The rows must be clearly independent, by more than the way from
    /// there can have contributed.
    fn is_known_from(&self, reached: &State<S::Scalar, N>) -> bool {
        // One row depends on no other.
        if C == 1 {
            return true;
        }
        let independence = self.saddle.independence();
        let way = self.metric.extent(&difference(&reached.q, &self.state.q)) / self.extent(Level::Positions);
        // There is no way at the origin.
        let excess = S::Scalar::from_f64(BESIDE) * way - independence.least;
        independence.is_clear() && !excess.is_positive()
    }

    /// How well the constraints determine the state.
    ///
    /// The factors know how close rows are to each other, and the gradients how close they are to vanishing.
    /// If either is close, the independence is measured. Rounding errors of the constraint functions move the
    /// coordinates by ε/σ. The gradients then change, which moves the velocities by ε/σ², with a σ that is
    /// relative to how fast the gradients change. So the relative change of the velocities tells σ, whether a
    /// row comes close to others or vanishes.
    fn independence(&self, system: &S) -> Independence<S::Scalar> {
        let mut independence = self.nearness();
        if !independence.are_far_apart() {
            self.measure(system, &mut independence);
        }
        independence
    }

    /// Corrects the independence by the effect of rounding errors of the constraint functions.
    #[cold]
    #[inline(never)]
    fn measure(&self, system: &S, independence: &mut Independence<S::Scalar>) {
        let ulp = S::Scalar::epsilon();
        let turned = self.turned(system);
        let relative = self.metric.extent(&turned) / self.extent(Level::Velocities);
        independence.least = self.saddle.independence().least;
        // At rest nothing turns.
        if relative.is_positive() {
            independence.least = independence.least.min((ulp / relative).sqrt());
        }
    }
}
