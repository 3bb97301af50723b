//! The equations of motion in the null space of the constraints: B X = Z with B = Zᵀ M Z.

use crate::number::elements::Each;
use crate::number::real::Real;

use super::symmetric;
use super::vectors::{add_scaled, dot, scale, where_positive};

/// B and the vectors that are solved with it. Vectors are rows; those of the null space have the indices
/// `rank..N`.
pub(super) struct Reduced<'a, R, const N: usize> {
    pub(super) mass: &'a [[R; N]; N],
    /// Z.
    basis: &'a [[R; N]; N],
    /// M Z.
    pub(super) inertia: [[R; N]; N],
    /// B, then its factors.
    matrix: [[R; N]; N],
    /// X = B⁻¹ Z, once factored.
    pub(super) solution: [[R; N]; N],
}

impl<'a, R: Real, const N: usize> Reduced<'a, R, N> {
    #[inline(always)]
    pub(super) fn new(mass: &'a [[R; N]; N], basis: &'a [[R; N]; N], rank: usize) -> Self {
        let mut inertia = [[R::zero(); N]; N];
        let mut matrix = [[R::zero(); N]; N];
        for k in rank..N {
            for j in 0..N {
                add_scaled(&mut inertia[k], &mass[j], basis[k][j]);
            }
        }
        for i in rank..N {
            for j in rank..i + 1 {
                matrix[i][j] = dot(&inertia[i], &basis[j]);
            }
        }
        Self { mass, basis, inertia, matrix, solution: *basis }
    }

    /// X.
    ///
    /// # Errors
    /// The index of the first pivot that carries no digit in any lane. If only some lanes lack digits, these
    /// become NaN.
    #[inline(always)]
    pub(super) fn factor<const DEFINITE: bool>(&mut self, rank: usize) -> Result<(), usize> {
        if DEFINITE { self.definite(rank) } else { self.indefinite(rank) }
    }

    /// By B = L D Lᵀ, of a B that must be positive definite.
    #[inline(always)]
    fn definite(&mut self, rank: usize) -> Result<(), usize> {
        let ulps = R::from_f64(4.0 * N as f64) * R::epsilon();
        let Self { mass, basis, matrix, solution, .. } = self;
        let mut column = [R::zero(); N];
        for k in rank..N {
            // Rounding errors of B are relative to what its entries would be without cancellation, which for
            // a positive semidefinite M is at most N times the inertia without couplings.
            let mut uncoupled = basis[k];
            for (i, x) in uncoupled.iter_mut().enumerate() {
                *x *= mass[i][i];
            }
            let mut pivot = matrix[k][k];
            let excess = pivot - ulps * dot(&uncoupled, &basis[k]);
            // The second test catches a sum that is not positive to begin with.
            if !(excess.is_positive() && pivot.is_positive()) {
                pivot = where_positive(pivot, excess.min(pivot)).ok_or(k)?;
            }
            let inverse = pivot.recip();
            for i in k + 1..N {
                column[i] = matrix[i][k];
            }
            let above = solution[k];
            for i in k + 1..N {
                let l = column[i] * inverse;
                matrix[i][k] = l;
                for j in k + 1..i + 1 {
                    matrix[i][j] = R::mul_add(-l, column[j], matrix[i][j]);
                }
                add_scaled(&mut solution[i], &above, -l);
            }
            scale(&mut solution[k], inverse);
        }
        for i in (rank..N).rev() {
            let below = solution[i];
            for k in rank..i {
                add_scaled(&mut solution[k], &below, -matrix[i][k]);
            }
        }
        Ok(())
    }

    /// By P B = L U with partial pivoting, of any regular B.
    #[inline(always)]
    fn indefinite(&mut self, rank: usize) -> Result<(), usize> {
        let Self { mass, basis, matrix, solution, .. } = self;
        // The entries of B as they would be without cancellation. In the units of the vectors they all have
        // similar sizes, so the sum serves for all.
        let mut total = R::zero();
        for vector in basis.iter().skip(rank) {
            let sizes = vector.each(R::abs);
            for (row, &size) in mass.iter().zip(&sizes) {
                total += dot(&row.each(R::abs), &sizes) * size;
            }
        }
        let least = R::from_f64(4.0) * R::epsilon() * total;
        *matrix = symmetric(matrix);
        for k in rank..N {
            let mut best = k;
            let mut size = matrix[k][k].abs().largest();
            for (i, row) in matrix.iter().enumerate().skip(k + 1) {
                let candidate = row[k].abs().largest();
                if candidate > size {
                    (best, size) = (i, candidate);
                }
            }
            // A search instead of `swap`, so that no index needs a check at run time.
            for i in k + 1..N {
                if i == best {
                    (matrix[k], matrix[i]) = (matrix[i], matrix[k]);
                    (solution[k], solution[i]) = (solution[i], solution[k]);
                }
            }
            let mut pivot = matrix[k][k];
            let excess = pivot.abs() - least;
            if !excess.is_positive() {
                pivot = where_positive(pivot, excess).ok_or(k)?;
            }
            // U with a unit diagonal, so that the back-substitution has no divisions.
            let inverse = pivot.recip();
            scale(&mut matrix[k], inverse);
            scale(&mut solution[k], inverse);
            let (above, known) = (matrix[k], solution[k]);
            for i in k + 1..N {
                let l = matrix[i][k];
                add_scaled(&mut matrix[i], &above, -l);
                add_scaled(&mut solution[i], &known, -l);
            }
        }
        for i in (rank..N).rev() {
            let below = solution[i];
            for k in rank..i {
                add_scaled(&mut solution[k], &below, -matrix[k][i]);
            }
        }
        Ok(())
    }

    /// The motion Z c without inertia that makes pivot `direction` vanish: the combination of the vectors up
    /// to that one whose products with the vectors before it are zero.
    pub(super) fn motion<const DEFINITE: bool>(&self, rank: usize, direction: usize) -> [R; N] {
        let mut c = [R::zero(); N];
        let mut motion = [R::zero(); N];
        // Ranges that end at a constant, so that no index needs a check at run time.
        for k in (rank..N).rev() {
            if k > direction {
                continue;
            }
            c[k] = if k == direction { R::one() } else { R::zero() };
            for i in k + 1..N {
                if i <= direction {
                    // Both factors are unit triangular: Lᵀ, or U.
                    let known = if DEFINITE { self.matrix[i][k] } else { self.matrix[k][i] } * c[i];
                    c[k] -= known;
                }
            }
            add_scaled(&mut motion, &self.basis[k], c[k]);
        }
        motion
    }
}
