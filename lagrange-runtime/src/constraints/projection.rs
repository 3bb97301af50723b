//! Back onto the constraints after a step.

use super::extent::Extent;
use super::noise::Noise;
use super::{Residuals, Surface, magnitude, moved, worst};
use crate::error::{Cause, Magnitude};
use crate::linear::SaddlePoint;
use crate::real::Real;
use crate::state::State;

/// A residual of so many roundings of its summands is none.
pub(super) const ROUNDINGS: f64 = 4.0;

/// Roundings of inner operations, in units of the summands.
pub(crate) const INNER: f64 = 4096.0;

/// Corrections before a projection is given up.
const CORRECTIONS: usize = 16;

/// With a contraction worse than this the factors are made anew.
const CONTRACTION: f64 = 0.1;

/// A correction that is larger than the residual by more than this, both relative to the state, may be made of noise.
const SUSPICIOUS: f64 = 256.0;

/// Moves a state near the constraints onto them. The factors of M and A where it starts serve all corrections, because
/// these are small.
///
/// # Errors
/// The constraint that stays violated.
#[inline]
pub fn project<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &mut State<S::Scalar, N>,
) -> Result<(), Cause>
where
    S: Surface<N, K, C>,
{
    let residuals = system.residuals_at(state.t, &state.q, &state.v);
    if !residuals.are_roundings() {
        correct(system, state, residuals)?;
    }
    // Every correction makes good one order of derivatives where the values obey the constraints already.
    for _ in 0..S::Scalar::DEPTH {
        along(system, state);
    }
    Ok(())
}

/// Moves the derivatives of a state on the constraints onto their tangent space, and leaves its values: one correction of each
/// level is linear in the derivatives.
#[cold]
fn along<S, const N: usize, const K: usize, const C: usize>(system: &S, state: &mut State<S::Scalar, N>)
where
    S: Surface<N, K, C>,
{
    let none = [num_traits::Zero::zero(); N];
    for of_positions in [true, false] {
        let (saddle, _) = system.saddle_at(state.t, &state.q, &state.v);
        let residuals = system.residuals_at(state.t, &state.q, &state.v);
        let lack = residuals.level(of_positions).0.map(|residual| residual.part(0) - residual);
        let (change, _) = saddle.solve(&none, &lack);
        let numbers = if of_positions { &mut state.q } else { &mut state.v };
        for (number, change) in numbers.iter_mut().zip(change) {
            *number += change - change.part(0);
        }
    }
}

/// Newton's corrections: of the coordinates, then of the velocities.
fn correct<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &mut State<S::Scalar, N>,
    first: Residuals<S::Scalar, C>,
) -> Result<(), Cause>
where
    S: Surface<N, K, C>,
{
    let number = S::Scalar::from_f64;
    let none = [num_traits::Zero::zero(); N];
    let suspicious = <S::Scalar as Real>::Lane::from_f64(SUSPICIOUS);
    let contraction = <S::Scalar as Real>::Lane::from_f64(CONTRACTION);
    let (mut saddle, mut gradients) = system.saddle_at(state.t, &state.q, &state.v);
    let (mut next, mut residuals) = (*state, first);
    for of_positions in [true, false] {
        let arrived = Extent::of(&saddle, if of_positions { &next.q } else { &next.v });
        let mut sizes = arrived.sizes(&saddle, &gradients);
        let mut settled = residuals.level_is_roundings(of_positions);
        for _ in 0..CORRECTIONS {
            if settled {
                break;
            }
            let before = residuals.relative(of_positions, &sizes);
            let last = residuals.are_roundings_beside(of_positions, number(ROUNDINGS), &sizes);
            let lack = residuals.level(of_positions).0.map(|value| -value);
            let mut is_noise = false;
            let (mut change, _) = saddle.solve(&none, &lack);
            let step = Extent::of(&saddle, &change).size().largest();
            if step > suspicious * before * arrived.size().largest() {
                let noise = Noise::of(system, &next, &saddle, &gradients, &residuals, of_positions);
                is_noise = noise.explains(&residuals, of_positions, &saddle);
                // Of rows that depend on each other only some are noise.
                if is_noise && (saddle.rank() == C || !of_positions) {
                    settled = true;
                    break;
                }
                (change, _) = saddle.solve(&none, &noise.damped(&saddle, &lack, arrived));
            }
            let (q, v) = if of_positions { (&change, &none) } else { (&none, &change) };
            next = moved(&next, q, v, num_traits::One::one());
            if !next.is_finite() {
                break;
            }
            residuals = system.residuals_at(next.t, &next.q, &next.v);
            let extent = Extent::of(&saddle, if of_positions { &next.q } else { &next.v });
            sizes = arrived.max(extent).sizes(&saddle, &gradients);
            let after = residuals.relative(of_positions, &sizes);
            // A correction of roundings leaves roundings, and where one makes nothing better there is no better state in
            // this arithmetic.
            let stalled =
                after >= before && residuals.are_roundings_beside(of_positions, number(INNER), &sizes);
            settled = last || stalled || is_noise || residuals.level_is_roundings(of_positions);
            if after >= contraction * before {
                (saddle, gradients) = system.saddle_at(next.t, &next.q, &next.v);
            }
        }
        if !settled
            && !Noise::of(system, &next, &saddle, &gradients, &residuals, of_positions).explains(
                &residuals,
                of_positions,
                &saddle,
            )
        {
            return Err(residuals.cause(of_positions, &Extent::unit().sizes(&saddle, &gradients)));
        }
    }
    *state = next;
    Ok(())
}

impl<R: Real, const C: usize> Residuals<R, C> {
    /// Whether nothing is left but roundings.
    #[inline(always)]
    pub(super) fn are_roundings(&self) -> bool {
        self.level_is_roundings(true) && self.level_is_roundings(false)
    }

    /// Whether nothing is left of one level but roundings of its summands.
    #[inline(always)]
    pub(crate) fn level_is_roundings(&self, of_positions: bool) -> bool {
        let (values, sizes) = self.level(of_positions);
        let tolerance = R::from_f64(ROUNDINGS) * R::epsilon();
        // By pairs: an index would be tested against its bounds, and a firmware link the panic.
        values.iter().zip(sizes).all(|(&value, &size)| is_within(value, tolerance * size))
    }

    /// Whether nothing is left of one level but so many roundings of its summands, or roundings of the state. Their number
    /// is a scalar, not a double that would be converted at run time.
    pub(crate) fn are_roundings_beside(&self, of_positions: bool, roundings: R, by_state: &[R; C]) -> bool {
        let (values, sizes) = self.level(of_positions);
        let (own, whole) = (roundings * R::epsilon(), R::from_f64(ROUNDINGS) * R::epsilon());
        let sizes = sizes.iter().zip(by_state);
        values
            .iter()
            .zip(sizes)
            .all(|(&value, (&size, &by_state))| is_within(value, own * size + whole * by_state))
    }

    /// The constraint that the state is furthest from, in units of the kinetic metric.
    #[cold]
    pub(crate) fn cause(&self, of_positions: bool, slopes: &[R; C]) -> Cause {
        let (values, _) = self.level(of_positions);
        let (constraint, _) = worst::<R, C>(|c| relative(values[c], slopes[c]));
        let by = values.get(constraint).map_or(Magnitude(0.0), |value| magnitude(value.abs().largest()));
        if of_positions {
            Cause::PositionViolated { constraint, by }
        } else {
            Cause::VelocityViolated { constraint, by }
        }
    }

    /// The largest residual of one level, relative to its own size and to that of the state.
    pub(crate) fn relative(&self, of_positions: bool, by_state: &[R; C]) -> R::Lane {
        let (values, sizes) = self.level(of_positions);
        worst::<R, C>(|c| relative(values[c], sizes[c] + by_state[c])).1
    }

    /// The residuals of one level and their own sizes.
    #[inline(always)]
    pub(super) fn level(&self, of_positions: bool) -> (&[R; C], &[R; C]) {
        if of_positions { (&self.positions, &self.position_sizes) } else { (&self.rates, &self.rate_sizes) }
    }
}

/// |value| / size; zero for zero.
fn relative<R: Real>(value: R, size: R) -> R::Lane {
    // Beside the smallest number a zero size divides nothing by zero.
    (value.abs() / (size + R::from_f64(f64::MIN_POSITIVE))).largest()
}

/// Whether a value is no larger than a tolerance in any lane; false for NaN.
#[inline(always)]
pub(super) fn is_within<R: Real>(value: R, tolerance: R) -> bool {
    let excess = value.abs() - tolerance;
    excess.is_finite() && excess.largest() <= num_traits::Zero::zero()
}
