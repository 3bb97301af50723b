//! Solving M a = f in generated code: checks of pivots and factorisations with the cause of a
//! failure. Reached through `__private` only.

use crate::error::Cause;
use crate::linear::{Ldlt, Lu};
use crate::real::Real;

/// A pivot below this many roundings of what it was computed from carries no digit.
const ROUNDINGS: f64 = 8.0;

/// Checks a pivot of a factorisation that is written out: it must be positive, and above the
/// rounding errors of `scale`, the entry that eliminations were subtracted from.
///
/// # Errors
/// [`Cause::SingularMassMatrix`] with the coordinate.
#[inline(always)]
pub fn pivot<R: Real>(value: R, scale: R, coordinate: usize) -> Result<(), Cause> {
    if Real::is_positive(value - R::from_f64(ROUNDINGS) * R::epsilon() * scale) {
        Ok(())
    } else {
        Err(Cause::SingularMassMatrix { pivot: coordinate })
    }
}

/// Factors the lower triangle of a positive definite block of the mass matrix.
///
/// # Errors
/// [`Cause::SingularMassMatrix`] with the coordinate of the failing pivot.
#[inline]
pub fn ldlt<R: Real, const N: usize>(
    mass: [[R; N]; N],
    coordinates: &[usize; N],
) -> Result<Ldlt<R, N>, Cause> {
    Ldlt::factor(mass).map_err(|row| singular(row, coordinates))
}

/// Factors the lower triangle of a symmetric block of any signature.
///
/// # Errors
/// [`Cause::SingularMassMatrix`] with the coordinate of the failing pivot.
#[inline]
pub fn lu<R: Real, const N: usize>(mass: [[R; N]; N], coordinates: &[usize; N]) -> Result<Lu<R, N>, Cause> {
    let whole = core::array::from_fn(|i| core::array::from_fn(|j| mass[i.max(j)][i.min(j)]));
    Lu::factor(whole).map_err(|row| singular(row, coordinates))
}

fn singular<const N: usize>(row: usize, coordinates: &[usize; N]) -> Cause {
    Cause::SingularMassMatrix { pivot: coordinates.get(row).copied().unwrap_or(row) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vanishing_pivots_name_their_coordinate() {
        assert_eq!(pivot(1e-3, 1.0, 4), Ok(()));
        for value in [0.0, -1.0, 1e-16, f64::NAN] {
            assert_eq!(pivot(value, 1.0, 4), Err(Cause::SingularMassMatrix { pivot: 4 }));
        }
    }

    #[test]
    fn a_block_names_the_coordinate_of_the_system() {
        let singular = [[1.0, 0.0], [1.0, 1.0]];
        assert_eq!(ldlt(singular, &[3, 5]).err(), Some(Cause::SingularMassMatrix { pivot: 5 }));
    }

    #[test]
    fn indefinite_blocks_are_solved() {
        let hyperbolic = [[0.0, 0.0], [2.0, 0.0]];
        assert_eq!(lu(hyperbolic, &[0, 1]).map(|factor| factor.solve([2.0, 4.0])), Ok([2.0, 1.0]));
    }
}
