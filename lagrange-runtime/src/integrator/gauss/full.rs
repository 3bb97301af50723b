//! Newton's method with the derivatives of every stage, for long steps of stiff systems.
//!
//! If a stiff force turns within a step, no single matrix serves for all stages. Here the matrix of all
//! stages, Mᵢ δᵢⱼ − h aᵢⱼ (∂r/∂v)ᵢ − h² (A²)ᵢⱼ (∂r/∂q)ᵢ with r = f − M a, is eliminated as a whole. That
//! costs some ten times as much, so it is the second choice. The matrix is on the stack, so it serves systems
//! of moderate size.

use num_traits::Zero;

use super::stages::{Places, Stages, Verdict};
use crate::number::real::{Ordered, Real, extent, larger};
use crate::system::linearized::{Linearization, Linearized};

/// The most corrections of a solution.
const CORRECTIONS: usize = 20;

/// Unknowns of the largest system: its matrix takes 128 kB in `f64`.
const LARGEST: usize = 128;

/// A row of the matrix: coefficients of all unknowns, by stage.
type Row<R, const N: usize, const STAGES: usize> = [[R; N]; STAGES];

/// Rows by stage.
type Rows<R, const N: usize, const STAGES: usize> = [[Row<R, N, STAGES>; N]; STAGES];

impl<S, const N: usize, const K: usize, const STAGES: usize> Stages<'_, S, N, K, STAGES>
where
    S: Linearized<N, K>,
    S::Scalar: Ordered,
{
    /// Accelerations at the stages, from a guess; `None` if corrections do not shrink to rounding errors, or
    /// if the system is too large.
    #[cold]
    #[inline(never)]
    pub(super) fn solve_fully(&self, guess: Row<S::Scalar, N, STAGES>) -> Option<Row<S::Scalar, N, STAGES>> {
        if const { N * STAGES > LARGEST } {
            return None;
        }
        let mut a = guess;
        let mut before = None;
        for _ in 0..CORRECTIONS {
            let (mut rows, mut right) = self.equations(&a);
            eliminate(&mut rows, &mut right);
            let mut change = S::Scalar::zero();
            for (a, &delta) in a.iter_mut().flatten().zip(right.iter().flatten()) {
                *a += delta;
                if !a.is_finite() {
                    return None;
                }
                change = larger(change, extent(self.h * delta));
            }
            if self.verdict(&a, change, &mut before) == Verdict::Solved {
                return Some(a);
            }
        }
        None
    }

    /// The matrix and the right-hand side of a correction.
    fn equations(
        &self,
        a: &Row<S::Scalar, N, STAGES>,
    ) -> (Rows<S::Scalar, N, STAGES>, Row<S::Scalar, N, STAGES>) {
        let zero = S::Scalar::zero();
        let mut rows = [[[[zero; N]; STAGES]; N]; STAGES];
        let mut right = [[zero; N]; STAGES];
        let Places { q, v } = self.places(a);
        for i in 0..STAGES {
            let t = self.time(i);
            let found = self.system.accelerations_at(self.constants, t, &q[i], &v[i], self.u);
            let Linearization { mass, by_q, by_v } =
                self.system.linearization_at(self.constants, t, &q[i], &v[i], &a[i], self.u);
            for n in 0..N {
                for m in 0..N {
                    right[i][n] += mass[n][m] * (found[m] - a[i][m]);
                    rows[i][n][i][m] = mass[n][m];
                    for (j, row) in rows[i][n].iter_mut().enumerate() {
                        let once = self.mu[i][j] * self.weights[j];
                        let twice = (0..STAGES).fold(zero, |sum, k| {
                            sum + self.mu[i][k] * self.weights[k] * (self.mu[k][j] * self.weights[j])
                        });
                        row[m] -= once * by_v[n][m] + twice * by_q[n][m];
                    }
                }
            }
        }
        (rows, right)
    }
}

/// Solves in place, with partial pivoting. The solution of a singular matrix is not finite.
fn eliminate<R: Ordered, const N: usize, const STAGES: usize>(
    rows: &mut Rows<R, N, STAGES>,
    right: &mut Row<R, N, STAGES>,
) {
    let stage_of = |row: usize| (row / N, row % N);
    for column in 0..N * STAGES {
        let (j, m) = stage_of(column);
        let mut best = (j, m);
        for (i, n) in (column..N * STAGES).map(stage_of) {
            if rows[i][n][j][m].abs() > rows[best.0][best.1][j][m].abs() {
                best = (i, n);
            }
        }
        let (pivot, value) = (rows[best.0][best.1], right[best.0][best.1]);
        (rows[best.0][best.1], right[best.0][best.1]) = (rows[j][m], right[j][m]);
        (rows[j][m], right[j][m]) = (pivot, value);
        let inverse = pivot[j][m].recip();
        for (i, n) in (column + 1..N * STAGES).map(stage_of) {
            let factor = rows[i][n][j][m] * inverse;
            if factor != R::zero() {
                for (entry, &above) in rows[i][n].iter_mut().flatten().zip(pivot.iter().flatten()) {
                    *entry -= factor * above;
                }
                right[i][n] -= factor * value;
            }
        }
    }
    for column in (0..N * STAGES).rev() {
        let (j, m) = stage_of(column);
        right[j][m] *= rows[j][m][j][m].recip();
        for (i, n) in (0..column).map(stage_of) {
            right[i][n] -= rows[i][n][j][m] * right[j][m];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::samples::Noise;

    #[test]
    fn rows_of_all_stages_are_eliminated_with_pivots() {
        let mut noise = Noise(11);
        for is_zero in [false, true] {
            let mut rows: Rows<f64, 2, 3> = [[[[0.0; 2]; 3]; 2]; 3];
            rows.as_flattened_mut().iter_mut().for_each(|row| *row = [(); 3].map(|()| noise.vector()));
            if is_zero {
                // Without an exchange of rows the first pivot is zero.
                rows[0][0][0][0] = 0.0;
            }
            let wanted: [[f64; 2]; 3] = [(); 3].map(|()| noise.vector());
            let product = |row: &Row<f64, 2, 3>| -> f64 {
                row.as_flattened().iter().zip(wanted.as_flattened()).map(|(a, x)| a * x).sum()
            };
            let mut right = rows.map(|stage| stage.map(|row| product(&row)));
            eliminate(&mut rows, &mut right);
            for (found, expected) in right.as_flattened().iter().zip(wanted.as_flattened()) {
                assert!((found - expected).abs() < 1e-12, "{right:?} {wanted:?}");
            }
        }
    }
}
