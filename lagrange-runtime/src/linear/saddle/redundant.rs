//! The shortest of all multipliers that give the same forces, where rows of A depend on each other.
//!
//! Multipliers are determined up to the null space of Aᵀ. The shortest are those in the range of A, which is
//! the range of the matrix G of the combinations that give all rows from the independent ones; the projection
//! on it is Q Qᵀ with Q from a Gram–Schmidt of G, made twice, which is as orthogonal as rounding allows
//! (Giraud, Langou, Rozložník and van den Eshof, "Rounding error analysis of the classical Gram–Schmidt
//! orthogonalization process", 2005).

use crate::number::real::Real;

use super::vectors::{add_scaled, dot, magnitude, scale};

/// The multipliers that no others with the same forces are shorter than.
pub(in crate::linear) struct Shortest<R, const C: usize> {
    /// Orthonormal vectors that span them, in the first `rank` rows.
    basis: [[R; C]; C],
    rank: usize,
}

impl<R: Real, const C: usize> Shortest<R, C> {
    /// Those that combine rows of A, of which the first `rank` combinations give all from independent ones.
    pub(in crate::linear) fn new(combinations: [[R; C]; C], rank: usize) -> Self {
        let mut basis = combinations;
        for k in 0..rank.min(C) {
            let (before, rest) = basis.split_at_mut(k);
            let Some(vector) = rest.first_mut() else { break };
            for _ in 0..2 {
                // Sizes before squares, which could overflow. Nothing is zero here: an independent row is 1
                // in its own.
                let size = magnitude(vector).recip();
                scale(vector, size);
                for other in before.iter() {
                    let along = dot(other, vector);
                    add_scaled(vector, other, -along);
                }
            }
            let norm = dot(vector, vector).sqrt().recip();
            scale(vector, norm);
        }
        Self { basis, rank }
    }

    /// Replaces multipliers that leave the dependent rows at zero, one set a row, by the shortest that give
    /// the same forces.
    pub(in crate::linear) fn replace(&self, multipliers: &mut [[R; C]]) {
        // Rows that do nothing have no multipliers.
        for row in multipliers.iter_mut().filter(|row| row.iter().any(|x| !x.is_zero())) {
            let mut projection = [R::zero(); C];
            for direction in self.basis.iter().take(self.rank) {
                add_scaled(&mut projection, direction, dot(direction, row));
            }
            *row = projection;
        }
    }
}
