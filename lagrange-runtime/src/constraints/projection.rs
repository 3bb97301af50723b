//! Back onto the constraints after a step.

use super::{Residuals, Surface, moved, to_f64, worst};
use crate::error::Cause;
use crate::linear::SaddlePoint;
use crate::real::Real;
use crate::state::State;

/// A residual of so many roundings of its summands is none.
const ROUNDINGS: f64 = 4.0;

/// A residual of so many may be roundings of inner operations.
const INNER: f64 = 4096.0;

/// Corrections before a projection is given up.
const CORRECTIONS: usize = 16;

/// With a contraction worse than this the factors are made anew.
const CONTRACTION: f64 = 0.1;

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
    if residuals.are_roundings() {
        return Ok(());
    }
    correct(system, state, residuals)
}

/// Newton's corrections.
fn correct<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &mut State<S::Scalar, N>,
    first: Residuals<S::Scalar, C>,
) -> Result<(), Cause>
where
    S: Surface<N, K, C>,
{
    let none = [num_traits::Zero::zero(); N];
    let contraction = <S::Scalar as Real>::Lane::from_f64(CONTRACTION);
    let (mut saddle, _) = system.saddle_at(state.t, &state.q, &state.v);
    let (mut next, mut residuals) = (*state, first);
    for _ in 0..CORRECTIONS {
        let of_positions = !residuals.positions_are_roundings();
        let before = residuals.size(of_positions);
        if of_positions {
            let (change, _) = saddle.solve(&none, &residuals.positions.map(|f| -f));
            next = moved(&next, &change, &none, num_traits::One::one());
        } else {
            let (change, _) = saddle.solve(&none, &residuals.rates.map(|w| -w));
            next = moved(&next, &none, &change, num_traits::One::one());
        }
        if !next.is_finite() {
            break;
        }
        residuals = system.residuals_at(next.t, &next.q, &next.v);
        if residuals.are_roundings() {
            *state = next;
            return Ok(());
        }
        if of_positions && !residuals.positions_are_roundings() || !of_positions {
            let after = residuals.size(of_positions);
            if after >= before && residuals.are_near() {
                // No better state in this arithmetic.
                *state = next;
                return Ok(());
            }
            if after >= contraction * before {
                saddle = system.saddle_at(next.t, &next.q, &next.v).0;
            }
        }
    }
    Err(residuals.cause())
}

impl<R: Real, const C: usize> Residuals<R, C> {
    /// Whether nothing is left but roundings.
    #[inline(always)]
    pub(super) fn are_roundings(&self) -> bool {
        self.positions_are_roundings() && within(&self.rates, &self.rate_sizes, ROUNDINGS)
    }

    /// Whether nothing is left of f = 0 but roundings.
    #[inline(always)]
    pub(crate) fn positions_are_roundings(&self) -> bool {
        within(&self.positions, &self.position_sizes, ROUNDINGS)
    }

    /// Whether what is left may be roundings of inner operations.
    pub(crate) fn are_near(&self) -> bool {
        self.positions_are_near() && within(&self.rates, &self.rate_sizes, INNER)
    }

    /// The same of f = 0.
    pub(crate) fn positions_are_near(&self) -> bool {
        within(&self.positions, &self.position_sizes, INNER)
    }

    /// The largest residual relative to its summands.
    pub(crate) fn size(&self, of_positions: bool) -> R::Lane {
        let (values, sizes) = self.pick(of_positions);
        worst::<R, C>(|c| relative(values[c], sizes[c])).1
    }

    fn pick(&self, of_positions: bool) -> (&[R; C], &[R; C]) {
        if of_positions { (&self.positions, &self.position_sizes) } else { (&self.rates, &self.rate_sizes) }
    }

    /// The constraint that is violated most.
    #[cold]
    pub(crate) fn cause(&self) -> Cause {
        let of_positions = !self.positions_are_roundings();
        let (values, sizes) = self.pick(of_positions);
        let (constraint, _) = worst::<R, C>(|c| relative(values[c], sizes[c]));
        let by = values.get(constraint).map_or(0.0, |value| to_f64(value.abs().largest()));
        if of_positions {
            Cause::PositionViolated { constraint, by }
        } else {
            Cause::VelocityViolated { constraint, by }
        }
    }
}

/// |value| / size; zero for zero.
fn relative<R: Real>(value: R, size: R) -> R::Lane {
    // Beside the smallest number a zero size divides nothing by zero.
    (value.abs() / (size + R::from_f64(f64::MIN_POSITIVE))).largest()
}

/// Whether all values are within so many roundings of their sizes; false for NaN.
#[inline(always)]
fn within<R: Real, const C: usize>(values: &[R; C], sizes: &[R; C], roundings: f64) -> bool {
    let tolerance = R::from_f64(roundings) * R::epsilon();
    (0..C).all(|c| {
        let excess = values[c].abs() - tolerance * sizes[c];
        excess.is_finite() && excess.largest() <= num_traits::Zero::zero()
    })
}
