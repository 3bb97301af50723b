//! The shortest of all multipliers that give the same forces, where rows of A depend on each other.
//!
//! Multipliers are determined up to the null space of Aᵀ. The shortest are those in the range of A, which is
//! the range of the matrix G of the combinations that give all rows from the independent ones; the projection
//! on it is Q Qᵀ with Q from a Gram–Schmidt of G, made twice, which is as orthogonal as rounding allows
//! (Giraud, Langou, Rozložník and van den Eshof, "Rounding error analysis of the classical Gram–Schmidt
//! orthogonalization process", 2005).

use crate::number::real::Real;

use super::vectors::{add_scaled, dot, magnitude, scale};

/// Replaces multipliers that leave the dependent rows at zero, one set a row, by the shortest that give the
/// same forces.
pub(in crate::linear) fn shorten<R: Real, const C: usize>(
    multipliers: &mut [[R; C]],
    combinations: &[[R; C]; C],
    rank: usize,
) {
    let basis = basis(combinations, rank);
    // Rows that do nothing have no multipliers.
    for row in multipliers.iter_mut().filter(|row| row.iter().any(|x| !x.is_zero())) {
        *row = project(&basis, row, rank);
    }
}

/// Orthonormal vectors that span the first `rank` of `combinations`.
fn basis<R: Real, const C: usize>(combinations: &[[R; C]; C], rank: usize) -> [[R; C]; C] {
    let mut basis = *combinations;
    for k in 0..rank.min(C) {
        let (before, rest) = basis.split_at_mut(k);
        let Some(vector) = rest.first_mut() else { break };
        for _ in 0..2 {
            // Sizes before squares, which could overflow. Nothing is zero here: an independent row is 1 in
            // its own.
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
    basis
}

/// The projection of `vector` on the first `rank` vectors of an orthonormal basis.
#[inline]
fn project<R: Real, const C: usize>(basis: &[[R; C]; C], vector: &[R; C], rank: usize) -> [R; C] {
    let mut projection = [R::zero(); C];
    for direction in basis.iter().take(rank) {
        add_scaled(&mut projection, direction, dot(direction, vector));
    }
    projection
}
