//! Queries of the factors of M and A, most of them for generated code alone.

use nalgebra::SMatrix;
use num_traits::{One, Zero};

use super::{Balance, Surface, factors, sound, stages};
use crate::linear::{Defect, Gradients, Independence, SaddlePoint};
use crate::number::elements::Each;
use crate::number::real::Real;
use crate::system::diagnose;
use crate::system::error::{Cause, MotionError};
use crate::system::name::Name;
use crate::system::state::State;

/// Whether the equations have no solution.
#[inline(always)]
pub fn is_singular<R: Real, const N: usize, const C: usize>(saddle: &impl SaddlePoint<R, N, C>) -> bool {
    saddle.defect().is_some() || saddle.vanishing().is_some()
}

/// How independent the constraints are.
#[inline(always)]
pub fn independence<R: Real, const N: usize, const C: usize>(
    saddle: &impl SaddlePoint<R, N, C>,
) -> Independence<R> {
    saddle.independence()
}

/// Checks the factors.
///
/// # Errors
/// [`Cause::VanishingGradient`], [`Cause::SingularMassMatrix`], [`Cause::NotFinite`].
#[cold]
pub fn regular<R: Real, const N: usize, const C: usize>(
    saddle: &impl SaddlePoint<R, N, C>,
) -> Result<(), Cause> {
    match (saddle.vanishing(), saddle.defect()) {
        (Some(constraint), _) => Err(Cause::VanishingGradient { constraint, name: Name::NONE }),
        (None, Some(Defect::Singular { coordinate })) => {
            Err(Cause::SingularMassMatrix { pivot: coordinate, name: Name::NONE })
        }
        (None, Some(Defect::NotFinite)) => Err(Cause::NotFinite),
        (None, None) => Ok(()),
    }
}

/// Checks the factors at a state, and whether the constraints have gradients there.
///
/// # Errors
/// As [`regular`], with names. A gradient that has no value at the state, but beside it, is a
/// [`Cause::VanishingGradient`].
#[cold]
pub(super) fn regular_at<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    factors: (&S::Saddle, &<S::Saddle as SaddlePoint<S::Scalar, N, C>>::Gradients),
) -> Result<(), Cause>
where
    S: Surface<N, K, C>,
{
    let (saddle, gradients) = factors;
    let found = regular(saddle).map_err(|cause| match cause {
        // Beside infinite masses a gradient moves nothing, though it has a value.
        Cause::VanishingGradient { constraint, .. } if has_value(gradients, constraint) => Cause::NotFinite,
        Cause::NotFinite => without_value(system, state, gradients)
            .map_or(cause, |constraint| Cause::VanishingGradient { constraint, name: Name::NONE }),
        _ => cause,
    });
    found.map_err(|cause| cause.named(&S::NAMES))
}

/// Whether the gradient of a constraint has finite entries, of which some are not zero.
fn has_value<R: Real, const N: usize, const C: usize>(
    gradients: &impl Gradients<R, N, C>,
    constraint: usize,
) -> bool {
    let rows = gradients.rows();
    let row = rows.get(constraint).map_or(&[][..], |row| row);
    row.iter().all(|x| x.is_finite()) && row.iter().any(|x| x.abs().is_positive())
}

/// The first constraint whose gradient has no value at a state, but beside it, as that of a distance has none
/// at its centre.
fn without_value<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    gradients: &impl Gradients<S::Scalar, N, C>,
) -> Option<usize>
where
    S: Surface<N, K, C>,
{
    let has_value = |row: &[S::Scalar; N]| row.iter().all(|x| x.is_finite());
    let size = state.q.iter().fold(S::Scalar::zero(), |most, q| most.max(q.abs()));
    let way = if size.is_positive() { S::Scalar::epsilon().sqrt() * size } else { S::Scalar::one() };
    let beside = state.q.each(|q| q + way);
    let there = factors(system, &State { q: beside, ..*state }).1.rows();
    gradients.rows().iter().zip(&there).position(|(here, there)| !has_value(here) && has_value(there))
}

/// Whether the equations have a solution at a state.
///
/// # Errors
/// As [`regular`], with names; [`Cause::Contradictory`] and [`Cause::Undetermined`] of several constraints.
#[cold]
pub fn check<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    t: S::Scalar,
    q: &[S::Scalar; N],
    v: &[S::Scalar; N],
) -> Result<(), Cause>
where
    S: Surface<N, K, C>,
{
    let state = State { t, q: *q, v: *v };
    let factors = factors(system, &state);
    regular_at(system, &state, (&factors.0, &factors.1))?;
    // One row depends on no other.
    if C == 1 {
        return Ok(());
    }
    stages::check(system, &state, factors).map_err(|cause| cause.named(&S::NAMES))
}

/// Whether accelerations and multipliers are finite, and the constraints as well.
///
/// # Errors
/// What is wrong at the state.
#[inline]
pub fn finite<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    balance: &Balance<S::Scalar, N, C>,
) -> Result<(), MotionError<S::Scalar>>
where
    S: Surface<N, K, C>,
{
    if balance.accelerations.iter().chain(&balance.multipliers).all(|x| x.is_finite()) {
        return sound(system, state);
    }
    let cause = diagnose(system, &system.constants(), state.t, &state.q, &state.v);
    Err(MotionError { cause, t: state.t })
}

/// λ ∂f/∂q of each constraint.
#[inline]
pub fn forces<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    multipliers: &[S::Scalar; C],
) -> [[S::Scalar; N]; C]
where
    S: Surface<N, K, C>,
{
    let mut rows = system.saddle_at(state.t, &state.q, &state.v).1.rows();
    for (row, &multiplier) in rows.iter_mut().zip(multipliers) {
        for entry in row {
            *entry *= multiplier;
        }
    }
    rows
}

/// Rows as a matrix.
#[inline]
pub fn matrix<R: Real, const N: usize, const C: usize>(rows: &[[R; N]; C]) -> SMatrix<R, C, N> {
    SMatrix::from_fn(|c, i| rows[c][i])
}

#[cfg(test)]
mod tests {
    use core::cell::Cell;

    use super::*;
    use crate::constraints::samples::Twofold;
    use crate::linear::Saddle;

    #[test]
    fn a_row_of_zeros_among_others_makes_a_system_singular() {
        let mass = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
        let of = |second| Saddle::factor(&mass, &[[1.0, 1.0, 0.0], second]);
        // Such a row has factors, and the others a solution.
        assert_eq!(of([0.0; 3]).defect(), None);
        assert!(is_singular(&of([0.0; 3])) && regular(&of([0.0; 3])).is_err());
        assert!(!is_singular(&of([0.0, 1.0, 1.0])) && regular(&of([0.0, 1.0, 1.0])).is_ok());
        // Rows that depend on each other have a solution as well.
        assert!(!is_singular(&of([2.0, 2.0, 0.0])));
    }

    #[test]
    fn multipliers_that_are_no_numbers_are_an_error() {
        let rod = Twofold { factored: Cell::new(0) };
        let state = State::new([0.8, -0.6], [0.6, 0.8]);
        let mut balance = rod.balance_at(&(), 0.0, &state.q, &state.v, &[]);
        assert_eq!(finite(&rod, &state, &balance), Ok(()));
        balance.multipliers[1] = f64::NAN;
        assert!(finite(&rod, &state, &balance).is_err());
    }
}
