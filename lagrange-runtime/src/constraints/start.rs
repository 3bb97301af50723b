//! Where a motion may begin, and the nearest such state.

use super::Surface;
use super::extent::Extent;
use super::residuals::Level;
use super::retraction::{From, Retraction};
use super::solution::regular;
use crate::error::{Cause, MotionError};
use crate::linear::SaddlePoint;
use crate::real::Real;
use crate::state::State;

/// A start is good where what it violates is below this share of √ε of its numbers: as good as numbers written with nine
/// digits, or with five in single precision.
const SHARE: f64 = 1.0 / 16.0;

/// Whether a motion may begin at a state.
///
/// # Errors
/// The constraint that is violated, and constraints without a gradient.
#[cold]
pub fn check_start<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    start: &State<S::Scalar, N>,
) -> Result<(), Cause>
where
    S: Surface<N, K, C>,
{
    if !start.is_finite() {
        return Err(Cause::NotFinite);
    }
    let residuals = system.residuals_at(start.t, &start.q, &start.v);
    let (saddle, gradients) = system.saddle_at(start.t, &start.q, &start.v);
    regular(&saddle)?;
    let part = S::Scalar::from_f64(SHARE) * S::Scalar::epsilon().sqrt();
    let none = [num_traits::Zero::zero(); N];
    let nothing = [num_traits::Zero::zero(); C];
    for (level, numbers) in [(Level::Positions, &start.q), (Level::Velocities, &start.v)] {
        // A constraint such as z = 0 has no size of its own: the state has, in its numbers and in the kinetic metric.
        let by_state = Extent::of(&saddle, numbers).sizes(&saddle, &gradients);
        let is_small = || {
            let (change, _) = saddle.solve(&none, residuals.values(level));
            let largest = |values: &[S::Scalar; N]| {
                values.iter().fold(num_traits::Zero::zero(), |largest: S::Scalar, x| largest.max(x.abs()))
            };
            let excess = largest(&change) - part * largest(numbers);
            excess.is_finite() && excess.largest() <= num_traits::Zero::zero()
        };
        let good = residuals.is_within(level, part, &nothing)
            || residuals.is_within(level, part, &by_state) && is_small();
        if !good {
            return Err(residuals.cause(level, &Extent::unit().sizes(&saddle, &gradients)));
        }
    }
    Ok(())
}

/// A state on the constraints by Newton's method: coordinates, then velocities. Each correction is the shortest in the metric of
/// the mass matrix where it is made, so the coordinates are the nearest ones up to the square of the distance, and the
/// velocities the nearest of all at these coordinates.
///
/// # Errors
/// [`Cause::Contradictory`] where dependent constraints cannot be satisfied together, [`Cause::NoConsistentState`] where the
/// search ends before a solution, [`Cause::VanishingGradient`], [`Cause::SingularMassMatrix`], [`Cause::NotFinite`].
pub fn consistent<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    start: State<S::Scalar, N>,
) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>>
where
    S: Surface<N, K, C>,
{
    let failed = |cause| MotionError { cause, t: start.t };
    if !start.is_finite() {
        return Err(failed(Cause::NotFinite));
    }
    let residuals = system.residuals_at(start.t, &start.q, &start.v);
    let mut retraction = Retraction::new(system, &start, residuals);
    regular(&retraction.saddle).map_err(failed)?;
    for level in [Level::Positions, Level::Velocities] {
        retraction.level(system, level, From::Far).map_err(|cause| {
            failed(match cause {
                Cause::PositionViolated { constraint, .. } | Cause::VelocityViolated { constraint, .. }
                    if retraction.saddle.independence().rank < C =>
                {
                    Cause::Contradictory { constraint }
                }
                Cause::PositionViolated { constraint, by } | Cause::VelocityViolated { constraint, by } => {
                    Cause::NoConsistentState { constraint, by }
                }
                other => other,
            })
        })?;
    }
    Ok(retraction.state)
}
