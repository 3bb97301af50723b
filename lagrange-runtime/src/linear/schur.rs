//! The Schur complement S = A M⁻¹ Aᵀ of constrained mechanics: symmetric, positive semidefinite, singular where rows of
//! A depend on each other.
//!
//! Regular matrices are factored as L D Lᵀ in the order given. The first pivot without a digit starts again, with
//! pivoting and a decision about the rank (Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed.,
//! § 10.3), and ends in the generalised inverse that gives the shortest solution.

use crate::real::Real;

use super::saddle::redundant;
use super::saddle::vectors::{add_scaled, where_positive};

/// A pivot below 2⁸ C ε of its diagonal in S is zero.
///
/// A pivot is the squared sine of the angle between a row of A and those before it, in the metric of the kinetic
/// energy. S is known to some Nε, so smaller pivots are rounding errors: rows that are closer than about 2⁻²² (`f64`)
/// or 2⁻⁷ (`f32`) count as dependent. [`Saddle`](super::Saddle), which never squares A, tells them apart.
const ROUNDINGS: f64 = 256.0;

/// A factored Schur complement.
///
/// With several lanes the rank is common to all of them. A lane with a smaller rank than another gives NaN; the other
/// lanes are right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schur<R, const C: usize> {
    /// L without its unit diagonal, below the diagonal; of a singular matrix the generalised inverse.
    factor: [[R; C]; C],
    /// D. Solutions divide by it: the rounding of 1 / D would be the same in every step where a constraint keeps S what it
    /// is, as a rod does, and energy would drift with the number of steps instead of its root.
    pivots: [R; C],
    dropped: [bool; C],
    rank: usize,
    vanishing: Option<usize>,
}

impl<R: Real, const C: usize> Schur<R, C> {
    /// Factors S, of which only the lower triangle is read.
    #[inline]
    #[must_use]
    pub fn factor(lower: [[R; C]; C]) -> Self {
        let mut factor = lower;
        let mut pivots = [R::zero(); C];
        let mut column = [R::zero(); C];
        for k in 0..C {
            let pivot = factor[k][k];
            if !(pivot - tolerance::<R, C>() * lower[k][k]).is_positive() {
                return Self::singular(lower);
            }
            pivots[k] = pivot;
            for i in k + 1..C {
                column[i] = factor[i][k];
            }
            for i in k + 1..C {
                let l = column[i] / pivots[k];
                factor[i][k] = l;
                for j in k + 1..=i {
                    factor[i][j] = R::mul_add(-l, column[j], factor[i][j]);
                }
            }
        }
        Self { factor, pivots, dropped: [false; C], rank: C, vanishing: None }
    }

    /// κ with S κ = `y`. Where S is singular: on the rows that are not [dropped](Self::is_dropped), and the shortest of
    /// such κ that differ by a null vector of S.
    #[inline]
    #[must_use]
    pub fn solve(&self, y: [R; C]) -> [R; C] {
        if self.rank < C {
            return self.solve_singular(&y);
        }
        let mut x = y;
        for i in 0..C {
            for k in 0..i {
                x[i] = R::mul_add(-self.factor[i][k], x[k], x[i]);
            }
        }
        for (x, &pivot) in x.iter_mut().zip(&self.pivots) {
            *x /= pivot;
        }
        for i in (0..C).rev() {
            for k in 0..i {
                x[k] = R::mul_add(-self.factor[i][k], x[i], x[k]);
            }
        }
        x
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
        let upper = if self.rank < C { C } else { 0 };
        let finite = |(i, row): (usize, &[R; C])| row.iter().take(i.max(upper)).all(|x| x.is_finite());
        self.factor.iter().enumerate().all(finite) && self.pivots.iter().all(|x| x.is_finite())
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

    #[inline(never)]
    fn solve_singular(&self, y: &[R; C]) -> [R; C] {
        let mut x = [R::zero(); C];
        for c in 0..C {
            add_scaled(&mut x, &self.factor[c], y[c]);
        }
        x
    }

    /// The generalised inverse from L D Lᵀ with the largest pivot first, each relative to its diagonal in S.
    #[cold]
    #[inline(never)]
    fn singular(lower: [[R; C]; C]) -> Self {
        let zero = R::zero();
        let mut s: [[R; C]; C] =
            core::array::from_fn(|i| core::array::from_fn(|j| lower[i.max(j)][i.min(j)]));
        let diagonal: [R; C] = core::array::from_fn(|i| s[i][i]);
        let vanishing = diagonal.iter().position(|d| d.abs().largest() == zero.largest());
        let finite = s.as_flattened().iter().all(|x| x.is_finite());
        let mut this =
            Self { factor: [[zero; C]; C], pivots: [zero; C], dropped: [true; C], rank: 0, vanishing };
        if !finite {
            this.factor = [[R::from_f64(f64::NAN); C]; C];
            return this;
        }
        // Gauss–Jordan steps on [S, 1]: the kept columns of S become the combinations, those of 1 the inverse.
        let mut solution: [[R; C]; C] =
            core::array::from_fn(|i| core::array::from_fn(|j| if i == j { R::one() } else { zero }));
        let mut kept = [usize::MAX; C];
        while this.rank < C {
            let mut best = None;
            let mut size = zero.largest();
            for i in 0..C {
                let candidate = (s[i][i] / diagonal[i]).largest();
                if this.dropped[i] && candidate > size {
                    (best, size) = (Some(i), candidate);
                }
            }
            let Some(k) = best.filter(|&k| k < C) else { break };
            let excess = s[k][k] - tolerance::<R, C>() * diagonal[k];
            let pivot = if excess.is_positive() { Some(s[k][k]) } else { where_positive(s[k][k], excess) };
            let Some(pivot) = pivot else { break };
            let inverse = pivot.recip();
            for j in 0..C {
                s[k][j] *= inverse;
                solution[k][j] *= inverse;
            }
            let (above, known) = (s[k], solution[k]);
            for i in 0..C {
                if i != k {
                    let l = s[i][k];
                    add_scaled(&mut s[i], &above, -l);
                    add_scaled(&mut solution[i], &known, -l);
                }
            }
            if let Some(place) = kept.get_mut(this.rank) {
                *place = k;
            }
            this.dropped[k] = false;
            this.rank += 1;
        }
        // Row d of S is Σ x[k] · row k over the kept rows, and by symmetry the x are the entries of column d.
        let mut combinations = [[zero; C]; C];
        for (to, &k) in combinations.iter_mut().zip(&kept).take(this.rank) {
            for c in 0..C {
                let own = if c == k { R::one() } else { zero };
                to[c] = if this.dropped[c] { s.get(k).map_or(zero, |row| row[c]) } else { own };
            }
        }
        let basis = redundant::basis(&combinations, this.rank);
        for c in 0..C {
            if !this.dropped[c] {
                let column = core::array::from_fn(|i| if this.dropped[i] { zero } else { solution[i][c] });
                this.factor[c] = redundant::project(&basis, &column, this.rank);
            }
        }
        this
    }
}

/// Of a pivot, relative to its diagonal.
#[inline(always)]
fn tolerance<R: Real, const C: usize>() -> R {
    R::from_f64(ROUNDINGS * C as f64) * R::epsilon()
}
