//! P M = L U of any regular matrix by Gaussian elimination with partial pivoting.
//!
//! Rows are exchanged so that the largest entry of a column is the pivot; with several lanes the choice is
//! common to all of them and follows the largest lane. Cost: n³/3 multiplications to factor, n² to solve
//! (Higham, ch. 9). For the indefinite ∂²L/∂v² of a Lagrangian given directly; use [`Ldlt`](super::Ldlt)
//! where M is definite.

use crate::number::elements::{Each, array};
use crate::number::real::Real;

/// The factors of a regular matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lu<R, const N: usize> {
    /// L without its unit diagonal below, U above; the diagonal of U is in `inverse`.
    factor: [[R; N]; N],
    /// 1 / diagonal of U.
    inverse: [R; N],
    /// Row of M that stands in each row of the factors.
    order: [usize; N],
}

impl<R: Real, const N: usize> Lu<R, N> {
    /// Factors `matrix`.
    ///
    /// # Errors
    /// The index of the first column without a pivot above rounding: 2Nε times the sum of the column's
    /// magnitudes in M.
    #[inline]
    pub fn factor(matrix: [[R; N]; N]) -> Result<Self, usize> {
        let mut factor = matrix;
        let mut inverse = [R::zero(); N];
        let mut order = array(|i| i);
        let ulps = R::from_f64(2.0 * N as f64) * R::epsilon();
        for k in 0..N {
            let mut best = k;
            let mut size = factor[k][k].abs().largest();
            let mut least = matrix[0][k].abs();
            for i in 0..N {
                // The sum needs no comparison, so it serves several lanes at once.
                if i > 0 {
                    least += matrix[i][k].abs();
                }
                let candidate = factor[i][k].abs().largest();
                if i > k && candidate > size {
                    (best, size) = (i, candidate);
                }
            }
            // A search instead of `swap`, so that no index needs a check at run time.
            for i in k + 1..N {
                if i == best {
                    (factor[k], factor[i]) = (factor[i], factor[k]);
                    (order[k], order[i]) = (order[i], order[k]);
                }
            }
            let pivot = factor[k][k];
            if !(pivot.abs() - ulps * least).is_positive() {
                return Err(k);
            }
            inverse[k] = pivot.recip();
            let above = factor[k];
            for row in factor.iter_mut().skip(k + 1) {
                let l = row[k] * inverse[k];
                row[k] = l;
                for j in k + 1..N {
                    row[j] -= l * above[j];
                }
            }
        }
        Ok(Self { factor, inverse, order })
    }

    /// x with M x = `b`.
    #[inline]
    #[must_use]
    pub fn solve(&self, b: [R; N]) -> [R; N] {
        let mut x = self.order.each(|row| b.get(row).copied().unwrap_or(R::zero()));
        for i in 0..N {
            for k in 0..i {
                x[i] -= self.factor[i][k] * x[k];
            }
        }
        for i in (0..N).rev() {
            for k in i + 1..N {
                x[i] -= self.factor[i][k] * x[k];
            }
            x[i] *= self.inverse[i];
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::samples::{Noise, residual};

    fn check<const N: usize>() {
        let mut noise = Noise(N as u64 + 100);
        for scale in [1.0, 1e-4, 1e-8] {
            for _ in 0..50 {
                let mut m: [[f64; N]; N] = noise.matrix();
                // Two nearly equal rows make it ill-conditioned; a zero in the corner needs pivoting.
                if N > 2 {
                    let near: [f64; N] = noise.vector();
                    for j in 0..N {
                        m[2][j] = m[1][j] + scale * near[j];
                    }
                    m[0][0] = 0.0;
                }
                let b = noise.vector();
                let x = Lu::factor(m).unwrap().solve(b);
                assert!(residual(&m, &x, &b) < 8.0 * N as f64 * f64::EPSILON, "size {N}, scale {scale}");
            }
        }
    }

    #[test]
    #[cfg_attr(miri, ignore = "takes minutes there")]
    fn solves_random_matrices_to_a_small_backward_error() {
        check::<1>();
        check::<2>();
        check::<3>();
        check::<7>();
        check::<20>();
    }

    #[test]
    fn an_indefinite_matrix_without_a_first_pivot_is_solved() {
        assert_eq!(Lu::factor([[0.0, 1.0], [1.0, 0.0]]).unwrap().solve([3.0, 5.0]), [5.0, 3.0]);
    }

    #[test]
    fn singular_matrices_name_the_column() {
        assert_eq!(Lu::factor([[1.0, 2.0], [2.0, 4.0]]), Err(1));
        assert_eq!(Lu::factor([[0.0, 2.0], [0.0, 4.0]]), Err(0));
        assert_eq!(Lu::factor([[1.0, f64::NAN], [0.0, 1.0]]), Err(1));
        let mut noise = Noise(9);
        for _ in 0..100 {
            let mut m: [[f64; 5]; 5] = noise.matrix();
            m[4] = core::array::from_fn(|j| m[0][j] + m[1][j] - m[2][j]);
            assert_eq!(Lu::factor(m), Err(4));
        }
    }

    #[test]
    fn badly_scaled_columns_are_not_singular() {
        assert!(Lu::factor([[1e-200, 0.0], [0.0, 1e200]]).is_ok());
    }
}
