//! The equations of motion in the null space of the constraints: B X = Z with B = Zᵀ M Z.

use crate::real::Real;

use super::vectors::{add_scaled, dot, where_positive};

/// B and what is solved with it. Vectors are rows; those of the null space have the indices `rank..N`.
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
            for j in rank..=i {
                matrix[i][j] = dot(&inertia[i], &basis[j]);
            }
        }
        Self { mass, basis, inertia, matrix, solution: *basis }
    }

    /// X.
    ///
    /// # Errors
    /// The index of the first pivot without a digit, in every lane. Lanes that alone have none become NaN.
    #[inline(always)]
    pub(super) fn factor<const DEFINITE: bool>(&mut self, rank: usize) -> Result<(), usize> {
        if DEFINITE { self.definite(rank) } else { self.indefinite(rank) }
    }

    /// By B = L D Lᵀ, of a B that must be positive definite.
    #[inline(always)]
    fn definite(&mut self, rank: usize) -> Result<(), usize> {
        let ulps = R::from_f64(4.0 * N as f64) * R::epsilon();
        let mut column = [R::zero(); N];
        for k in rank..N {
            // Rounding errors of B are relative to what its entries would be without cancellation, which for a
            // positive semidefinite M is at most N times the inertia without couplings.
            let mut uncoupled = [R::zero(); N];
            for i in 0..N {
                uncoupled[i] = self.mass[i][i] * self.basis[k][i];
            }
            let mut pivot = self.matrix[k][k];
            let excess = pivot - ulps * dot(&uncoupled, &self.basis[k]);
            // The second test catches a sum that is not positive to begin with.
            if !(excess.is_positive() && pivot.is_positive()) {
                pivot = where_positive(pivot, excess.min(pivot)).ok_or(k)?;
            }
            let inverse = pivot.recip();
            for i in k + 1..N {
                column[i] = self.matrix[i][k];
            }
            let above = self.solution[k];
            for i in k + 1..N {
                let l = column[i] * inverse;
                self.matrix[i][k] = l;
                for j in k + 1..=i {
                    self.matrix[i][j] = R::mul_add(-l, column[j], self.matrix[i][j]);
                }
                add_scaled(&mut self.solution[i], &above, -l);
            }
            for x in &mut self.solution[k] {
                *x *= inverse;
            }
        }
        for i in (rank..N).rev() {
            let below = self.solution[i];
            for k in rank..i {
                add_scaled(&mut self.solution[k], &below, -self.matrix[i][k]);
            }
        }
        Ok(())
    }

    /// By P B = L U with partial pivoting, of any regular B.
    #[inline(always)]
    fn indefinite(&mut self, rank: usize) -> Result<(), usize> {
        // What the entries of B would be without cancellation. Vectors and coordinates have similar sizes in the units
        // that they were made in, so the sum does for all.
        let mut total = R::zero();
        for k in rank..N {
            let mut sizes = [R::zero(); N];
            for j in 0..N {
                for i in 0..N {
                    sizes[i] += (self.mass[j][i] * self.basis[k][j]).abs();
                }
            }
            for i in 0..N {
                total += sizes[i] * self.basis[k][i].abs();
            }
        }
        let least = R::from_f64(4.0) * R::epsilon() * total;
        for i in rank..N {
            for j in rank..i {
                self.matrix[j][i] = self.matrix[i][j];
            }
        }
        for k in rank..N {
            let mut best = k;
            let mut size = self.matrix[k][k].abs().largest();
            for i in k + 1..N {
                let candidate = self.matrix[i][k].abs().largest();
                if candidate > size {
                    (best, size) = (i, candidate);
                }
            }
            // A search instead of `swap`, so that no index needs a check at run time.
            for i in k + 1..N {
                if i == best {
                    (self.matrix[k], self.matrix[i]) = (self.matrix[i], self.matrix[k]);
                    (self.solution[k], self.solution[i]) = (self.solution[i], self.solution[k]);
                }
            }
            let mut pivot = self.matrix[k][k];
            let excess = pivot.abs() - least;
            if !excess.is_positive() {
                pivot = where_positive(pivot, excess).ok_or(k)?;
            }
            // U with a unit diagonal, so that the back-substitution has no divisions.
            let inverse = pivot.recip();
            for j in k..N {
                self.matrix[k][j] *= inverse;
            }
            for x in &mut self.solution[k] {
                *x *= inverse;
            }
            let (above, known) = (self.matrix[k], self.solution[k]);
            for i in k + 1..N {
                let l = self.matrix[i][k];
                for j in k..N {
                    self.matrix[i][j] = R::mul_add(-l, above[j], self.matrix[i][j]);
                }
                add_scaled(&mut self.solution[i], &known, -l);
            }
        }
        for i in (rank..N).rev() {
            let below = self.solution[i];
            for k in rank..i {
                add_scaled(&mut self.solution[k], &below, -self.matrix[k][i]);
            }
        }
        Ok(())
    }

    /// The motion Z c without inertia that makes pivot `direction` vanish: the combination of the vectors up to that
    /// one whose products with the vectors before it are zero.
    pub(super) fn motion<const DEFINITE: bool>(&self, rank: usize, direction: usize) -> [R; N] {
        let mut c = [R::zero(); N];
        let mut motion = [R::zero(); N];
        let end = N.min(direction + 1);
        for k in (rank..end).rev() {
            let mut sum = if k == direction { R::one() } else { R::zero() };
            for i in k + 1..end {
                // Both factors are unit triangular: Lᵀ, or U.
                sum -= if DEFINITE { self.matrix[i][k] } else { self.matrix[k][i] } * c[i];
            }
            c[k] = sum;
            add_scaled(&mut motion, &self.basis[k], sum);
        }
        motion
    }
}
