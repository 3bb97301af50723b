//! The saddle-point system of a diagonal mass matrix where most constraints have no coordinate in common:
//! links of a chain, a net of rods.
//!
//! The Schur complement S = A M⁻¹ Aᵀ couples constraints with a common coordinate. It is factored as L D Lᵀ
//! in an order with little fill that was found at expansion, row by row over the entries that can differ from
//! zero (Davis, "Direct Methods for Sparse Linear Systems", 2006, ch. 4). So factors, solutions and memory
//! are in proportion to the system.
//!
//! The order has no regard to sizes. So every pivot is compared with its value before anything was
//! subtracted, as in [`Schur`]: S is known to about ε of its diagonal times the number of neighbours. A pivot
//! above that bound has lost three digits more at most, in any order. Where a pivot is below it, [`Schur`]
//! decides about rank, with pivoting, on the whole of A.

use crate::linear::Independence;
use crate::linear::gradients::{Gradients, SparseRows, entry};
use crate::linear::schur::{LEAST, REFINED, Schur};
use crate::linear::stored::Stored;
use crate::number::elements::{Each, array};
use crate::number::real::Real;

use super::diagonal::without_inertia;
use super::{Defect, SaddlePoint};

/// A saddle-point system with a diagonal M and a sparse A. `A` entries of A can differ from zero, and `L` of
/// L.
///
/// Lanes are as in [`Schur`].
#[derive(Clone, Debug, PartialEq)]
pub struct Sparse<R, const N: usize, const C: usize, const A: usize, const L: usize> {
    inverse_masses: [R; N],
    gradients: SparseRows<R, A>,
    /// L without its unit diagonal, column by column.
    factor: [R; L],
    /// 1 / D.
    inverse: [R; C],
    independence: Independence<R>,
    /// Where a pivot is small.
    pub(super) careful: Option<Stored<Schur<R, C>>>,
}

impl<R: Real, const N: usize, const C: usize, const A: usize, const L: usize> Sparse<R, N, C, A, L> {
    /// Factors. An inverse mass of zero belongs to a coordinate that nothing moves. A negative one gives NaN
    /// where a pivot is not clearly positive; it is a [defect](SaddlePoint::negative) in any case.
    #[inline]
    #[must_use]
    pub fn factor(inverse_masses: [R; N], gradients: SparseRows<R, A>) -> Self {
        let mut this = Self {
            inverse_masses,
            gradients,
            factor: [R::zero(); L],
            inverse: [R::zero(); C],
            independence: Independence::clear(C),
            careful: None,
        };
        if !this.decompose() {
            this.carefully();
        }
        this
    }

    /// Factors as L D Lᵀ. Returns whether no pivot is small.
    #[inline(never)]
    fn decompose(&mut self) -> bool {
        let Self { inverse_masses, gradients, factor, inverse, independence, .. } = self;
        let pattern = gradients.pattern();
        let rows = starts::<C>(pattern.coordinates);
        // For each column of L the index where it begins, and the one where it ends so far.
        let columns = starts::<C>(pattern.later);
        let mut ends = columns;
        // A row of A M⁻¹ and a row of L D; zero where the row at hand has no entry.
        let (mut weighted, mut row) = ([R::zero(); N], [R::zero(); C]);
        let mut squares = Independence::clear(C);
        let lists = pattern.coupled.iter().zip(pattern.earlier).zip(pattern.order);
        for (k, ((coordinates, entries), ((&coupled, &earlier), &constraint))) in
            gradients.iter().zip(lists).enumerate()
        {
            let mut square = R::zero();
            for (&i, &a) in coordinates.iter().zip(entries) {
                let product = a * entry(inverse_masses, i);
                square = R::mul_add(a, product, square);
                set(&mut weighted, i, product);
            }
            for &j in coupled {
                let other = pattern.coordinates.get(j).copied().unwrap_or(&[]);
                let entries = gradients.from(rows.get(j).copied().unwrap_or(A));
                let products = other.iter().zip(entries);
                let sum = products.fold(R::zero(), |sum, (&i, &a)| R::mul_add(a, entry(&weighted, i), sum));
                set(&mut row, j, sum);
            }
            for &i in coordinates {
                set(&mut weighted, i, R::zero());
            }
            let mut pivot = square;
            for &j in earlier {
                let (Some(&begin), Some(end)) = (columns.get(j), ends.get_mut(j)) else { continue };
                let known = entry(&row, j);
                set(&mut row, j, R::zero());
                let later = pattern.later.get(j).copied().unwrap_or(&[]);
                for (&i, &l) in later.iter().zip(factor.get(begin..*end).unwrap_or(&[])) {
                    if let Some(x) = row.get_mut(i) {
                        *x = R::mul_add(-l, known, *x);
                    }
                }
                let l = known * entry(inverse, j);
                pivot = R::mul_add(-l, known, pivot);
                set(factor, *end, l);
                *end += 1;
            }
            if !(pivot - R::from_f64(LEAST) * square).is_positive() {
                return false;
            }
            squares.take(constraint, pivot / square);
            set(inverse, k, pivot.recip());
        }
        *independence = Independence { least: squares.least.sqrt(), ..squares };
        true
    }

    /// Factors by the independent rows, in a pivoted order.
    #[cold]
    #[inline(never)]
    fn carefully(&mut self) {
        let schur = Schur::carefully(&(self.inverse_masses, self.gradients.rows()));
        self.independence = schur.independence();
        self.careful = Some(Stored::new(schur));
    }

    /// κ with S κ = `y`, as by [`Schur::solve`].
    #[inline]
    fn multipliers(&self, y: &[R; C]) -> [R; C] {
        if let Some(schur) = &self.careful {
            return schur.solve(*y);
        }
        let pattern = self.gradients.pattern();
        let mut x = [R::zero(); C];
        for (x, &constraint) in x.iter_mut().zip(pattern.order) {
            *x = entry(y, constraint);
        }
        let mut rest = self.factor.as_slice();
        for (k, &later) in pattern.later.iter().enumerate() {
            let (column, more) = rest.split_at_checked(later.len()).unwrap_or((rest, &[]));
            let known = entry(&x, k);
            for (&i, &l) in later.iter().zip(column) {
                if let Some(x) = x.get_mut(i) {
                    *x = R::mul_add(-l, known, *x);
                }
            }
            rest = more;
        }
        for (x, &inverse) in x.iter_mut().zip(&self.inverse) {
            *x *= inverse;
        }
        let mut rest = self.factor.as_slice();
        for (k, &later) in pattern.later.iter().enumerate().rev() {
            let (more, column) =
                rest.split_at_checked(rest.len().saturating_sub(later.len())).unwrap_or((&[], rest));
            let known = later.iter().zip(column);
            let sum = known.fold(entry(&x, k), |sum, (&i, &l)| R::mul_add(-l, entry(&x, i), sum));
            set(&mut x, k, sum);
            rest = more;
        }
        let mut kappa = [R::zero(); C];
        for (&x, &constraint) in x.iter().zip(pattern.order) {
            set(&mut kappa, constraint, x);
        }
        kappa
    }

    /// A.
    #[cfg(all(test, feature = "double-double"))]
    pub(super) fn gradients(&self) -> &SparseRows<R, A> {
        &self.gradients
    }

    /// κ for the Taylor coefficients of an order, as by [`Schur::solve_order`].
    #[inline]
    #[must_use]
    pub fn solve_order(&self, order: usize, y: [R; C]) -> [R; C] {
        let mut kappa = self.multipliers(&y);
        if order <= REFINED && self.independence.rank == C {
            let driven = self.gradients.drive([R::zero(); N], &self.inverse_masses, &kappa);
            let rates: [R; C] = self.gradients.rates(&driven);
            let more = self.multipliers(&array(|c| y[c] - rates[c]));
            for (kappa, more) in kappa.iter_mut().zip(more) {
                *kappa += more;
            }
        }
        kappa
    }
}

/// Where each list begins if they follow each other.
#[inline(always)]
fn starts<const C: usize>(lists: &[&[usize]]) -> [usize; C] {
    let (mut starts, mut next) = ([0; C], 0);
    for (start, list) in starts.iter_mut().zip(lists) {
        *start = next;
        next += list.len();
    }
    starts
}

/// Writes a component; nothing outside.
#[inline(always)]
fn set<R>(x: &mut [R], index: usize, value: R) {
    if let Some(x) = x.get_mut(index) {
        *x = value;
    }
}

impl<R: Real, const N: usize, const C: usize, const A: usize, const L: usize> SaddlePoint<R, N, C>
    for Sparse<R, N, C, A, L>
{
    type Gradients = SparseRows<R, A>;

    #[inline]
    fn solve(&self, r: &[R; N], y: &[R; C]) -> ([R; N], [R; C]) {
        let mut free = *r;
        for (free, &inverse) in free.iter_mut().zip(&self.inverse_masses) {
            *free *= inverse;
        }
        let rates: [R; C] = self.gradients.rates(&free);
        let kappa = self.multipliers(&array(|c| y[c] - rates[c]));
        (self.gradients.drive(free, &self.inverse_masses, &kappa), kappa)
    }

    #[inline]
    fn independence(&self) -> Independence<R> {
        self.independence
    }

    fn defect(&self) -> Option<Defect> {
        let factors = || self.factor.iter().chain(&self.inverse).all(|x| x.is_finite());
        let finite = self.inverse_masses.iter().all(|x| x.is_finite())
            && self.careful.as_ref().map_or_else(factors, |schur| schur.is_finite());
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
        self.careful.as_ref().and_then(|schur| schur.vanishing())
    }

    #[inline]
    fn units(&self) -> [R; N] {
        self.inverse_masses.each(R::sqrt)
    }
}
