//! Where a motion may begin, and the nearest such state.

use super::solution::regular;
use super::{Residuals, Surface, magnitude, moved, worst};
use crate::error::{Cause, MotionError};
use crate::linear::SaddlePoint;
use crate::real::Real;
use crate::state::State;

/// A start is good where the corrections that it needs are below this share of √ε of its numbers: as good as numbers
/// written with nine digits, or with five in single precision.
const SHARE: f64 = 1.0 / 16.0;

/// Newton steps before a projection is given up.
const STEPS: usize = 60;

/// A solution is off by at most so many roundings.
const ROUNDINGS: f64 = 64.0;

/// A step is halved at most so often.
const HALVINGS: usize = 12;

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
    let number = S::Scalar::from_f64;
    if !start.is_finite() {
        return Err(Cause::NotFinite);
    }
    let residuals = system.residuals_at(start.t, &start.q, &start.v);
    let (saddle, gradients) = system.saddle_at(start.t, &start.q, &start.v);
    regular(&saddle)?;
    if residuals.are_roundings() {
        return Ok(());
    }
    let tolerance = number(SHARE) * S::Scalar::epsilon().sqrt();
    let near = |of_positions| residuals.are_near(of_positions, &gradients, start, tolerance);
    if near(true) && near(false) {
        return Ok(());
    }
    Err(residuals.cause())
}

/// The nearest state on the constraints in the metric of the mass matrix, by Newton's method: coordinates, then
/// velocities.
///
/// # Errors
/// [`Cause::Contradictory`] where dependent constraints cannot be satisfied together, [`Cause::PositionViolated`] or
/// [`Cause::VelocityViolated`] where the search ends before a solution, [`Cause::VanishingGradient`],
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
    let state = search(system, start, true).map_err(failed)?;
    search(system, state, false).map_err(failed)
}

fn search<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    start: State<S::Scalar, N>,
    of_positions: bool,
) -> Result<State<S::Scalar, N>, Cause>
where
    S: Surface<N, K, C>,
{
    let none = [num_traits::Zero::zero(); N];
    let one: S::Scalar = num_traits::One::one();
    let mut state = start;
    let mut residuals = system.residuals_at(state.t, &state.q, &state.v);
    for _ in 0..STEPS {
        let (saddle, gradients) = system.saddle_at(state.t, &state.q, &state.v);
        regular(&saddle)?;
        let values = if of_positions { residuals.positions } else { residuals.rates };
        let (change, _) = saddle.solve(&none, &values.map(|value| -value));
        if !change.iter().all(|x| x.is_finite()) {
            return Err(Cause::NotFinite);
        }
        let (mut share, before) = (one, distance(&residuals, &gradients, of_positions));
        let mut better = None;
        for _ in 0..HALVINGS {
            let (q, v) = if of_positions { (&change, &none) } else { (&none, &change) };
            let next = moved(&state, q, v, share);
            let there = system.residuals_at(next.t, &next.q, &next.v);
            if distance(&there, &gradients, of_positions) < before {
                better = Some((next, there));
                break;
            }
            share *= S::Scalar::from_f64(0.5);
        }
        match better {
            Some(found) => (state, residuals) = found,
            None => break,
        }
    }
    let (saddle, gradients) = system.saddle_at(state.t, &state.q, &state.v);
    let part = S::Scalar::from_f64(ROUNDINGS) * S::Scalar::epsilon();
    if residuals.are_near(of_positions, &gradients, &state, part) {
        return Ok(state);
    }
    let values = if of_positions { residuals.positions } else { residuals.rates };
    let (constraint, by) = worst::<S::Scalar, C>(|c| values[c].abs().largest());
    Err(match (saddle.rank() < C, of_positions) {
        (true, _) => Cause::Contradictory { constraint },
        (false, true) => Cause::PositionViolated { constraint, by: magnitude(by) },
        (false, false) => Cause::VelocityViolated { constraint, by: magnitude(by) },
    })
}

/// Σ (f / |∂f/∂q|)²: how far the constraints are, whatever their units.
fn distance<R: Real, const N: usize, const C: usize>(
    residuals: &Residuals<R, C>,
    gradients: &[[R; N]; C],
    of_positions: bool,
) -> R::Lane {
    let values = if of_positions { &residuals.positions } else { &residuals.rates };
    let mut sum = R::zero();
    for (value, row) in values.iter().zip(gradients) {
        let mut square = R::zero();
        for &a in row {
            square = R::mul_add(a, a, square);
        }
        if *value != R::zero() {
            sum += *value * *value / square;
        }
    }
    sum.largest()
}
