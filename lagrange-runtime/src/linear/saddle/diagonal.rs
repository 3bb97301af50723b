//! The saddle-point system of a diagonal mass matrix, by its Schur complement.

use crate::linear::Schur;
use crate::real::Real;

use super::vectors::{add_scaled, dot};
use super::{Defect, SaddlePoint};

/// A saddle-point system with a diagonal M: particles in Cartesian coordinates.
///
/// κ solves A M⁻¹ Aᵀ κ = y − A M⁻¹ r, whose matrix has the band of the constraints: links of a chain stay a chain. The
/// price is a coarser rank than that of [`Saddle`](super::Saddle): see [`Schur`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diagonal<R, const N: usize, const C: usize> {
    inverse_masses: [R; N],
    a: [[R; N]; C],
    schur: Schur<R, C>,
}

impl<R: Real, const N: usize, const C: usize> Diagonal<R, N, C> {
    /// Factors. An inverse mass of zero is that of a coordinate that nothing moves.
    #[inline]
    #[must_use]
    pub fn factor(inverse_masses: [R; N], a: &[[R; N]; C]) -> Self {
        let mut lower = [[R::zero(); C]; C];
        for i in 0..C {
            let mut row = a[i];
            for j in 0..N {
                row[j] *= inverse_masses[j];
            }
            for j in 0..=i {
                lower[i][j] = dot(&row, &a[j]);
            }
        }
        Self { inverse_masses, a: *a, schur: Schur::factor(lower) }
    }
}

impl<R: Real, const N: usize, const C: usize> SaddlePoint<R, N, C> for Diagonal<R, N, C> {
    #[inline]
    fn solve(&self, r: &[R; N], y: &[R; C]) -> ([R; N], [R; C]) {
        let mut free = *r;
        for i in 0..N {
            free[i] *= self.inverse_masses[i];
        }
        let mut lack = *y;
        for c in 0..C {
            lack[c] -= dot(&self.a[c], &free);
        }
        let kappa = self.schur.solve(lack);
        let mut force = *r;
        for c in 0..C {
            add_scaled(&mut force, &self.a[c], kappa[c]);
        }
        for i in 0..N {
            force[i] *= self.inverse_masses[i];
        }
        (force, kappa)
    }

    #[inline]
    fn rank(&self) -> usize {
        self.schur.rank()
    }

    fn defect(&self) -> Option<Defect> {
        let finite = self.inverse_masses.iter().all(|x| x.is_finite()) && self.schur.is_finite();
        if finite { None } else { Some(Defect::NotFinite) }
    }

    #[inline]
    fn is_dropped(&self, row: usize) -> bool {
        self.schur.is_dropped(row)
    }

    #[inline]
    fn vanishing(&self) -> Option<usize> {
        self.schur.vanishing()
    }
}
