//! Where a motion may begin, and the nearest such state.

use super::extent::Extent;
use super::noise::Noise;
use super::projection::is_within;
use super::solution::regular;
use super::{Residuals, Surface, moved};
use crate::error::{Cause, MotionError};
use crate::linear::SaddlePoint;
use crate::real::Real;
use crate::state::State;

/// A start is good where the corrections that it needs are below this share of √ε of its numbers: as good as numbers
/// written with nine digits, or with five in single precision.
const SHARE: f64 = 1.0 / 16.0;

/// Newton steps before a projection is given up.
const STEPS: usize = 60;

/// A step is halved at most so often.
const HALVINGS: usize = 12;

/// A step is no longer than so many distances from the constraints: where these nearly depend on each other, Newton's steps
/// lead far away.
const FAR: f64 = 4.0;

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
    let tolerance = number(SHARE) * S::Scalar::epsilon().sqrt();
    let none = [num_traits::Zero::zero(); N];
    for (of_positions, numbers) in [(true, &start.q), (false, &start.v)] {
        if residuals.level_is_roundings(of_positions) {
            continue;
        }
        let (values, sizes) = residuals.level(of_positions);
        let by_state = Extent::of(&saddle, numbers).sizes(&saddle, &gradients);
        let good = |own: &[S::Scalar; C]| {
            values.iter().zip(own).all(|(&value, &size)| is_within(value, tolerance * size))
        };
        // A constraint such as z = 0 has no size of its own: the state has, in its numbers and in the kinetic metric.
        let is_small = || {
            let (change, _) = saddle.solve(&none, values);
            let largest = |values: &[S::Scalar; N]| {
                values.iter().fold(num_traits::Zero::zero(), |largest: S::Scalar, x| largest.max(x.abs()))
            };
            is_within(largest(&change), tolerance * largest(numbers))
        };
        let both = core::array::from_fn(|c| sizes[c] + by_state[c]);
        let is_noise = || {
            Noise::of(system, start, &saddle, &gradients, &residuals, of_positions).explains(
                &residuals,
                of_positions,
                &saddle,
            )
        };
        if !(good(sizes) || good(&both) && is_small() || is_noise()) {
            return Err(residuals.cause(of_positions, &Extent::unit().sizes(&saddle, &gradients)));
        }
    }
    Ok(())
}

/// A state on the constraints by Newton's method: coordinates, then velocities. Each step is the shortest in the metric of
/// the mass matrix where it is taken, so the coordinates are the nearest ones up to the square of the distance, and the
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
        if residuals.level_is_roundings(of_positions) {
            break;
        }
        let (saddle, gradients) = system.saddle_at(state.t, &state.q, &state.v);
        regular(&saddle)?;
        // A gradient that is itself noise says nothing about the velocities.
        let noise = || Noise::of(system, &state, &saddle, &gradients, &residuals, of_positions);
        if !of_positions && noise().explains(&residuals, of_positions, &saddle) {
            return Ok(state);
        }
        let values = if of_positions { residuals.positions } else { residuals.rates };
        let (change, _) = saddle.solve(&none, &values.map(|value| -value));
        if !change.iter().all(|x| x.is_finite()) {
            return Err(Cause::NotFinite);
        }
        let slopes = Extent::unit().sizes(&saddle, &gradients);
        let before = distance(&residuals, &slopes, of_positions);
        let mut share = one;
        if of_positions {
            let far = S::Scalar::from_f64(FAR) * S::Scalar::splat(before).sqrt();
            share = one.min(far / Extent::of(&saddle, &change).size());
        }
        let mut better = None;
        for _ in 0..HALVINGS {
            let (q, v) = if of_positions { (&change, &none) } else { (&none, &change) };
            let next = moved(&state, q, v, share);
            let there = system.residuals_at(next.t, &next.q, &next.v);
            if distance(&there, &slopes, of_positions) < before {
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
    regular(&saddle)?;
    let extent =
        |state: &State<S::Scalar, N>| Extent::of(&saddle, if of_positions { &state.q } else { &state.v });
    let by_state = extent(&start).max(extent(&state)).sizes(&saddle, &gradients);
    if on_surface(&residuals, &gradients, &state, &by_state, of_positions) {
        return Ok(state);
    }
    Err(match residuals.cause(of_positions, &by_state) {
        Cause::PositionViolated { constraint, by } | Cause::VelocityViolated { constraint, by } => {
            if saddle.rank() < C {
                Cause::Contradictory { constraint }
            } else {
                Cause::NoConsistentState { constraint, by }
            }
        }
        other => other,
    })
}

/// Σ (f / |∂f/∂q|)² with gradients in units of the kinetic metric: how far the constraints are, whatever their units.
fn distance<R: Real, const C: usize>(
    residuals: &Residuals<R, C>,
    slopes: &[R; C],
    of_positions: bool,
) -> R::Lane {
    let (values, _) = residuals.level(of_positions);
    let mut sum = R::zero();
    for (&value, &slope) in values.iter().zip(slopes) {
        if value != R::zero() {
            let distance = value / slope;
            sum = R::mul_add(distance, distance, sum);
        }
    }
    sum.largest()
}

/// Whether what is left of the constraints are roundings, of their summands or of the state.
fn on_surface<R: Real, const N: usize, const C: usize>(
    residuals: &Residuals<R, C>,
    gradients: &[[R; N]; C],
    state: &State<R, N>,
    by_state: &[R; C],
    of_positions: bool,
) -> bool {
    const ROUNDINGS: f64 = 64.0;
    let (values, sizes) = residuals.level(of_positions);
    let of = if of_positions { &state.q } else { &state.v };
    let tolerance = R::from_f64(ROUNDINGS) * R::epsilon();
    (0..C).all(|c| {
        let mut size = sizes[c] + by_state[c];
        for i in 0..N {
            size += (gradients[c][i] * of[i]).abs();
        }
        is_within(values[c], tolerance * size)
    })
}
