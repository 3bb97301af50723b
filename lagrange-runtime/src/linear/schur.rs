//! The Schur complement S = A M⁻¹ Aᵀ of constrained mechanics: symmetric, positive semidefinite, singular where rows of
//! A depend on each other.
//!
//! Matrices that are clearly regular are factored as L D Lᵀ in the order given. A small pivot starts again, with
//! pivoting and a decision about the rank (Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed.,
//! § 10.3), and ends in the inverse, or in the generalised inverse that gives the shortest solution.

use crate::real::Real;

use super::saddle::redundant;
use super::saddle::vectors::{add_product, add_scaled, best, where_positive};

/// A pivot below 2⁶ C ε of its diagonal in S is zero.
///
/// A pivot is the squared sine of the angle between a row of A and those before it, in the metric of the kinetic
/// energy. S is known to some Nε, so smaller pivots are rounding errors: of a few rows those that are closer to each
/// other than about 2⁻²² (`f64`) or 2⁻⁸ (`f32`) count as dependent. [`Saddle`](super::Saddle), which never squares A,
/// tells them apart.
const ROUNDINGS: f64 = 64.0;

/// A pivot below this part of its diagonal is left to the pivoted way: after it, and without an order by size, rounding
/// errors may look like pivots.
const LEAST: f64 = 1.0 / 1024.0;

/// Up to this size the inverse is formed: one product instead of two substitutions.
pub(super) const SMALL: usize = 6;

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
    vanishing: Option<usize>,
}

impl<R: Real, const C: usize> Schur<R, C> {
    /// Factors S, of which only the lower triangle is read.
    #[inline]
    #[must_use]
    pub fn factor(lower: [[R; C]; C]) -> Self {
        Self::factor_with(&lower, &mut [[R::zero(); 0]; C])
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
            let mut inverse = identity();
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
                let l = column[i] * inverse[k];
                factor[i][k] = l;
                for j in k + 1..=i {
                    factor[i][j] = R::mul_add(-l, column[j], factor[i][j]);
                }
            }
        }
        Some(Self { factor, inverse, inverted: false, dropped: [false; C], rank: C, vanishing: None })
    }

    /// X with L D Lᵀ X = `rows`.
    #[inline(always)]
    fn substitute<const K: usize>(&self, rows: &mut [[R; K]; C]) {
        for k in 0..C {
            let known = rows[k];
            for i in k + 1..C {
                add_scaled(&mut rows[i], &known, -self.factor[i][k]);
            }
            for x in &mut rows[k] {
                *x *= self.inverse[k];
            }
        }
        for i in (0..C).rev() {
            let known = rows[i];
            for k in 0..i {
                add_scaled(&mut rows[k], &known, -self.factor[i][k]);
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

    /// The first row whose diagonal is zero: a constraint without a gradient.
    #[inline]
    #[must_use]
    pub fn vanishing(&self) -> Option<usize> {
        self.vanishing
    }

    /// As [`Self::factor_with`], by pivots in the order of their size.
    #[cold]
    #[inline(never)]
    fn carefully<const K: usize>(lower: &[[R; C]; C], rows: &mut [[R; K]; C]) -> Self {
        let this = Self::pivoted(lower);
        if C <= SMALL {
            let right = *rows;
            for c in 0..C {
                rows[c] = add_product(&[R::zero(); K], &right, &this.factor[c]);
            }
        }
        this
    }

    /// The generalised inverse, by Gauss–Jordan steps on [S, 1], the largest pivot relative to its diagonal first.
    fn pivoted(lower: &[[R; C]; C]) -> Self {
        let zero = R::zero();
        let tolerance = R::from_f64(ROUNDINGS * C as f64) * R::epsilon();
        let mut this = Self {
            factor: identity(),
            inverse: [R::one(); C],
            inverted: true,
            dropped: [true; C],
            rank: 0,
            vanishing: (0..C).find(|&i| lower[i][i].abs().largest() == zero.largest()),
        };
        let mut s = *lower;
        for i in 0..C {
            for j in 0..i {
                s[j][i] = lower[i][j];
            }
        }
        // What is left of each row, relative to all of it; nothing of a row that is kept or zero.
        let mut kept = [C; C];
        for place in &mut kept {
            let left: [R; C] = core::array::from_fn(|i| {
                let open = this.dropped[i] && lower[i][i].largest() > zero.largest();
                if open { s[i][i] / lower[i][i] } else { zero }
            });
            let k = best(&left, tolerance);
            let (Some(&part), Some(row)) = (left.get(k), s.get(k)) else { break };
            let excess = part - tolerance;
            let pivot = row.get(k).copied().unwrap_or(zero);
            let pivot = if excess.is_positive() { Some(pivot) } else { where_positive(pivot, excess) };
            let Some(pivot) = pivot else { break };
            this.step(&mut s, k, pivot);
            *place = k;
        }
        if this.rank < C {
            if s.as_flattened().iter().all(|x| x.is_finite()) {
                this.shorten(&s, &kept);
            } else {
                this.factor = [[R::from_f64(f64::NAN); C]; C];
            }
        }
        this
    }

    /// Solves row k for component k and inserts it in the others.
    fn step(&mut self, s: &mut [[R; C]; C], k: usize, pivot: R) {
        let (Some(&above), Some(&known)) = (s.get(k), self.factor.get(k)) else { return };
        let inverse = pivot.recip();
        let (above, known) = (above.map(|x| x * inverse), known.map(|x| x * inverse));
        for i in 0..C {
            if i == k {
                (s[i], self.factor[i], self.dropped[i]) = (above, known, false);
            } else if let Some(&l) = s[i].get(k) {
                add_scaled(&mut s[i], &above, -l);
                add_scaled(&mut self.factor[i], &known, -l);
            }
        }
        self.rank += 1;
    }

    /// The shortest multipliers instead of those that leave the dropped rows at zero.
    fn shorten(&mut self, s: &[[R; C]; C], kept: &[usize; C]) {
        // Row d of S is Σ x[k] · row k over the kept rows, and the x are what became of its column.
        let mut combinations = [[R::zero(); C]; C];
        for (to, &k) in combinations.iter_mut().zip(kept) {
            for c in 0..C {
                let depends = if c == k { R::one() } else { R::zero() };
                to[c] = if self.dropped[c] { s.get(k).map_or(depends, |row| row[c]) } else { depends };
            }
        }
        let basis = redundant::basis(&combinations, self.rank);
        let inverse = self.factor;
        for c in 0..C {
            // By symmetry of the inverse its row is its column.
            let row = core::array::from_fn(|i| if self.dropped[i] { R::zero() } else { inverse[i][c] });
            self.factor[c] = [R::zero(); C];
            if !self.dropped[c] {
                self.factor[c] = redundant::project(&basis, &row, self.rank);
            }
        }
    }
}

/// The unit matrix.
#[inline(always)]
fn identity<R: Real, const C: usize>() -> [[R; C]; C] {
    let mut identity = [[R::zero(); C]; C];
    for c in 0..C {
        identity[c][c] = R::one();
    }
    identity
}
