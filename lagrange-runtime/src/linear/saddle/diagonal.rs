//! The saddle-point system of a diagonal mass matrix, by its Schur complement.

use crate::linear::Independence;
use crate::linear::schur::{SMALL, Schur};
use crate::number::elements::Each;
use crate::number::real::Real;

use super::vectors::{add_product, dot, multiply, subtract_product, transposed};
use super::{Defect, SaddlePoint};

/// A saddle-point system with a diagonal M: particles in Cartesian coordinates.
///
/// κ solves A M⁻¹ Aᵀ κ = y − A M⁻¹ r.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diagonal<R, const N: usize, const C: usize> {
    inverse_masses: [R; N],
    /// M⁻¹ Aᵀ.
    drift: [[R; C]; N],
    /// A M⁻¹. For small systems S⁻¹ A M⁻¹, the change of v by a component of the lack.
    rows: [[R; N]; C],
    schur: Schur<R, C>,
}

impl<R: Real, const N: usize, const C: usize> Diagonal<R, N, C> {
    /// Factors. An inverse mass of zero is that of a coordinate that nothing moves; a negative one is a
    /// [defect](SaddlePoint::negative).
    ///
    /// A row that reaches only coordinates that nothing moves counts as [vanishing](SaddlePoint::vanishing).
    #[inline]
    #[must_use]
    pub fn factor(inverse_masses: [R; N], a: &[[R; N]; C]) -> Self {
        let mut lower = [[R::zero(); C]; C];
        let mut rows = *a;
        for c in 0..C {
            multiply(&mut rows[c], &inverse_masses);
            for d in 0..c + 1 {
                lower[c][d] = dot(&rows[c], &a[d]);
            }
        }
        let drift = transposed(&rows);
        let schur = Schur::factor_with(&lower, &mut rows, || (inverse_masses, *a));
        Self { inverse_masses, drift, rows, schur }
    }
}

/// The first coordinate whose mass is zero, so that its inverse is infinite.
pub(super) fn without_inertia<R: Real>(inverse_masses: &[R]) -> Option<usize> {
    inverse_masses.iter().position(|x| x.is_positive() && !x.is_finite())
}

impl<R: Real, const N: usize, const C: usize> SaddlePoint<R, N, C> for Diagonal<R, N, C> {
    type Gradients = [[R; N]; C];

    #[inline]
    fn solve(&self, r: &[R; N], y: &[R; C]) -> ([R; N], [R; C]) {
        let lack = subtract_product(y, &self.drift, r);
        let kappa = self.schur.solve(lack);
        let mut free = *r;
        multiply(&mut free, &self.inverse_masses);
        (add_product(&free, &self.rows, if C <= SMALL { &lack } else { &kappa }), kappa)
    }

    #[inline]
    fn independence(&self) -> Independence<R> {
        self.schur.independence()
    }

    #[inline]
    fn apart(&self) -> Option<R> {
        self.schur.apart()
    }

    fn defect(&self) -> Option<Defect> {
        let finite = self.inverse_masses.iter().all(|x| x.is_finite()) && self.schur.is_finite();
        match self.negative().or_else(|| without_inertia(&self.inverse_masses)) {
            Some(coordinate) => Some(Defect::Singular { coordinate }),
            None if finite => None,
            None => Some(Defect::NotFinite),
        }
    }

    #[inline]
    fn negative(&self) -> Option<usize> {
        self.inverse_masses.iter().position(|&x| (-x).is_positive())
    }

    #[inline]
    fn vanishing(&self) -> Option<usize> {
        self.schur.vanishing()
    }

    #[inline]
    fn units(&self) -> [R; N] {
        self.inverse_masses.each(R::sqrt)
    }
}
