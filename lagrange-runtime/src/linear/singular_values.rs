//! Singular values by one-sided Jacobi rotations, for least squares with any rank.
//!
//! Columns are rotated in pairs until all are orthogonal: B = U Σ Vᵀ. No bidiagonal form is needed, and small
//! singular values keep their relative accuracy (Golub and Van Loan, "Matrix Computations", 4th ed., § 8.6.3;
//! J. Demmel and K. Veselić, SIAM J. Matrix Anal. Appl. 13 (1992) 1204).

use crate::linear::stored::Stored;
use crate::number::elements::array;
use crate::number::real::{Ordered, Real, larger};

/// Sweeps over all pairs; quadratic convergence needs some six to ten.
const SWEEPS: usize = 40;

/// B = U Σ Vᵀ of a square matrix; rectangular ones are filled up with zeros.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SingularValues<R, const N: usize> {
    /// Columns of U Σ, one a row.
    left: Stored<[[R; N]; N]>,
    /// Columns of V, one a row.
    right: Stored<[[R; N]; N]>,
    /// Squares of the singular values.
    squares: [R; N],
}

impl<R: Ordered, const N: usize> SingularValues<R, N> {
    /// Decomposes a matrix given by its rows.
    pub fn new(rows: &[[R; N]; N]) -> Self {
        let (mut left, mut right) = (Stored::<[[R; N]; N]>::zeros(), Stored::<[[R; N]; N]>::zeros());
        for (j, column) in left.iter_mut().enumerate() {
            *column = array(|i| rows[i][j]);
        }
        for (i, row) in right.iter_mut().enumerate() {
            row[i] = R::one();
        }
        for _ in 0..SWEEPS {
            let mut turned = false;
            for i in 0..N {
                for j in i + 1..N {
                    turned |= orthogonalise(&mut left, &mut right, i, j);
                }
            }
            if !turned {
                break;
            }
        }
        let squares = array(|i| dot(&left[i], &left[i]));
        Self { left, right, squares }
    }

    /// The largest singular value squared.
    pub fn largest_square(&self) -> R {
        self.squares.iter().fold(R::zero(), |most, &square| larger(most, square))
    }

    /// How many squares of singular values are above a bound.
    pub fn rank(&self, least: R) -> usize {
        self.squares.iter().filter(|&&square| square > least).count()
    }

    /// The largest square of a singular value that is a rounding error: 64 Nε of the largest value.
    fn least(&self) -> R {
        let share = R::from_f64(64.0 * N as f64) * R::epsilon();
        share * share * self.largest_square()
    }

    /// |b − B x|² at the best x.
    pub fn remainder(&self, b: &[R; N]) -> R {
        let mut rest = *b;
        for (left, &square) in self.left.iter().zip(&self.squares) {
            if square > self.least() {
                let along = dot(left, &rest) / square;
                for (rest, &left) in rest.iter_mut().zip(left) {
                    *rest -= along * left;
                }
            }
        }
        dot(&rest, &rest)
    }

    /// The x of least |B x − b|² + `damping` |x|². Directions whose singular value is a rounding error are
    /// left alone.
    pub fn solve(&self, b: &[R; N], damping: R) -> [R; N] {
        let least = self.least();
        let mut x = [R::zero(); N];
        for ((left, right), &square) in self.left.iter().zip(self.right.iter()).zip(&self.squares) {
            if square > least {
                let along = dot(left, b) / (square + damping);
                for (x, &right) in x.iter_mut().zip(right) {
                    *x += along * right;
                }
            }
        }
        x
    }
}

/// Rotates columns i and j to be orthogonal; false where they are.
fn orthogonalise<R: Ordered, const N: usize>(
    left: &mut [[R; N]; N],
    right: &mut [[R; N]; N],
    i: usize,
    j: usize,
) -> bool {
    let (alpha, beta, gamma) = (dot(&left[i], &left[i]), dot(&left[j], &left[j]), dot(&left[i], &left[j]));
    if !gamma.is_finite() || gamma.abs() <= R::epsilon() * (alpha * beta).sqrt() || gamma == R::zero() {
        return false;
    }
    let two = R::one() + R::one();
    let zeta = (beta - alpha) / (two * gamma);
    let sign = if zeta < R::zero() { -R::one() } else { R::one() };
    let tangent = sign / (zeta.abs() + (R::one() + zeta * zeta).sqrt());
    let cosine = (R::one() + tangent * tangent).sqrt().recip();
    let sine = cosine * tangent;
    for rows in [left, right] {
        let (a, b) = (rows[i], rows[j]);
        rows[i] = array(|k| cosine * a[k] - sine * b[k]);
        rows[j] = array(|k| sine * a[k] + cosine * b[k]);
    }
    true
}

fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    a.iter().zip(b).fold(R::zero(), |sum, (&a, &b)| R::mul_add(a, b, sum))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::samples::{Noise, residual};

    #[test]
    fn regular_matrices_are_solved() {
        let mut noise = Noise(3);
        for _ in 0..50 {
            let m: [[f64; 6]; 6] = noise.matrix();
            let b = noise.vector();
            let x = SingularValues::new(&m).solve(&b, 0.0);
            assert!(residual(&m, &x, &b) < 1e-13);
        }
    }

    #[test]
    fn singular_matrices_give_the_shortest_solution_of_least_squares() {
        let singular = [[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 2.0_f64]];
        let values = SingularValues::new(&singular);
        assert_eq!(values.rank(1e-24), 2);
        let x = values.solve(&[1.0, 3.0, 4.0], 0.0);
        for (found, expected) in x.into_iter().zip([1.0, 1.0, 2.0]) {
            assert!((found - expected).abs() < 1e-14, "{x:?}");
        }
    }

    #[test]
    fn a_matrix_of_zeros_moves_nothing() {
        let values = SingularValues::new(&[[0.0; 3]; 3]);
        assert_eq!(values.solve(&[1.0, 2.0, 3.0], 0.0), [0.0; 3]);
        assert_eq!(values.rank(0.0), 0);
    }

    #[test]
    fn units_do_not_matter() {
        let mut noise = Noise(5);
        for unit in [1e-12, 1e-6, 1e6, 1e12] {
            let m: [[f64; 6]; 6] = noise.matrix().map(|row: [f64; 6]| row.map(|x| unit * x));
            let b = noise.vector();
            let x = SingularValues::new(&m).solve(&b, 0.0);
            assert!(residual(&m, &x, &b) < 1e-13, "{unit:e}: {x:?}");
        }
    }

    #[test]
    fn directions_of_rounding_errors_are_left_alone() {
        let bound = 64.0 * 2.0 * f64::EPSILON;
        for (share, is_solved) in [(1.1, true), (0.9, false)] {
            let values = SingularValues::new(&[[3.0, 0.0], [0.0, 3.0 * share * bound]]);
            let [x, y] = values.solve(&[6.0, 1.0], 0.0);
            assert_eq!((x, y != 0.0), (2.0, is_solved), "{share}");
            assert_eq!(values.remainder(&[6.0, 1.0]) < 0.5, is_solved, "{share}");
        }
    }

    #[test]
    fn what_no_solution_reaches_remains() {
        let values = SingularValues::new(&[[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 2.0]]);
        // The part across (1, 1).
        assert!((values.remainder(&[1.0, 4.0, 7.0]) - 4.5).abs() < 1e-14);
        assert!(values.remainder(&[2.0, 2.0, 7.0]) < 1e-28);
    }

    #[test]
    fn damping_shortens_the_solution() {
        let values = SingularValues::new(&[[2.0, 0.0], [0.0, 1.0]]);
        let [x, y] = values.solve(&[3.0, 5.0], 0.5);
        assert!((x - 3.0 * 2.0 / 4.5).abs() < 1e-15 && (y - 5.0 / 1.5).abs() < 1e-15);
    }
}
