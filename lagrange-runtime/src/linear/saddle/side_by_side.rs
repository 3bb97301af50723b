//! Systems in the lanes of a vector, none of which depends on the others.

use super::range::Range;
use super::reduced::Reduced;
use super::scaled::Scaled;
use super::{Saddle, symmetric};
use crate::number::real::Real;

impl<R: Real, const N: usize, const C: usize> Saddle<R, N, C> {
    /// As [`Saddle::factor`], for lanes that are kept apart. Where rows are clearly independent in all of
    /// them, an orthogonal factorisation in the order given needs no pivots that they would share.
    #[inline]
    #[must_use]
    pub fn factor_side_by_side(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Self {
        // Derivatives stand beside a number, too.
        let has_lanes = R::PARTS == 1 && size_of::<R>() > size_of::<R::Lane>();
        if has_lanes && let Some(this) = Self::side_by_side(mass, a) { this } else { Self::factor(mass, a) }
    }

    #[inline(always)]
    fn side_by_side(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Option<Self> {
        let (full, scaled) = (symmetric(mass), Scaled::new(mass, a));
        let range = Range::in_order(&scaled)?;
        let split = range.split();
        let mut reduced = Reduced::new(&full, &split.null, C);
        reduced.factor::<true>(C).ok()?;
        let mut this = Self::assemble(&split, &reduced, scaled.units, range.independence());
        // Units of coordinates without inertia are chosen for all lanes.
        this.apart = (0..N).all(|i| mass[i][i].is_positive());
        Some(this)
    }
}
