//! Eigenvalues and eigenvectors of a symmetric matrix by Jacobi's rotations.
//!
//! A rotation in the plane of two coordinates makes the entry between them zero; sweeps over all pairs
//! converge quadratically (Golub and Van Loan, "Matrix Computations", 4th ed., § 8.5). Nothing is stored but
//! the matrix and the product of the rotations.

use crate::number::elements::array;
use crate::number::real::{Ordered, larger};

/// Sweeps over all pairs; quadratic convergence needs some six to ten.
const SWEEPS: usize = 40;

/// Makes the leading `count` rows and columns of a symmetric matrix diagonal, in place. The diagonal then has
/// the eigenvalues, and the rows of `vectors` are the eigenvectors.
pub(crate) fn diagonalise<R: Ordered, const N: usize>(
    matrix: &mut [[R; N]; N],
    vectors: &mut [[R; N]; N],
    count: usize,
) {
    let count = count.min(N);
    for (i, row) in vectors.iter_mut().enumerate() {
        *row = array(|j| if i == j { R::one() } else { R::zero() });
    }
    let most = matrix.iter().flatten().fold(R::zero(), |most, x| larger(x.abs(), most));
    // An entry off the diagonal counts if it exceeds this, and a rounding of the geometric mean of the two
    // diagonal entries beside it.
    let floor = R::epsilon() * R::epsilon() * most;
    for _ in 0..SWEEPS {
        let mut turned = false;
        for i in 0..count {
            for j in i + 1..count {
                let (a, b, between) = (matrix[i][i], matrix[j][j], matrix[i][j]);
                let beside = R::epsilon() * (a.abs().sqrt() * b.abs().sqrt());
                if between.is_finite() && between.abs() > larger(beside, floor) {
                    rotate(matrix, vectors, i, j);
                    turned = true;
                }
            }
        }
        if !turned {
            return;
        }
    }
}

/// Makes the entry of rows and columns i and j zero.
fn rotate<R: Ordered, const N: usize>(
    matrix: &mut [[R; N]; N],
    vectors: &mut [[R; N]; N],
    i: usize,
    j: usize,
) {
    let (a, b, between) = (matrix[i][i], matrix[j][j], matrix[i][j]);
    let zeta = (b - a) / (between + between);
    let sign = if zeta < R::zero() { -R::one() } else { R::one() };
    // The smaller of both angles, by a form in which no square overflows.
    let tangent = sign / (zeta.abs() + R::one().hypot(zeta));
    let cosine = R::one().hypot(tangent).recip();
    let sine = cosine * tangent;
    for row in matrix.iter_mut() {
        let (x, y) = (row[i], row[j]);
        row[i] = cosine * x - sine * y;
        row[j] = sine * x + cosine * y;
    }
    for rows in [&mut *matrix, vectors] {
        let (x, y) = (rows[i], rows[j]);
        rows[i] = array(|k| cosine * x[k] - sine * y[k]);
        rows[j] = array(|k| sine * x[k] + cosine * y[k]);
    }
    // By the closed form, which loses no digits.
    matrix[i][i] = a - tangent * between;
    matrix[j][j] = b + tangent * between;
    (matrix[i][j], matrix[j][i]) = (R::zero(), R::zero());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::samples::Noise;

    /// How far M − Σ λ z zᵀ and Z Zᵀ − 1 are from zero, and the λ.
    fn errors<const N: usize>(matrix: &[[f64; N]; N], count: usize) -> (f64, f64, [f64; N]) {
        let (mut values, mut vectors) = (*matrix, [[0.0; N]; N]);
        diagonalise(&mut values, &mut vectors, count);
        let (mut residual, mut skewness) = (0.0_f64, 0.0_f64);
        for i in 0..count {
            for j in 0..count {
                let sum: f64 = (0..count).map(|k| values[k][k] * vectors[k][i] * vectors[k][j]).sum();
                residual = residual.max((sum - matrix[i][j]).abs());
                let product: f64 = (0..count).map(|k| vectors[i][k] * vectors[j][k]).sum();
                skewness = skewness.max((product - f64::from(u8::from(i == j))).abs());
            }
        }
        (residual, skewness, core::array::from_fn(|k| values[k][k]))
    }

    #[test]
    fn random_matrices_are_products_of_their_eigenvectors() {
        let mut noise = Noise(11);
        for count in [1, 2, 7] {
            for _ in 0..30 {
                let half: [[f64; 7]; 7] = noise.matrix();
                let matrix: [[f64; 7]; 7] =
                    core::array::from_fn(|i| core::array::from_fn(|j| half[i][j] + half[j][i]));
                let (residual, skewness, _) = errors(&matrix, count);
                assert!(residual < 2e-14 && skewness < 1e-14, "{residual} {skewness}");
            }
        }
    }

    #[test]
    fn opposite_and_equal_eigenvalues_and_zeros_are_told_apart() {
        let (residual, _, mut values) = errors(&[[0.0, 2.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]], 3);
        values.sort_by(f64::total_cmp);
        assert!(residual < 1e-15 && (values[0] + 2.0).abs() < 1e-15, "{values:?}");
        assert!((values[1] - 2.0).abs() < 1e-15 && (values[2] - 2.0).abs() < 1e-15);
        assert_eq!(errors(&[[0.0; 3]; 3], 3).2, [0.0; 3]);
    }

    #[test]
    fn scales_neither_overflow_nor_round_what_is_soft() {
        let (_, _, values) = errors(&[[3e-200, 1e-200], [1e-200, 3e-200]], 2);
        assert!((values[0] + values[1] - 6e-200).abs() < 1e-214, "{values:?}");
        let (_, _, values) = errors(&[[1e200, 0.0], [0.0, 1e-200]], 2);
        assert_eq!(values, [1e200, 1e-200]);
        let (_, _, values) = errors(&[[3e200, 1e200], [1e200, 3e200]], 2);
        assert!((values[0] + values[1] - 6e200).abs() < 1e186, "{values:?}");
    }
}
