//! M = Lᵀ D L of a symmetric positive definite matrix, for right-hand sides with many columns.
//!
//! Velocities are eliminated from the last to the first. What hangs on a link is declared after it, so a tree
//! fills no entry: the zeros of M, which are passed over, are zeros of L (Featherstone, *Rigid Body Dynamics Algorithms*, section
//! 6.3). A row of right-hand sides is one vector, so all columns are solved for side by side.

use crate::number::real::Real;

/// The factors of a symmetric positive definite matrix.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rows<R, const N: usize> {
    /// L without its unit diagonal, below the diagonal; what stands elsewhere is of no use.
    factor: [[R; N]; N],
    /// 1 / D.
    inverse: [R; N],
}

impl<R: Real, const N: usize> Rows<R, N> {
    /// Factors a matrix, of which only the lower triangle is read; `None` where a pivot is not positive beyond
    /// rounding, by the bound of `Ldlt`.
    pub fn factor(matrix: &[[R; N]; N]) -> Option<Self> {
        let mut factor = *matrix;
        let mut inverse = [R::zero(); N];
        let mut threshold = R::zero();
        let ulps = R::epsilon() + R::epsilon();
        for k in (0..N).rev() {
            threshold += ulps;
            let row = factor[k];
            let pivot = row[k];
            if !((pivot - threshold * matrix[k][k]).is_positive() && pivot.is_positive()) {
                return None;
            }
            inverse[k] = pivot.recip();
            for i in 0..k {
                if row[i] == R::zero() {
                    continue;
                }
                let l = row[i] * inverse[k];
                factor[k][i] = l;
                for (entry, &other) in factor[i][..i + 1].iter_mut().zip(&row) {
                    *entry -= l * other;
                }
            }
        }
        Some(Self { factor, inverse })
    }

    /// Solves for all columns in place.
    pub fn solve<const C: usize>(&self, right: &mut [[R; C]; N]) {
        for k in (0..N).rev() {
            let (before, rest) = right.split_at_mut(k);
            let Some(load) = rest.first() else { continue };
            for (row, &l) in before.iter_mut().zip(&self.factor[k]) {
                subtract(row, l, load);
            }
        }
        for k in 0..N {
            let (before, rest) = right.split_at_mut(k);
            let Some(value) = rest.first_mut() else { continue };
            value.iter_mut().for_each(|entry| *entry *= self.inverse[k]);
            for (row, &l) in before.iter().zip(&self.factor[k]) {
                subtract(value, l, row);
            }
        }
    }
}

/// row ← row − l · other.
#[inline]
fn subtract<R: Real, const C: usize>(row: &mut [R; C], l: R, other: &[R; C]) {
    if l == R::zero() {
        return;
    }
    for (entry, &other) in row.iter_mut().zip(other) {
        *entry -= l * other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::Lu;
    use crate::linear::samples::Noise;

    /// Of a tree: two branches that share the first three velocities.
    fn tree(noise: &mut Noise) -> [[f64; 7]; 7] {
        let mut roots: [[f64; 7]; 7] = noise.matrix();
        for (i, row) in roots.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                if j > i || (i >= 5 && (3..5).contains(&j)) {
                    *entry = 0.0;
                }
            }
            row[i] += 2.0;
        }
        core::array::from_fn(|i| core::array::from_fn(|j| (0..7).map(|k| roots[k][i] * roots[k][j]).sum()))
    }

    #[test]
    fn all_columns_are_those_of_elimination_with_pivots() {
        let mut noise = Noise(3);
        for _ in 0..20 {
            let m = tree(&mut noise);
            let mut right: [[f64; 5]; 7] = core::array::from_fn(|_| {
                let row: [f64; 7] = noise.vector();
                core::array::from_fn(|j| row[j])
            });
            let given = right;
            let factors = Rows::factor(&m).unwrap();
            assert_eq!(factors.factor[6][3..5], [0.0, 0.0], "a tree fills nothing");
            factors.solve(&mut right);
            let other = Lu::factor(m).unwrap();
            for j in 0..5 {
                let x = other.solve(core::array::from_fn(|i| given[i][j]));
                let size = x.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
                for i in 0..7 {
                    assert!((x[i] - right[i][j]).abs() <= 1e-12 * size, "{} {}", x[i], right[i][j]);
                }
            }
        }
    }

    #[test]
    fn what_is_not_definite_is_refused() {
        assert!(Rows::factor(&[[0.0, 0.0], [0.0, 1.0]]).is_none());
        assert!(Rows::factor(&[[1.0, 1.0], [1.0, 1.0]]).is_none());
        assert!(Rows::factor(&[[-1.0, 0.0], [0.0, 1.0]]).is_none());
        assert!(Rows::factor(&[[1.0, 0.0], [0.0, f64::NAN]]).is_none());
    }
}
