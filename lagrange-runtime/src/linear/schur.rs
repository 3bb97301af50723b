//! The Schur complement S = A M⁻¹ Aᵀ of constrained mechanics: symmetric, positive semidefinite, singular where rows of
//! A depend on each other.
//!
//! Matrices that are clearly regular are factored as L D Lᵀ in the order given. A small pivot starts again, with
//! pivoting and a decision about the rank (Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed.,
//! § 10.3), and ends in the inverse, or in the generalised inverse that gives the shortest solution.

use crate::real::Real;

use super::saddle::vectors::{add_product, add_scaled, scale, unit};

mod pivoted;

/// A pivot below 2⁸ C ε of its diagonal in S is zero.
///
/// A pivot is the squared sine of the angle between a row of A and those before it, in the metric of the kinetic
/// energy. S is known to some Cε, so what is above has two digits, and rows that are closer to each other than about
/// 2⁻²² √C (`f64`) or 2⁻⁷ √C (`f32`) count as dependent. [`Saddle`](super::Saddle), which never squares A, tells them
/// apart.
const ROUNDINGS: f64 = 256.0;

/// A pivot below this part of its diagonal is left to the pivoted way: after it, and without an order by size, rounding
/// errors may look like pivots.
const LEAST: f64 = 1.0 / 1024.0;

/// Up to this size the inverse is formed: one product instead of two substitutions.
pub(super) const SMALL: usize = 6;

/// So many orders of a Taylor series are refined: the terms of those after them are smaller by two powers of ten.
const REFINED: usize = 4;

/// A factored Schur complement.
///
/// With several lanes the rank and the order of the pivots are common to all of them. A lane with a smaller rank than
/// another, or with other dependent rows, gives NaN; the other lanes are right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schur<R, const C: usize> {
    /// L without its unit diagonal, below the diagonal; or the inverse: the row of what a component of y adds to κ.
    factor: [[R; C]; C],
    /// 1 / D.
    inverse: [R; C],
    /// What `factor` is.
    inverted: bool,
    dropped: [bool; C],
    rank: usize,
    is_doubtful: bool,
    vanishing: Option<usize>,
}

impl<R: Real, const C: usize> Schur<R, C> {
    /// Factors S, of which only the lower triangle is read.
    #[inline]
    #[must_use]
    pub fn factor(lower: [[R; C]; C]) -> Self {
        let mut none: [[R; 0]; C] = [[]; C];
        Self::factor_with(&lower, &mut none)
    }

    /// Factors S and, if it is [`SMALL`], multiplies `rows` by its inverse from the left.
    #[inline(always)]
    pub(super) fn factor_with<const K: usize>(lower: &[[R; C]; C], rows: &mut [[R; K]; C]) -> Self {
        let Some(mut this) = Self::decompose(lower) else {
            return Self::carefully(lower, rows);
        };
        if C <= SMALL {
            // With the factors and not with the inverse, whose rounding errors are larger.
            this.substitute(rows);
            let mut inverse = core::array::from_fn(unit);
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
        for k in 0..C {
            let pivot = factor[k][k];
            if !(pivot - least * lower[k][k]).is_positive() {
                return None;
            }
            inverse[k] = pivot.recip();
            for i in k + 1..C {
                column[i] = factor[i][k];
            }
            for i in k + 1..C {
                // The links of a long chain make a band, which stays one.
                if C > SMALL && column[i].is_zero() {
                    continue;
                }
                let l = column[i] * inverse[k];
                factor[i][k] = l;
                for j in k + 1..=i {
                    factor[i][j] = R::mul_add(-l, column[j], factor[i][j]);
                }
            }
        }
        Some(Self {
            factor,
            inverse,
            inverted: false,
            dropped: [false; C],
            rank: C,
            is_doubtful: false,
            vanishing: None,
        })
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

    /// κ with S κ = `y`. Where S is singular: on the rows that are not [dropped](Self::is_dropped), and the shortest of
    /// such κ that differ by a null vector of S.
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
    /// Where a constraint keeps S what it is, as a rod does, the rounding errors of the factors are the same in every step,
    /// and energy would drift with the number of steps instead of its root. So the first orders, which carry most of a
    /// step, are refined (Higham, chapter 12).
    #[inline]
    #[must_use]
    pub fn solve_order(&self, order: usize, lower: &[[R; C]; C], y: [R; C]) -> [R; C] {
        let mut x = self.solve(y);
        if order <= REFINED && self.rank == C {
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

    /// How many rows are independent.
    #[inline]
    #[must_use]
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// Whether all factors are numbers.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let width = |row: usize| if self.inverted { C } else { row };
        let finite = |(i, row): (usize, &[R; C])| row.iter().take(width(i)).all(|x| x.is_finite());
        self.factor.iter().enumerate().all(finite) && self.inverse.iter().all(|x| x.is_finite())
    }

    /// Whether this row depends on the others and was left out. False for rows that do not exist.
    #[inline]
    #[must_use]
    pub fn is_dropped(&self, row: usize) -> bool {
        self.dropped.get(row).copied().unwrap_or(false)
    }

    /// Whether a pivot is small, whatever became of it.
    #[inline]
    #[must_use]
    pub fn is_doubtful(&self) -> bool {
        self.is_doubtful
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
