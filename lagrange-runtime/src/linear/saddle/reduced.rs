//! The equations of motion in the null space of the constraints: B X = Z with B = Zᵀ M Z.

use crate::real::Real;

use super::Defect;
use super::vectors::{add_scaled, dot, where_positive};

/// B and what is solved with it. Vectors are rows; those of the null space have the indices `rank..N`.
pub(super) struct Reduced<R, const N: usize> {
    matrix: [[R; N]; N],
    /// Z.
    basis: [[R; N]; N],
    /// M Z.
    pub(super) inertia: [[R; N]; N],
    /// X = B⁻¹ Z, once factored.
    pub(super) solution: [[R; N]; N],
    /// Of the coordinates.
    scale: [R; N],
    /// The sum of all magnitudes in the scaled M: what rounding errors of B are relative to.
    total: R,
}

impl<R: Real, const N: usize> Reduced<R, N> {
    /// B of a basis in the user's units; `scale` holds the units in which the basis is orthonormal.
    #[inline(always)]
    pub(super) fn new(mass: &[[R; N]; N], basis: &[[R; N]; N], scale: &[R; N], rank: usize) -> Self {
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
        let mut sums = [R::zero(); N];
        for i in 0..N {
            for j in 0..N {
                sums[j] += mass[i][j].abs() * scale[i];
            }
        }
        Self { matrix, basis: *basis, inertia, solution: *basis, scale: *scale, total: dot(&sums, scale) }
    }

    /// The size below which a pivot is a rounding error: 4ε for each unit of scaled mass that went into it.
    #[inline(always)]
    fn threshold(&self) -> R {
        R::from_f64(4.0) * R::epsilon() * self.total
    }

    /// X by B = L D Lᵀ, of a B that must be positive definite.
    #[inline(always)]
    pub(super) fn definite(&mut self, rank: usize) -> Result<(), Defect> {
        let threshold = self.threshold();
        let mut column = [R::zero(); N];
        for k in rank..N {
            let mut pivot = self.matrix[k][k];
            if !(pivot - threshold).is_positive() {
                pivot =
                    where_positive(pivot, pivot - threshold).ok_or_else(|| self.symmetric_defect(rank, k))?;
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

    /// X by P B = L U with partial pivoting, of any regular B.
    #[inline(always)]
    pub(super) fn indefinite(&mut self, rank: usize) -> Result<(), Defect> {
        let threshold = self.threshold();
        for i in rank..N {
            for j in rank..i {
                self.matrix[j][i] = self.matrix[i][j];
            }
        }
        let mut inverse = [R::zero(); N];
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
            let excess = pivot.abs() - threshold;
            if !excess.is_positive() {
                pivot = where_positive(pivot, excess).ok_or_else(|| self.upper_defect(rank, k, &inverse))?;
            }
            inverse[k] = pivot.recip();
            let (above, known) = (self.matrix[k], self.solution[k]);
            for i in k + 1..N {
                let l = self.matrix[i][k] * inverse[k];
                for j in k + 1..N {
                    self.matrix[i][j] = R::mul_add(-l, above[j], self.matrix[i][j]);
                }
                add_scaled(&mut self.solution[i], &known, -l);
            }
        }
        for k in (rank..N).rev() {
            for i in k + 1..N {
                let below = self.solution[i];
                add_scaled(&mut self.solution[k], &below, -self.matrix[k][i]);
            }
            for x in &mut self.solution[k] {
                *x *= inverse[k];
            }
        }
        Ok(())
    }

    /// The null direction of B where D\[k] vanishes: L₁₁ᵀ c = −l, 1 in place k.
    #[cold]
    #[inline(never)]
    fn symmetric_defect(&self, rank: usize, k: usize) -> Defect {
        let mut c = [R::zero(); N];
        for j in (rank..N.min(k + 1)).rev() {
            let mut sum = if j == k { R::one() } else { R::zero() };
            for i in j + 1..N.min(k + 1) {
                sum -= self.matrix[i][j] * c[i];
            }
            c[j] = sum;
        }
        self.defect(rank, &c)
    }

    /// The null direction of B where U\[k]\[k] vanishes: U₁₁ c = −u, 1 in place k.
    #[cold]
    #[inline(never)]
    fn upper_defect(&self, rank: usize, k: usize, inverse: &[R; N]) -> Defect {
        let mut c = [R::zero(); N];
        for j in (rank..N.min(k + 1)).rev() {
            let mut sum = R::zero();
            for i in j + 1..N.min(k + 1) {
                sum -= self.matrix[j][i] * c[i];
            }
            c[j] = if j == k { R::one() } else { sum * inverse[j] };
        }
        self.defect(rank, &c)
    }

    /// Names the largest component of Z c, in scaled coordinates.
    fn defect(&self, rank: usize, c: &[R; N]) -> Defect {
        if !self.total.is_finite() {
            return Defect::NotFinite;
        }
        let mut direction = [R::zero(); N];
        for k in rank..N {
            add_scaled(&mut direction, &self.basis[k], c[k]);
        }
        let (mut coordinate, mut size) = (0, R::zero().largest());
        for i in 0..N {
            let candidate = (direction[i] / self.scale[i]).abs().largest();
            if candidate > size {
                (coordinate, size) = (i, candidate);
            }
        }
        Defect::Singular { coordinate }
    }
}
