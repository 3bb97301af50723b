//! Where a motion may begin, and the nearest such state.

use super::residuals::{Level, ULPS};
use super::retraction::{From, Retraction, project, slopes};
use super::solution::regular_at;
use super::{Metric, Residuals, Surface, factors};
use crate::linear::SaddlePoint;
use crate::number::elements::Each;
use crate::number::real::Real;
use crate::system::error::{Cause, MotionError};
use crate::system::metric::largest;
use crate::system::state::State;

/// The largest violation of a start, as a share of √ε of its numbers: 9e-10 of them, or 2e-5 in single
/// precision. So numbers that are written with ten digits are accepted, or with six in single precision.
pub(super) const SHARE: f64 = 1.0 / 16.0;

/// Begins a motion at a state. Refuses a state that violates constraints, and removes rounding errors from
/// any other.
///
/// A violation within the last digit of the coordinates is left alone: beside a configuration in which
/// constraints depend on each other, a retraction would turn such a digit into a large change.
///
/// # Errors
/// The constraint that is violated or contradicts others, what is wrong with masses or gradients, and
/// [`Cause::NotFinite`].
#[cold]
pub fn begin<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    start: &mut State<S::Scalar, N>,
) -> Result<(), Cause>
where
    S: Surface<N, K, C>,
{
    if !start.is_finite() {
        return Err(Cause::NotFinite);
    }
    let residuals = system.residuals_at(start.t, &start.q, &start.v);
    let mut retraction = Retraction::new(system, start, residuals);
    retraction.regular(system)?;
    let last_digits = last_digits(system, start, &residuals);
    let ulps = S::Scalar::from_f64(ULPS) * S::Scalar::epsilon();
    let is_off = |level| !residuals.is_within_apart(level, ulps, last_digits.sizes(level));
    let levels =
        [(Level::Positions, is_off(Level::Positions)), (Level::Velocities, is_off(Level::Velocities))];
    for (level, is_off) in levels {
        if is_off {
            // Where no state satisfies all constraints, another start does not help.
            check(&retraction, &residuals, level)
                .map_err(|cause| contradiction(system, start).err().unwrap_or(cause))?;
        }
    }
    let mut has_moved = false;
    for (level, is_off) in levels {
        // Coordinates that have moved change the velocities that belong to them.
        has_moved |= is_off;
        if has_moved {
            retraction.level(system, level, From::Near)?;
        }
    }
    *start = retraction.state;
    slopes(system, start);
    Ok(())
}

/// Checks that dependent constraints do not rule out a state on them near this one.
///
/// # Errors
/// [`Cause::Contradictory`].
#[cold]
pub(super) fn contradiction<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
) -> Result<(), Cause>
where
    S: Surface<N, K, C>,
{
    // One row contradicts no other.
    if C == 1 {
        return Ok(());
    }
    match project(system, &mut state.clone(), None) {
        Err(cause @ Cause::Contradictory { .. }) => Err(cause),
        _ => Ok(()),
    }
}

/// Whether all constraints have finite values at a state, and do not contradict each other there.
///
/// # Errors
/// [`Cause::NotFinite`], [`Cause::VanishingGradient`], [`Cause::SingularMassMatrix`],
/// [`Cause::Contradictory`].
#[inline]
pub fn sound<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
) -> Result<(), MotionError<S::Scalar>>
where
    S: Surface<N, K, C>,
{
    let residuals = system.residuals_at(state.t, &state.q, &state.v);
    let part = S::Scalar::from_f64(SHARE) * S::Scalar::epsilon().sqrt();
    let none = [num_traits::Zero::zero(); C];
    if [Level::Positions, Level::Velocities].into_iter().all(|level| residuals.is_within(level, part, &none))
    {
        return Ok(());
    }
    let all = residuals.positions.iter().chain(&residuals.rates).all(|x| x.is_finite());
    let found = if all || !state.is_finite() {
        contradiction(system, state)
    } else {
        let (saddle, gradients) = factors(system, state);
        Err(regular_at(system, state, (&saddle, &gradients)).err().unwrap_or(Cause::NotFinite))
    };
    found.map_err(|cause| MotionError { cause, t: state.t })
}

/// Checks that a state is near enough to the constraints for a start.
///
/// # Errors
/// The constraint that is violated.
#[cold]
#[inline(never)]
fn check<S, const N: usize, const K: usize, const C: usize>(
    at: &Retraction<S, N, K, C>,
    residuals: &Residuals<S::Scalar, C>,
    level: Level,
) -> Result<(), Cause>
where
    S: Surface<N, K, C>,
{
    let Retraction { state, saddle, slopes, metric, .. } = at;
    check_near(saddle, (metric, slopes), state, residuals, level).map_err(|cause| cause.named(&S::NAMES))
}

/// The same by the factors and slopes of the constraints, where their names are not known.
///
/// # Errors
/// The constraint that is violated, without its name.
pub(crate) fn check_near<R, M, const N: usize, const C: usize>(
    saddle: &M,
    (metric, slopes): (&Metric<R, N>, &[R; C]),
    state: &State<R, N>,
    residuals: &Residuals<R, C>,
    level: Level,
) -> Result<(), Cause>
where
    R: Real,
    M: SaddlePoint<R, N, C>,
{
    let part = R::from_f64(SHARE) * R::epsilon().sqrt();
    let numbers = if level == Level::Positions { &state.q } else { &state.v };
    // A constraint such as z = 0 has no size of its own: the state has, in its numbers and in the kinetic
    // metric.
    let by_state = slopes.each(|slope| slope * metric.extent(numbers));
    let is_small = || {
        let (change, _) = saddle.solve(&[R::zero(); N], residuals.values(level));
        let excess = largest(&change) - part * largest(numbers);
        excess.is_finite() && excess.largest() <= num_traits::Zero::zero()
    };
    if residuals.is_within_apart(level, part, &[R::zero(); C])
        || residuals.is_within_apart(level, part, &by_state) && is_small()
    {
        return Ok(());
    }
    Err(residuals.cause(level, slopes))
}

/// The effect of the last digits of the coordinates on the residuals, as scales whose ulp is that effect.
fn last_digits<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    residuals: &Residuals<S::Scalar, C>,
) -> Residuals<S::Scalar, C>
where
    S: Surface<N, K, C>,
{
    let ulp = S::Scalar::epsilon();
    let none = [num_traits::Zero::zero(); C];
    let mut sizes = Residuals { positions: none, position_sizes: none, rates: none, rate_sizes: none };
    for i in 0..N {
        let mut q = state.q;
        q[i] += ulp * q[i];
        let beside = system.residuals_at(state.t, &q, &state.v);
        for c in 0..C {
            sizes.position_sizes[c] += (beside.positions[c] - residuals.positions[c]).abs() / ulp;
            sizes.rate_sizes[c] += (beside.rates[c] - residuals.rates[c]).abs() / ulp;
        }
    }
    sizes
}

/// A state on the constraints by Newton's method: coordinates, then velocities. Each correction is the
/// shortest in the metric of the mass matrix where it is made, so the coordinates are the nearest ones up to
/// the square of the distance, and the velocities the nearest of all at these coordinates.
///
/// # Errors
/// [`Cause::Contradictory`] where dependent constraints cannot be satisfied together,
/// [`Cause::NoConsistentState`] where the search ends before a solution, [`Cause::VanishingGradient`],
/// [`Cause::SingularMassMatrix`], [`Cause::NotFinite`].
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
    retraction.regular(system).map_err(failed)?;
    let ulps = S::Scalar::from_f64(ULPS) * S::Scalar::epsilon();
    for level in [Level::Positions, Level::Velocities] {
        let Retraction { state, residuals, .. } = &retraction;
        if residuals.is_within(level, ulps, last_digits(system, state, residuals).sizes(level)) {
            continue;
        }
        retraction.level(system, level, From::Far).map_err(|cause| {
            failed(match cause {
                Cause::PositionViolated { constraint, name, .. }
                | Cause::VelocityViolated { constraint, name, .. }
                    if retraction.saddle.independence().rank < C =>
                {
                    Cause::Contradictory { constraint, name }
                }
                Cause::Undetermined { constraint, name } => Cause::Contradictory { constraint, name },
                Cause::PositionViolated { constraint, name, by }
                | Cause::VelocityViolated { constraint, name, by } => {
                    Cause::NoConsistentState { constraint, name, by }
                }
                other => other,
            })
        })?;
    }
    Ok(retraction.state)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::Saddle;

    /// The check of a start at x = 1 with this z, under the constraint z = 0, where x has this mass.
    fn check_of(mass: f64, z: f64) -> Result<(), Cause> {
        let rows = [[0.0, 1.0]];
        let saddle = Saddle::factor(&[[mass, 0.0], [0.0, 1.0]], &rows);
        let (metric, state) = (Metric::of(&saddle), State::new([1.0, z], [0.0; 2]));
        let residuals =
            Residuals { positions: [z], position_sizes: [z.abs()], rates: [0.0], rate_sizes: [0.0] };
        check_near(&saddle, (&metric, &metric.slopes(&rows)), &state, &residuals, Level::Positions)
    }

    #[test]
    fn a_start_may_violate_constraints_in_its_last_digits() {
        let share = SHARE * f64::EPSILON.sqrt();
        assert!(check_of(1.0, 0.9 * share).is_ok() && check_of(1.0, 1.1 * share).is_err());
        // A heavy body does not hide that a light one is off.
        assert!(check_of(1e12, 0.9 * share).is_ok() && check_of(1e12, 1.1 * share).is_err());
        // Nor is a light body measured by itself, in its own metric.
        assert!(check_of(1e-12, 0.9e-6 * share).is_ok() && check_of(1e-12, 1.1e-6 * share).is_err());
    }
}
