//! The Schur complement S = A M⁻¹ Aᵀ of constrained mechanics: symmetric, positive semidefinite, singular
//! where rows of A depend on each other.
//!
//! Matrices that are clearly regular are factored as L D Lᵀ in the order given. Where a pivot is small, S is
//! given up, since its condition number is the square of that of A. Then the rows of A themselves, in the
//! metric of M, are brought to triangular form by the QR factorisation that reveals their rank. The inverse,
//! or the generalised inverse that gives the shortest solution, is formed from that.

use crate::number::elements::{Each, array};
use crate::number::real::Real;

use super::Independence;
use super::saddle::range::Range;
use super::saddle::redundant::Shortest;
use super::saddle::scaled::Scaled;
use super::saddle::vectors::{add_product, add_scaled, multiply, poison, scale, unit, where_positive};

/// A pivot below this part of its diagonal is left to the careful way.
///
/// The pivot is, as a part of its diagonal, the squared sine of the angle between a row of A and the span of
/// those before it, in the metric of the kinetic energy. S is known to about Cε. So a pivot above this bound
/// has lost three digits at most.
pub(super) const LEAST: f64 = 1.0 / 1024.0;

/// Up to this size the inverse is formed: one product instead of two substitutions.
pub(super) const SMALL: usize = 6;

/// Orders of a Taylor series whose solutions are refined. The terms of later orders are smaller by two powers
/// of ten.
pub(super) const REFINED: usize = 4;

/// A factored Schur complement.
///
/// With several lanes the rank and the order of the pivots are common to all of them. A lane with a smaller
/// rank than another, or with other dependent rows, gives NaN; the other lanes are right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schur<R, const C: usize> {
    /// L below its unit diagonal, or the inverse of S.
    factor: [[R; C]; C],
    /// 1 / D.
    inverse: [R; C],
    /// Whether `factor` is the inverse.
    inverted: bool,
    independence: Independence<R>,
    vanishing: Option<usize>,
    /// Whether lanes decided nothing together.
    apart: bool,
}

impl<R: Real, const C: usize> Schur<R, C> {
    /// Factors S, of which only the lower triangle is read. `system` gives M⁻¹, as a diagonal, and A where S
    /// alone is not enough.
    #[inline]
    #[must_use]
    pub fn factor<const N: usize>(
        lower: [[R; C]; C],
        system: impl FnOnce() -> ([R; N], [[R; N]; C]),
    ) -> Self {
        let mut none: [[R; 0]; C] = [[]; C];
        Self::factor_with(&lower, &mut none, system)
    }

    /// Factors S and, if it is [`SMALL`], multiplies `rows` by its inverse from the left.
    #[inline(always)]
    pub(super) fn factor_with<const K: usize, const N: usize>(
        lower: &[[R; C]; C],
        rows: &mut [[R; K]; C],
        system: impl FnOnce() -> ([R; N], [[R; N]; C]),
    ) -> Self {
        let Some(mut this) = Self::decompose(lower) else {
            let this = if C == 1 { Self::single(lower) } else { Self::carefully(&system()) };
            if C <= SMALL {
                *rows = this.factor.each(|row| add_product(&[R::zero(); K], rows, &row));
            }
            return this;
        };
        if C <= SMALL {
            // The factors are used and not the inverse, whose rounding errors are larger.
            this.substitute(rows);
            let mut inverse = array(unit);
            this.substitute(&mut inverse);
            (this.factor, this.inverted) = (inverse, true);
        }
        this
    }

    /// L D Lᵀ, unless a pivot is small.
    #[inline(always)]
    fn decompose(lower: &[[R; C]; C]) -> Option<Self> {
        let least = R::from_f64(LEAST);
        let mut factor = *lower;
        let mut inverse = [R::zero(); C];
        let mut column = [R::zero(); C];
        let mut squares = Independence::clear(C);
        for k in 0..C {
            let pivot = factor[k][k];
            if !(pivot - least * lower[k][k]).is_positive() {
                return None;
            }
            squares.take(k, pivot / lower[k][k]);
            inverse[k] = pivot.recip();
            for i in k + 1..C {
                column[i] = factor[i][k];
            }
            for i in k + 1..C {
                let l = column[i] * inverse[k];
                factor[i][k] = l;
                for j in k + 1..i + 1 {
                    factor[i][j] = R::mul_add(-l, column[j], factor[i][j]);
                }
            }
        }
        let independence = Independence { least: squares.least.sqrt(), ..squares };
        Some(Self { factor, inverse, inverted: false, independence, vanishing: None, apart: true })
    }

    /// A single row whose square is not positive. One row cannot depend on others, so a program with one
    /// constraint does not link the code that decides about rank.
    #[cold]
    #[inline(never)]
    fn single(lower: &[[R; C]; C]) -> Self {
        let square = lower.as_flattened().first().copied().unwrap_or(R::zero());
        let (zero, nan) = (R::zero(), R::from_f64(f64::NAN));
        let is_zero = square.abs().largest() == zero.largest();
        let inverse =
            if is_zero { zero } else { where_positive(square.recip(), square.recip()).unwrap_or(nan) };
        Self {
            factor: [[inverse; C]; C],
            inverse: [R::one(); C],
            inverted: true,
            independence: Independence { rank: usize::from(!is_zero), ..Independence::clear(C) },
            vanishing: is_zero.then_some(0),
            apart: false,
        }
    }

    /// The generalised inverse Y₀ᵀ Y₀, with Y₀ the right inverse of A M^(−1/2) on its independent rows.
    #[cold]
    #[inline(never)]
    pub(super) fn carefully<const N: usize>((inverse_masses, a): &([R; N], [[R; N]; C])) -> Self {
        let mut rows = *a;
        let units = inverse_masses.each(R::sqrt);
        for row in &mut rows {
            multiply(row, &units);
        }
        let range = Range::factor(&Scaled::with([R::one(); N], &rows));
        let mut factor = [[R::zero(); C]; C];
        for row in &range.split().inverse {
            for (to, &x) in factor.iter_mut().zip(row) {
                add_scaled(to, row, x);
            }
        }
        if range.rank < C {
            Shortest::new(range.combinations(), range.rank).replace(&mut factor);
        }
        // A row with NaN is not taken, but it does not depend on others either. Nor does a row that a
        // negative mass has made NaN.
        poison(factor.as_flattened_mut(), rows.as_flattened());
        Self {
            factor,
            inverse: [R::one(); C],
            inverted: true,
            independence: range.independence(),
            vanishing: range.vanishing,
            apart: false,
        }
    }

    /// X with L D Lᵀ X = `rows`.
    #[inline(always)]
    fn substitute<const K: usize>(&self, rows: &mut [[R; K]; C]) {
        let Self { factor, inverse, .. } = self;
        for k in 0..C {
            let known = rows[k];
            for i in k + 1..C {
                add_scaled(&mut rows[i], &known, -factor[i][k]);
            }
            scale(&mut rows[k], inverse[k]);
        }
        for i in (0..C).rev() {
            let known = rows[i];
            for k in 0..i {
                add_scaled(&mut rows[k], &known, -factor[i][k]);
            }
        }
    }

    /// As [`SaddlePoint::apart`](super::SaddlePoint::apart).
    #[inline]
    pub(super) fn apart(&self) -> Option<R> {
        self.apart.then(|| self.independence.least * R::from_f64(LEAST).sqrt().recip())
    }

    /// κ with S κ = `y`. Where S is singular, it satisfies the independent rows and is the shortest of all
    /// solutions that differ by null vectors of S.
    #[inline]
    #[must_use]
    pub fn solve(&self, y: [R; C]) -> [R; C] {
        if C <= SMALL {
            return add_product(&[R::zero(); C], &self.factor, &y);
        }
        if self.inverted {
            return self.multiply(&y);
        }
        let mut x = y;
        for i in 0..C {
            for k in 0..i {
                x[i] = R::mul_add(-self.factor[i][k], x[k], x[i]);
            }
        }
        for (x, &inverse) in x.iter_mut().zip(&self.inverse) {
            *x *= inverse;
        }
        for i in (0..C).rev() {
            for k in 0..i {
                x[k] = R::mul_add(-self.factor[i][k], x[i], x[k]);
            }
        }
        x
    }

    /// κ for the Taylor coefficients of an order, with S given again.
    ///
    /// Where a constraint keeps S constant, as a rod does, the factors have the same rounding errors in every
    /// step, and the energy error would grow with the number of steps instead of its square root. So the
    /// first orders, which make up most of a step, are refined (Higham, chapter 12).
    #[inline]
    #[must_use]
    pub fn solve_order(&self, order: usize, lower: &[[R; C]; C], y: [R; C]) -> [R; C] {
        let mut x = self.solve(y);
        if order <= REFINED && self.independence.rank == C {
            let mut rest = y;
            for i in 0..C {
                for j in 0..C {
                    rest[i] = R::mul_add(-lower[i.max(j)][i.min(j)], x[j], rest[i]);
                }
            }
            let more = self.solve(rest);
            for i in 0..C {
                x[i] += more[i];
            }
        }
        x
    }

    #[cold]
    #[inline(never)]
    fn multiply(&self, y: &[R; C]) -> [R; C] {
        add_product(&[R::zero(); C], &self.factor, y)
    }

    /// How independent the rows are.
    #[inline]
    #[must_use]
    pub fn independence(&self) -> Independence<R> {
        self.independence
    }

    /// Whether all factors are numbers.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let width = |row: usize| if self.inverted { C } else { row };
        let finite = |(i, row): (usize, &[R; C])| row.iter().take(width(i)).all(|x| x.is_finite());
        self.factor.iter().enumerate().all(finite) && self.inverse.iter().all(|x| x.is_finite())
    }

    /// The first row whose diagonal is zero: a constraint without a gradient.
    #[inline]
    #[must_use]
    pub fn vanishing(&self) -> Option<usize> {
        self.vanishing
    }
}

#[cfg(test)]
mod tests;
