//! The Schur complement S = A M⁻¹ Aᵀ of constrained mechanics: symmetric, positive semidefinite, singular where rows of
//! A depend on each other.
//!
//! Matrices that are clearly regular are factored as L D Lᵀ in the order given. A small pivot starts again, with
//! pivoting and a decision about the rank (Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed.,
//! § 10.3), and ends in the inverse, or in the generalised inverse that gives the shortest solution.

use crate::real::Real;

use super::saddle::vectors::{add_product, add_scaled, best, pick, poison, put, scale, unit, where_positive};
use super::saddle::{redundant, symmetric};

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
        Some(Self { factor, inverse, inverted: false, dropped: [false; C], rank: C, vanishing: None })
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
            *rows = this.factor.map(|row| add_product(&[R::zero(); K], rows, &row));
        }
        this
    }

    /// The generalised inverse, by Gauss–Jordan steps on [S, 1], the largest pivot relative to its diagonal first.
    fn pivoted(lower: &[[R; C]; C]) -> Self {
        let zero = R::zero();
        let tolerance = R::from_f64(ROUNDINGS * C as f64) * R::epsilon();
        let mut this = Self {
            factor: core::array::from_fn(unit),
            inverse: [R::one(); C],
            inverted: true,
            dropped: [true; C],
            rank: 0,
            vanishing: (0..C).find(|&i| lower[i][i].abs().largest() == zero.largest()),
        };
        let mut s = symmetric(lower);
        // What is left of each row, relative to all of it; nothing of a row that is kept or zero.
        let mut kept = [C; C];
        for place in &mut kept {
            let left: [R; C] = core::array::from_fn(|i| {
                let open = this.dropped[i] && lower[i][i].largest() > zero.largest();
                if open { s[i][i] / lower[i][i] } else { zero }
            });
            let k = best(&left, tolerance);
            let (excess, pivot) = (pick(&left, k) - tolerance, s.get(k).map_or(zero, |row| pick(row, k)));
            let pivot = if excess.is_positive() { Some(pivot) } else { where_positive(pivot, excess) };
            let Some(pivot) = pivot else { break };
            this.step(&mut s, k, pivot);
            *place = k;
        }
        if this.rank < C {
            this.shorten(&s, &kept);
            // A row that is not a number is not a pivot, but it does not depend on others either. Nor does one whose
            // square is negative, which no positive masses can make.
            poison(this.factor.as_flattened_mut(), s.as_flattened());
            poison(this.factor.as_flattened_mut(), &core::array::from_fn::<_, C, _>(|i| lower[i][i].sqrt()));
        }
        this
    }

    /// Solves row k for component k and inserts it in the others.
    fn step(&mut self, s: &mut [[R; C]; C], k: usize, pivot: R) {
        let (Some(&above), Some(&known)) = (s.get(k), self.factor.get(k)) else { return };
        let inverse = pivot.recip();
        let (above, known) = (above.map(|x| x * inverse), known.map(|x| x * inverse));
        for (i, (row, solution)) in s.iter_mut().zip(&mut self.factor).enumerate() {
            let l = pick(row, k);
            add_scaled(row, &above, -l);
            add_scaled(solution, &known, -l);
            if i == k {
                (*row, *solution) = (above, known);
            }
        }
        put(&mut self.dropped, k, false);
        self.rank += 1;
    }

    /// The shortest multipliers instead of those that leave the dropped rows at zero.
    fn shorten(&mut self, s: &[[R; C]; C], kept: &[usize; C]) {
        // Row d of S is Σ x[k] · row k over the kept rows, and the x are what became of its column.
        let mut combinations = [[R::zero(); C]; C];
        for (to, &k) in combinations.iter_mut().zip(kept) {
            let Some(row) = s.get(k) else { continue };
            *to = unit(k);
            for (to, (&x, &dropped)) in to.iter_mut().zip(row.iter().zip(&self.dropped)) {
                if dropped {
                    *to = x;
                }
            }
        }
        let basis = redundant::basis(&combinations, self.rank);
        for (row, &dropped) in self.factor.iter_mut().zip(&self.dropped) {
            // A row is also a column of the symmetric inverse, and zero in the dropped rows.
            *row = if dropped { [R::zero(); C] } else { redundant::project(&basis, row, self.rank) };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::samples::{Noise, residual};

    /// A Aᵀ of random rows of length C + 2.
    fn regular<const C: usize>(noise: &mut Noise) -> [[f64; C]; C] {
        let (b, extra): ([[f64; C]; C], [[f64; C]; 2]) = (noise.matrix(), [noise.vector(), noise.vector()]);
        core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                let product: f64 = b[i].iter().zip(&b[j]).map(|(x, y)| x * y).sum::<f64>();
                let more: f64 = extra.iter().map(|x| x[i] * x[j]).sum();
                product + more + if i == j { 0.1 } else { 0.0 }
            })
        })
    }

    fn check<const C: usize>() {
        let mut noise = Noise(C as u64 + 17);
        for _ in 0..100 {
            let s = regular::<C>(&mut noise);
            let y = noise.vector();
            let mut rows = [[0.0; C]; C];
            rows[0] = y;
            for (way, schur) in [Schur::factor(s), Schur::carefully(&s, &mut rows)].iter().enumerate() {
                assert_eq!((schur.rank(), schur.is_finite(), schur.vanishing()), (C, true, None));
                assert!((0..C).all(|c| !schur.is_dropped(c)));
                let error = residual(&s, &schur.solve(y), &y);
                // An inverse has the condition in its residual where the factors have not.
                let bound = if C > SMALL && way == 0 { 4.0 } else { 400.0 };
                assert!(error < bound * C as f64 * f64::EPSILON, "size {C}, way {way}: {error:e}");
            }
        }
    }

    #[test]
    #[cfg_attr(miri, ignore = "takes minutes there")]
    fn regular_matrices_are_solved() {
        check::<1>();
        check::<2>();
        check::<3>();
        check::<6>();
        check::<7>();
        check::<12>();
        assert_eq!(Schur::factor([[4.0]]).solve([8.0]), [2.0]);
        let none: Schur<f64, 0> = Schur::factor([]);
        assert_eq!((none.rank(), none.is_finite(), none.solve([])), (0, true, []));
    }

    #[test]
    fn the_upper_triangle_is_not_read() {
        for bad in [1e9, f64::NAN] {
            assert_eq!(Schur::factor([[4.0, bad], [2.0, 3.0]]).solve([8.0, 8.0]), [1.0, 2.0]);
            assert_eq!(Schur::factor([[4.0, bad], [2.0, 1.0]]).rank(), 1);
        }
    }

    #[test]
    fn a_singular_matrix_has_its_shortest_solution() {
        // Rows a, b, a + b, 0 with a ⊥ b of squares 1 and 4.
        let s = [[1.0, 0.0, 1.0, 0.0], [0.0, 4.0, 4.0, 0.0], [1.0, 4.0, 5.0, 0.0], [0.0; 4]];
        let schur = Schur::factor(s);
        assert_eq!((schur.rank(), schur.vanishing(), schur.is_finite()), (2, Some(3), true));
        assert_eq!((0..9).filter(|&c| schur.is_dropped(c)).count(), 2);
        // The forces 2 a + 6 b: (2, 6, 0) less (2, 6, 0)·(1, 1, −1)/3 · (1, 1, −1).
        let kappa = schur.solve([2.0, 24.0, 26.0, 7.0]);
        for (kappa, exact) in kappa.iter().zip(&[2.0 - 8.0 / 3.0, 6.0 - 8.0 / 3.0, 8.0 / 3.0, 0.0]) {
            assert!((kappa - exact).abs() < 1e-14, "{kappa} {exact}");
        }
        let nothing = Schur::factor([[0.0; 2]; 2]);
        assert_eq!((nothing.rank(), nothing.vanishing()), (0, Some(0)));
        assert_eq!(nothing.solve([1.0, 2.0]), [0.0, 0.0]);
    }

    #[test]
    #[cfg_attr(miri, ignore = "takes minutes there")]
    fn ranks_are_found_in_any_units() {
        fn check<const C: usize>(rank: usize) {
            let mut noise = Noise(3 * C as u64);
            for _ in 0..200 {
                let mut a: [[f64; C]; C] = noise.matrix();
                for c in rank..C {
                    a[c] = core::array::from_fn(|i| a[c - rank][i] - a[c - 1][i]);
                }
                for row in &mut a {
                    let unit = 1e6_f64.powf(noise.number());
                    *row = row.map(|x| x * unit);
                }
                let product = |i: usize, j: usize| a[i].iter().zip(&a[j]).map(|(x, y)| x * y).sum::<f64>();
                let s: [[f64; C]; C] = core::array::from_fn(|i| core::array::from_fn(|j| product(i, j)));
                assert_eq!(Schur::factor(s).rank(), rank, "{s:?}");
            }
        }
        check::<2>(1);
        check::<5>(3);
        check::<8>(3);
        check::<12>(6);
    }

    #[test]
    fn what_is_not_a_number_stays_so() {
        assert!(!Schur::factor([[1.0, 0.0], [0.0, -1.0]]).is_finite());
        for s in
            [[[f64::NAN, 0.0], [0.0, 1.0]], [[1.0, 0.0], [0.0, f64::NAN]], [[1.0, 0.0], [f64::INFINITY, 1.0]]]
        {
            let schur = Schur::factor(s);
            assert!(!schur.is_finite() && schur.solve([1.0, 1.0]).iter().any(|x| !x.is_finite()), "{s:?}");
        }
        let mut large = [[0.0; 8]; 8];
        for (i, row) in large.iter_mut().enumerate() {
            row[i] = if i == 5 { f64::NAN } else { 1.0 };
        }
        assert!(!Schur::factor(large).is_finite());
    }
}
