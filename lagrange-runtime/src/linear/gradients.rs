//! The gradients of constraints as a matrix A, a row each: whole, or without the entries that are always
//! zero.

use crate::number::elements::Each;
use crate::number::real::Real;

/// The structure of a sparse A, and of the factors of A M⁻¹ Aᵀ with a diagonal M, as it is known at
/// expansion.
///
/// Constraints are eliminated in an order of their own, one in each step. All lists are ascending.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pattern {
    /// By step: the constraint.
    pub order: &'static [usize],
    /// By step: the coordinates that the constraint depends on.
    pub coordinates: &'static [&'static [usize]],
    /// By step: the earlier steps whose constraints share a coordinate with it.
    pub coupled: &'static [&'static [usize]],
    /// By step: the earlier steps at which its row of the factor L may differ from zero.
    pub earlier: &'static [&'static [usize]],
    /// By step: the later steps at which its column of L may differ from zero.
    pub later: &'static [&'static [usize]],
}

impl Pattern {
    /// The structure of which nothing is known.
    pub const NONE: Self = Self { order: &[], coordinates: &[], coupled: &[], earlier: &[], later: &[] };
}

/// The gradients of constraints.
pub trait Gradients<R, const N: usize, const C: usize> {
    /// A x.
    fn rates(&self, x: &[R; N]) -> [R; C];

    /// |A| x.
    fn slopes(&self, x: &[R; N]) -> [R; C];

    /// |A|ᵀ |κ|.
    fn borne(&self, kappa: &[R; C]) -> [R; N];

    /// A.
    fn rows(&self) -> [[R; N]; C];
}

impl<R: Real, const N: usize, const C: usize> Gradients<R, N, C> for [[R; N]; C] {
    #[inline(always)]
    fn rates(&self, x: &[R; N]) -> [R; C] {
        self.each_ref().each(|row| row.iter().zip(x).fold(R::zero(), |sum, (&a, &x)| R::mul_add(a, x, sum)))
    }

    #[inline(always)]
    fn slopes(&self, x: &[R; N]) -> [R; C] {
        let add = |sum, (a, &x): (&R, &R)| R::mul_add(a.abs(), x, sum);
        self.each_ref().each(|row| row.iter().zip(x).fold(R::zero(), add))
    }

    #[inline]
    fn borne(&self, kappa: &[R; C]) -> [R; N] {
        let mut sums = [R::zero(); N];
        for (row, kappa) in self.iter().zip(kappa) {
            for (sum, a) in sums.iter_mut().zip(row) {
                *sum = R::mul_add(a.abs(), kappa.abs(), *sum);
            }
        }
        sums
    }

    #[inline]
    fn rows(&self) -> [[R; N]; C] {
        *self
    }
}

/// A without the entries that are always zero. The parameter `A` is the number of entries that are left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SparseRows<R, const A: usize> {
    pattern: &'static Pattern,
    entries: [R; A],
}

impl<R: Real, const A: usize> SparseRows<R, A> {
    /// Entries step by step, as [`Pattern::coordinates`] lists them.
    #[inline]
    #[must_use]
    pub fn new(pattern: &'static Pattern, entries: [R; A]) -> Self {
        Self { pattern, entries }
    }

    #[inline(always)]
    pub(super) fn pattern(&self) -> &'static Pattern {
        self.pattern
    }

    /// Coordinates and the entries that belong to them, step by step.
    #[inline(always)]
    pub(super) fn iter(&self) -> impl Iterator<Item = (&'static [usize], &[R])> {
        let mut rest = self.entries.as_slice();
        self.pattern.coordinates.iter().map(move |&coordinates| {
            let (row, more) = rest.split_at_checked(coordinates.len()).unwrap_or((rest, &[]));
            rest = more;
            (coordinates, row)
        })
    }

    /// The entries from one of them on.
    #[inline(always)]
    pub(super) fn from(&self, start: usize) -> &[R] {
        self.entries.get(start..).unwrap_or(&[])
    }

    /// x + M⁻¹ Aᵀ κ.
    #[inline(always)]
    pub(super) fn drive<const N: usize, const C: usize>(
        &self,
        mut x: [R; N],
        inverse_masses: &[R; N],
        kappa: &[R; C],
    ) -> [R; N] {
        for ((coordinates, row), &constraint) in self.iter().zip(self.pattern.order) {
            let kappa = entry(kappa, constraint);
            for (&i, &a) in coordinates.iter().zip(row) {
                if let (Some(x), Some(&inverse)) = (x.get_mut(i), inverse_masses.get(i)) {
                    *x = R::mul_add(a * inverse, kappa, *x);
                }
            }
        }
        x
    }

    /// Σ part(a) x of each constraint.
    #[inline(always)]
    fn sums<const N: usize, const C: usize>(&self, x: &[R; N], part: impl Fn(R) -> R) -> [R; C] {
        let mut sums = [R::zero(); C];
        for ((coordinates, row), &constraint) in self.iter().zip(self.pattern.order) {
            let products = coordinates.iter().zip(row);
            let sum = products.fold(R::zero(), |sum, (&i, &a)| R::mul_add(part(a), entry(x, i), sum));
            if let Some(to) = sums.get_mut(constraint) {
                *to = sum;
            }
        }
        sums
    }
}

/// A component; zero outside.
#[inline(always)]
pub(super) fn entry<R: Real>(x: &[R], index: usize) -> R {
    x.get(index).copied().unwrap_or(R::zero())
}

impl<R: Real, const N: usize, const C: usize, const A: usize> Gradients<R, N, C> for SparseRows<R, A> {
    #[inline]
    fn rates(&self, x: &[R; N]) -> [R; C] {
        self.sums(x, |a| a)
    }

    #[inline]
    fn slopes(&self, x: &[R; N]) -> [R; C] {
        self.sums(x, R::abs)
    }

    #[inline]
    fn borne(&self, kappa: &[R; C]) -> [R; N] {
        let mut sums = [R::zero(); N];
        for ((coordinates, row), &constraint) in self.iter().zip(self.pattern.order) {
            let kappa = entry(kappa, constraint).abs();
            for (&i, a) in coordinates.iter().zip(row) {
                if let Some(sum) = sums.get_mut(i) {
                    *sum = R::mul_add(a.abs(), kappa, *sum);
                }
            }
        }
        sums
    }

    #[inline]
    fn rows(&self) -> [[R; N]; C] {
        let mut rows = [[R::zero(); N]; C];
        for ((coordinates, row), &constraint) in self.iter().zip(self.pattern.order) {
            let Some(to) = rows.get_mut(constraint) else { continue };
            for (&i, &a) in coordinates.iter().zip(row) {
                if let Some(to) = to.get_mut(i) {
                    *to = a;
                }
            }
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forces_that_constraints_bear_add_up_whatever_their_signs() {
        let rows = [[1.0, -2.0, 0.0], [-3.0, 0.5, 4.0]];
        assert_eq!(rows.borne(&[2.0, -10.0]), [32.0, 9.0, 40.0]);
        assert_eq!(rows.rates(&[1.0, 2.0, 3.0]), [-3.0, 10.0]);
        assert_eq!(rows.slopes(&[1.0, 2.0, 3.0]), [5.0, 16.0]);
    }
}
