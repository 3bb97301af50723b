//! M = L D Lᵀ of a symmetric positive definite matrix, L unit lower triangular, D diagonal.
//!
//! Step k subtracts from each later row i of the lower triangle L\[i]\[k] · column k. The inner loop
//! runs over contiguous memory and has no sum to reassociate, so it vectorises. Cost: n³/6 multiplications to
//! factor (n³/3 flops), n² to solve. Backward stable without pivoting (Higham, "Accuracy and Stability of
//! Numerical Algorithms", 2nd ed., ch. 10). Not for indefinite matrices: those stop at the first pivot that
//! is not positive. Loops count: the compiler for graphics processors unrolls no loop over references.

use crate::number::elements::array;
use crate::number::real::Real;

/// The factors of a symmetric positive definite matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ldlt<R, const N: usize> {
    /// L without its unit diagonal, below the diagonal. The other entries are not used.
    factor: [[R; N]; N],
    /// 1 / D.
    inverse: [R; N],
}

impl<R: Real, const N: usize> Ldlt<R, N> {
    /// Factors `matrix`, of which only the lower triangle is read.
    ///
    /// # Errors
    /// The index of the first pivot that is not positive beyond rounding: D\[i] ≤ 2(i + 1) ε M\[i]\[i], or
    /// NaN.
    #[inline]
    pub fn factor(matrix: [[R; N]; N]) -> Result<Self, usize> {
        let mut factor = matrix;
        let mut inverse = [R::zero(); N];
        let mut column = [R::zero(); N];
        let mut threshold = R::zero();
        let ulps = R::epsilon() + R::epsilon();
        for k in 0..N {
            threshold += ulps;
            let pivot = factor[k][k];
            // The second test catches a diagonal that was not positive to begin with.
            if !((pivot - threshold * matrix[k][k]).is_positive() && pivot.is_positive()) {
                return Err(k);
            }
            inverse[k] = pivot.recip();
            for i in k + 1..N {
                column[i] = factor[i][k];
            }
            for i in k + 1..N {
                let l = column[i] * inverse[k];
                factor[i][k] = l;
                for j in k + 1..i + 1 {
                    factor[i][j] -= l * column[j];
                }
            }
        }
        Ok(Self { factor, inverse })
    }

    /// x with M x = `b`.
    #[inline]
    #[must_use]
    pub fn solve(&self, b: [R; N]) -> [R; N] {
        let mut x = b;
        for i in 0..N {
            for k in 0..i {
                x[i] = R::mul_add(-self.factor[i][k], x[k], x[i]);
            }
        }
        x = array(|i| x[i] * self.inverse[i]);
        for i in (0..N).rev() {
            for k in 0..i {
                x[k] = R::mul_add(-self.factor[i][k], x[i], x[k]);
            }
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::samples::{Noise, residual};

    /// B Bᵀ + shift·1 with random B: positive definite, ill-conditioned for a small shift.
    fn positive_definite<const N: usize>(noise: &mut Noise, shift: f64) -> [[f64; N]; N] {
        let b: [[f64; N]; N] = noise.matrix();
        let mut m = [[0.0; N]; N];
        for i in 0..N {
            for j in 0..N {
                // One column short of full rank, so that `shift` alone makes it definite.
                m[i][j] = (1..N).map(|k| b[i][k] * b[j][k]).sum();
            }
            m[i][i] += shift;
        }
        m
    }

    fn check<const N: usize>() {
        let mut noise = Noise(N as u64 + 1);
        for shift in [1.0, 1e-3, 1e-6, 1e-10] {
            for _ in 0..50 {
                let m = positive_definite::<N>(&mut noise, shift);
                let b = noise.vector();
                let x = Ldlt::factor(m).unwrap().solve(b);
                assert!(residual(&m, &x, &b) < 4.0 * N as f64 * f64::EPSILON, "size {N}, shift {shift}");
                let mut wrong = x;
                wrong[N - 1] *= 1.0 + 1e-9;
                assert!(residual(&m, &wrong, &b) > 4.0 * N as f64 * f64::EPSILON || x[N - 1].abs() < 1e-3);
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
    fn the_upper_triangle_is_not_read() {
        let m = [[4.0, f64::NAN], [2.0, 3.0]];
        assert_eq!(Ldlt::factor(m).unwrap().solve([8.0, 8.0]), [1.0, 2.0]);
    }

    #[test]
    fn singular_and_indefinite_matrices_name_the_pivot() {
        assert_eq!(Ldlt::factor([[1.0, 1.0], [1.0, 1.0]]), Err(1));
        assert_eq!(Ldlt::factor([[0.0, 0.0], [0.0, 1.0]]), Err(0));
        assert_eq!(Ldlt::factor([[2.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]), Err(1));
        assert_eq!(Ldlt::factor([[1.0, 0.0], [0.0, f64::NAN]]), Err(1));
        let mut noise = Noise(5);
        let mut refused = 0;
        for _ in 0..100 {
            let m = positive_definite::<6>(&mut noise, 0.0);
            match Ldlt::factor(m) {
                Err(pivot) => {
                    assert_eq!(pivot, 5);
                    refused += 1;
                }
                // Small earlier pivots raise the rounding errors of the last one.
                Ok(factors) => assert!(factors.inverse[5] * m[5][5] > 1e9),
            }
        }
        assert!(refused > 60, "only {refused} of 100 singular matrices are refused");
    }

    #[test]
    fn tiny_and_huge_scales_are_not_singular() {
        let m = [[1e-200, 0.0], [0.0, 1e200]];
        assert!(Ldlt::factor(m).is_ok());
    }
}
