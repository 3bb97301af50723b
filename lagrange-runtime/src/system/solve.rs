//! Solving M a = f in generated code. Reached through `__private` only.
//!
//! No branch leaves the straight line here: a matrix without an inverse gives NaN, which the integrator
//! notices, and the functions `check…` then find the coordinate. A pivot counts as zero where it is below the
//! rounding errors of the number that it is the rest of.

use nalgebra::SMatrix;

use crate::linear::{Ldlt, Lu};
use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::error::{Cause, MotionError};
use crate::system::name::Name;
use crate::system::state::State;
use crate::system::{System, check_masses, diagnose};

/// A pivot below this many ulps of its scale carries no digit.
const ROUNDINGS: f64 = 8.0;

/// Whether a pivot is positive, and above the rounding errors of `scale`.
#[inline(always)]
fn carries<R: Real>(value: R, scale: R) -> bool {
    Real::is_positive(value - R::from_f64(ROUNDINGS) * R::epsilon() * scale)
}

/// The pivot itself, or NaN where it carries no digit.
#[inline(always)]
pub fn pivot<R: Real>(value: R, scale: R) -> R {
    if carries(value, scale) { value } else { R::from_f64(f64::NAN) }
}

/// Checks a pivot of a factorisation that is written out.
///
/// # Errors [`Cause::SingularMassMatrix`] with the coordinate; [`Cause::NotFinite`] for a pivot or a scale
/// that is NaN or infinite.
#[inline]
pub fn check<R: Real>(value: R, scale: R, coordinate: usize) -> Result<(), Cause> {
    if carries(value, scale) {
        Ok(())
    } else {
        Err(singular(value.is_finite() && scale.is_finite(), coordinate))
    }
}

/// Checks many pivots, in the order of the factorisation.
///
/// # Errors
/// Those of [`check`], at the first pivot that has one.
pub fn check_all<R: Real, const N: usize>(
    values: &[R; N],
    scales: &[R; N],
    coordinates: &[usize; N],
) -> Result<(), Cause> {
    let mut pivots = values.iter().zip(scales).zip(coordinates);
    pivots.try_for_each(|((&value, &scale), &coordinate)| check(value, scale, coordinate))
}

/// The cause of a pivot that is zero or NaN: a factorisation stops at either, and whether the numbers are
/// finite tells them apart.
fn singular(finite: bool, coordinate: usize) -> Cause {
    if finite { Cause::SingularMassMatrix { pivot: coordinate, name: Name::NONE } } else { Cause::NotFinite }
}

/// The accelerations if they are finite and the masses are positive.
///
/// # Errors
/// The cause at the state if not.
#[inline(always)]
pub fn finite<S: System<N, K>, const N: usize, const K: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    accelerations: [S::Scalar; N],
) -> Result<[S::Scalar; N], MotionError<S::Scalar>> {
    if accelerations.iter().all(|a| a.is_finite()) {
        check_masses(system, constants, state).map(|()| accelerations)
    } else {
        Err(MotionError { cause: diagnose(system, constants, state.t, &state.q, &state.v), t: state.t })
    }
}

/// A factorisation of a block of the mass matrix from its lower triangle.
pub trait Factor<R, const N: usize>: Sized {
    /// Factors.
    ///
    /// # Errors
    /// The row of the pivot that vanishes.
    fn factor(lower: [[R; N]; N]) -> Result<Self, usize>;

    /// Solves for one right-hand side.
    fn solve(&self, right: [R; N]) -> [R; N];
}

impl<R: Real, const N: usize> Factor<R, N> for Ldlt<R, N> {
    #[inline]
    fn factor(lower: [[R; N]; N]) -> Result<Self, usize> {
        Ldlt::factor(lower)
    }

    #[inline]
    fn solve(&self, right: [R; N]) -> [R; N] {
        Ldlt::solve(self, right)
    }
}

impl<R: Real, const N: usize> Factor<R, N> for Lu<R, N> {
    #[inline]
    fn factor(lower: [[R; N]; N]) -> Result<Self, usize> {
        Lu::factor(array(|i| array(|j| lower[i.max(j)][i.min(j)])))
    }

    #[inline]
    fn solve(&self, right: [R; N]) -> [R; N] {
        Lu::solve(self, right)
    }
}

/// Whether all of some numbers are finite.
#[inline]
pub fn are_finite<R: Real>(numbers: &[R]) -> bool {
    numbers.iter().all(|x| x.is_finite())
}

/// Factors a block; the factorisation of a singular one is `None`.
#[inline]
pub fn factor<F: Factor<R, N>, R: Real, const N: usize>(lower: [[R; N]; N]) -> Option<F> {
    F::factor(lower).ok()
}

/// Solves with the factorisation of a block; NaN where there is none.
#[inline]
pub fn solve<F: Factor<R, N>, R: Real, const N: usize>(factor: &Option<F>, right: [R; N]) -> [R; N] {
    match factor {
        Some(factor) => factor.solve(right),
        None => [R::from_f64(f64::NAN); N],
    }
}

/// An array of parameters with `N` elements.
#[diagnostic::on_unimplemented(
    message = "this must be an array of {N} elements, one for each of what it stands beside",
    label = "not an array of {N} elements"
)]
pub trait HasLength<const N: usize> {}

impl<T, const N: usize> HasLength<N> for [T; N] {}
impl<T, const N: usize> HasLength<N> for nalgebra::SVector<T, N> {}

/// Compiles only for arrays of `N` elements.
pub const fn has_length<const N: usize, A: HasLength<N>>(_: &A) {}

/// Calls a function that stays one: part of a body too long for the compiler in one piece.
#[inline(never)]
pub fn outlined<T>(part: impl FnOnce() -> T) -> T {
    part()
}

/// A symmetric matrix from its lower triangle.
#[inline]
pub fn symmetric<R: Real, const N: usize>(lower: [[R; N]; N]) -> SMatrix<R, N, N> {
    SMatrix::from_fn(|i, j| lower[i.max(j)][i.min(j)])
}

/// A mass matrix from the momenta, which are M v + p₀: its columns are those of unit velocities, less p₀.
#[inline]
pub fn mass_of<R: Real, const N: usize>(momenta: impl Fn(&[R; N]) -> [R; N]) -> SMatrix<R, N, N> {
    let mut velocities = [R::zero(); N];
    let rest = momenta(&velocities);
    let mut mass = SMatrix::<R, N, N>::zeros();
    for (j, mut column) in mass.column_iter_mut().enumerate() {
        velocities[j] = R::one();
        for ((entry, momentum), rest) in column.iter_mut().zip(momenta(&velocities)).zip(rest) {
            *entry = momentum - rest;
        }
        velocities[j] = R::zero();
    }
    mass
}

/// Checks the block of a mass matrix that belongs to some coordinates.
///
/// # Errors
/// [`Cause::SingularMassMatrix`] with the coordinate; [`Cause::NotFinite`] if not all of `mass` is finite.
#[inline]
pub fn check_block<F: Factor<R, B>, R: Real, const N: usize, const B: usize>(
    mass: &SMatrix<R, N, N>,
    coordinates: &[usize; B],
) -> Result<(), Cause> {
    let entry =
        |i: usize, j: usize| mass.get((coordinates[i], coordinates[j])).copied().unwrap_or_else(R::zero);
    let lower = array(|i| array(|j| entry(i, j)));
    let cause = |row: usize| {
        singular(mass.iter().all(|x| x.is_finite()), coordinates.get(row).copied().unwrap_or(row))
    };
    F::factor(lower).map(|_| ()).map_err(cause)
}

/// A size of which no bound is known.
#[must_use]
pub fn unbounded<R: Real>() -> R {
    R::from_f64(f64::INFINITY)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vanishing_pivots_name_their_coordinate() {
        assert_eq!(check(1e-3, 1.0, 4), Ok(()));
        assert_eq!(pivot(1e-3, 1.0), 1e-3);
        for value in [0.0, -1.0, 1e-16_f64] {
            assert_eq!(check(value, 1.0, 4), Err(Cause::SingularMassMatrix { pivot: 4, name: Name::NONE }));
            assert!(pivot(value, 1.0).is_nan());
        }
        assert_eq!(check(f64::NAN, 1.0, 4), Err(Cause::NotFinite));
        assert_eq!(check(1.0, f64::INFINITY, 4), Err(Cause::NotFinite));
    }

    #[test]
    fn of_many_pivots_the_first_that_vanishes_is_named() {
        assert_eq!(check_all(&[1.0, 2.0, 3.0], &[1.0; 3], &[4, 3, 2]), Ok(()));
        let cause = check_all(&[1.0, 0.0, f64::NAN], &[1.0; 3], &[4, 3, 2]);
        assert_eq!(cause, Err(Cause::SingularMassMatrix { pivot: 3, name: Name::NONE }));
    }

    #[test]
    fn momenta_of_unit_velocities_are_columns_of_the_mass_matrix() {
        // p = M v + p₀, as in a frame that moves.
        let momenta = |v: &[f64; 2]| [3.0 * v[0] + 0.5 * v[1] + 7.0, 0.5 * v[0] + 2.0 * v[1] - 1.0];
        assert_eq!(mass_of(momenta), SMatrix::from([[3.0, 0.5], [0.5, 2.0]]));
    }

    #[test]
    fn a_singular_block_gives_no_number_and_names_the_coordinate_of_the_system() {
        let singular = [[1.0, 0.0], [1.0, 1.0]];
        assert!(solve(&factor::<Ldlt<f64, 2>, _, 2>(singular), [1.0, 1.0]).iter().all(|x| x.is_nan()));
        let mut mass = SMatrix::<f64, 6, 6>::identity();
        (mass[(3, 5)], mass[(5, 3)]) = (1.0, 1.0);
        let cause = check_block::<Ldlt<f64, 2>, _, 6, 2>(&mass, &[3, 5]);
        assert_eq!(cause, Err(Cause::SingularMassMatrix { pivot: 5, name: Name::NONE }));
    }

    #[test]
    fn indefinite_blocks_are_solved() {
        let hyperbolic = [[0.0, 0.0], [2.0, 0.0]];
        assert_eq!(solve(&factor::<Lu<f64, 2>, _, 2>(hyperbolic), [2.0, 4.0]), [2.0, 1.0]);
    }
}
