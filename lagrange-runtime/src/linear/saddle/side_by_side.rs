//! Systems in the lanes of a vector, none of which depends on the others.

use super::Saddle;
use super::range::Range;
use super::reduced::Reduced;
use super::scaled::Scaled;
use crate::number::real::Real;

impl<R: Real, const N: usize, const C: usize> Saddle<R, N, C> {
    /// The system of numbers side by side whose rows are clearly independent in all lanes: by an orthogonal
    /// factorisation without pivots. `mass` is the whole of M.
    #[inline(always)]
    pub(super) fn side_by_side<const DEFINITE: bool>(
        mass: &[[R; N]; N],
        scaled: &Scaled<R, N, C>,
    ) -> Option<Self> {
        // Derivatives are beside a number, too.
        if R::PARTS > 1 || size_of::<R>() == size_of::<R::Lane>() {
            return None;
        }
        let range = Range::in_order(scaled)?;
        let split = range.split();
        let mut reduced = Reduced::new(mass, &split.null, C);
        reduced.factor::<DEFINITE>(C).ok()?;
        let mut this = Self::assemble(&split, &reduced, scaled.units, range.independence());
        // Units of coordinates without inertia are chosen for all lanes, and so are pivots of either sign.
        this.apart = DEFINITE && (0..N).all(|i| mass[i][i].is_positive());
        Some(this)
    }
}
