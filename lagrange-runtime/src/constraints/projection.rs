//! Back onto the constraints after a step.

use super::{Residuals, Surface, magnitude, moved, worst};
use crate::error::{Cause, Magnitude};
use crate::linear::SaddlePoint;
use crate::real::Real;
use crate::state::State;

/// A residual of so many roundings of its summands is none.
const ROUNDINGS: f64 = 4.0;

/// Corrections before a projection is given up.
const CORRECTIONS: usize = 16;

/// Roundings of inner operations are below so many of the whole.
const INNER: f64 = 4096.0;

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
    let inner = S::Scalar::from_f64(INNER) * S::Scalar::epsilon();
    let contraction = <S::Scalar as Real>::Lane::from_f64(CONTRACTION);
    let (mut saddle, mut gradients) = system.saddle_at(state.t, &state.q, &state.v);
    let (mut next, mut residuals) = (*state, first);
    for _ in 0..CORRECTIONS {
        let of_positions = !residuals.positions_are_roundings();
        let before = residuals.size(of_positions);
        let values = if of_positions { &residuals.positions } else { &residuals.rates };
        let (change, _) = saddle.solve(&none, &values.map(|value| -value));
        let (q, v) = if of_positions { (&change, &none) } else { (&none, &change) };
        next = moved(&next, q, v, num_traits::One::one());
        if !next.is_finite() {
            break;
        }
        residuals = system.residuals_at(next.t, &next.q, &next.v);
        if residuals.are_roundings() {
            *state = next;
            return Ok(());
        }
        if of_positions && residuals.positions_are_roundings() {
            continue;
        }
        let after = residuals.size(of_positions);
        if after >= before && residuals.are_near(of_positions, &gradients, &next, inner) {
            // No better state in this arithmetic.
            *state = next;
            return Ok(());
        }
        if after >= contraction * before {
            (saddle, gradients) = system.saddle_at(next.t, &next.q, &next.v);
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

    #[inline(always)]
    fn positions_are_roundings(&self) -> bool {
        within(&self.positions, &self.position_sizes, ROUNDINGS)
    }

    /// Whether the residuals are below a part of their summands, or of what the largest of the coordinates or velocities
    /// contributes: a constraint such as z = 0 has no size of its own.
    pub(super) fn are_near<const N: usize>(
        &self,
        of_positions: bool,
        gradients: &[[R; N]; C],
        state: &State<R, N>,
        part: R,
    ) -> bool {
        let (values, sizes) = self.pick(of_positions);
        let of = if of_positions { &state.q } else { &state.v };
        let largest = of.iter().fold(R::zero(), |largest, x| largest.max(x.abs()));
        (0..C).all(|c| {
            let slope = gradients[c].iter().fold(R::zero(), |sum, a| sum + a.abs());
            let excess = values[c].abs() - part * (sizes[c] + slope * largest);
            excess.is_finite() && excess.largest() <= num_traits::Zero::zero()
        })
    }

    /// The largest residual relative to its summands.
    pub(super) fn size(&self, of_positions: bool) -> R::Lane {
        let (values, sizes) = self.pick(of_positions);
        worst::<R, C>(|c| relative(values[c], sizes[c])).1
    }

    fn pick(&self, of_positions: bool) -> (&[R; C], &[R; C]) {
        if of_positions { (&self.positions, &self.position_sizes) } else { (&self.rates, &self.rate_sizes) }
    }

    /// The constraint that is violated most.
    #[cold]
    pub(super) fn cause(&self) -> Cause {
        let of_positions = !self.positions_are_roundings();
        let (values, sizes) = self.pick(of_positions);
        let (constraint, _) = worst::<R, C>(|c| relative(values[c], sizes[c]));
        let by = values.get(constraint).map_or(Magnitude(0.0), |value| magnitude(value.abs().largest()));
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
