//! The saddle-point system of constrained mechanics, solved in the null space of the constraints.
//!
//! ```text
//! M v − Aᵀ κ = r        M: N × N, symmetric        v: velocities (or accelerations, or Taylor coefficients)
//! A v        = y        A: C × N                   κ: multipliers, Aᵀ κ the forces of constraint
//! ```
//!
//! Coordinates are scaled to unit mass and rows of A to unit size, so that no decision depends on units. A
//! Householder QR of Aᵀ with column pivoting finds the independent rows, a right inverse of them, and an orthonormal
//! basis Z of the null space of A; in that basis the equations are Zᵀ M Z t = Zᵀ (r − M v₀), where M need be regular
//! only there: coordinates without mass are welcome if the constraints tie them to others. (Nocedal and Wright,
//! "Numerical Optimization", 2nd ed., § 16.2; Golub and Van Loan, "Matrix Computations", 4th ed., §§ 5.4 and 6.2.)
//!
//! From this the blocks of the inverse are formed explicitly, because a factorisation is used some twenty times:
//!
//! ```text
//! v = P r + Y y,   κ = −Yᵀ r + T y,   P = Z (Zᵀ M Z)⁻¹ Zᵀ,   A Y = 1,   T = Yᵀ M Y
//! ```
//!
//! so that a solution is one product of a matrix and a vector, without divisions and without substitutions that wait
//! for each other. The residuals are those of a factorisation times, at most, the condition of the scaled Zᵀ M Z.

use crate::real::Real;

mod diagonal;
mod range;
mod reduced;
pub(super) mod redundant;
pub(super) mod vectors;

pub use diagonal::Diagonal;

use range::Range;
use reduced::Reduced;
use vectors::{add_scaled, dot};

/// Why a saddle-point system has no solution, or not one only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Defect {
    /// M is singular on the null space of A: a motion that the constraints allow has no inertia.
    Singular {
        /// The coordinate that takes the largest part in that motion.
        coordinate: usize,
    },
    /// M or A is infinite or NaN, or so large or small that a result is.
    NotFinite,
}

/// A factored saddle-point system: what a caller needs that leaves the method open.
pub trait SaddlePoint<R, const N: usize, const C: usize> {
    /// (v, κ) with M v − Aᵀ κ = `r` and A v = `y`; NaN where there is a [`defect`](Self::defect).
    ///
    /// Of dependent rows of A the ones that were [dropped](Self::is_dropped) have no say in v, and κ is the shortest
    /// of all that give the same Aᵀ κ.
    fn solve(&self, r: &[R; N], y: &[R; C]) -> ([R; N], [R; C]);

    /// How many rows of A are independent.
    fn rank(&self) -> usize;

    /// Why there is no solution; `None` where there is one.
    fn defect(&self) -> Option<Defect>;

    /// Whether this row of A depends on the others and was left out. False for rows that do not exist.
    fn is_dropped(&self, row: usize) -> bool;

    /// The first row of A that is zero altogether: a constraint without a gradient.
    fn vanishing(&self) -> Option<usize>;
}

/// The inverse of a saddle-point system with any symmetric M.
///
/// With several lanes the order of the pivots and the rank are common to all of them. A lane that has a smaller rank
/// than another, or a singular Zᵀ M Z where another has none, gives NaN; the other lanes are right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Saddle<R, const N: usize, const C: usize> {
    /// P, symmetric up to rounding: the row of a component of r.
    compliance: [[R; N]; N],
    /// Yᵀ: what a component of y adds to v.
    transfer: [[R; N]; C],
    /// What a component of r takes from κ: Y, projected where rows are dependent.
    reaction: [[R; C]; N],
    /// What a component of y adds to κ: T, likewise.
    stiffness: [[R; C]; C],
    dropped: [bool; C],
    rank: usize,
    vanishing: Option<usize>,
    defect: Option<Defect>,
}

impl<R: Real, const N: usize, const C: usize> Saddle<R, N, C> {
    /// Factors the system of a mass matrix that is positive definite on the null space of `a`.
    ///
    /// Only the lower triangle of `mass` is read. What cannot be solved is left to [`SaddlePoint::defect`].
    #[inline]
    #[must_use]
    pub fn factor(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Self {
        Self::with(mass, a, Reduced::definite)
    }

    /// Factors the system of a symmetric matrix of any signature, by partial pivoting in the null space of `a`.
    ///
    /// Only the lower triangle of `mass` is read. What cannot be solved is left to [`SaddlePoint::defect`].
    #[inline]
    #[must_use]
    pub fn factor_indefinite(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Self {
        Self::with(mass, a, Reduced::indefinite)
    }

    #[inline(always)]
    fn with(
        mass: &[[R; N]; N],
        a: &[[R; N]; C],
        reduce: impl Fn(&mut Reduced<R, N>, usize) -> Result<(), Defect>,
    ) -> Self {
        let mass = core::array::from_fn(|i| core::array::from_fn(|j| mass[i.max(j)][i.min(j)]));
        let range = Range::factor(&mass, a);
        if C <= N && range.rank == C {
            // The rank as a constant: the loops that depend on it are unrolled.
            return Self::assemble(&mass, &range, C, reduce);
        }
        let deficient = Self::assemble(&mass, &range, range.rank, reduce);
        if a.iter().flatten().all(|x| x.is_finite()) {
            deficient.shortest(&range)
        } else {
            Self::failed(Defect::NotFinite)
        }
    }

    /// The blocks of the inverse from the independent rows; those of the dropped rows are zero.
    #[inline(always)]
    fn assemble(
        mass: &[[R; N]; N],
        range: &Range<R, N, C>,
        rank: usize,
        reduce: impl Fn(&mut Reduced<R, N>, usize) -> Result<(), Defect>,
    ) -> Self {
        let rank = rank.min(C).min(N);
        let basis = range.basis(rank);
        let inverse = range.right_inverse(&basis, rank);
        let mut reduced = Reduced::new(mass, &basis, &range.scale, rank);
        if let Err(defect) = reduce(&mut reduced, rank) {
            return Self::failed(defect);
        }
        let mut this = Self {
            compliance: [[R::zero(); N]; N],
            transfer: [[R::zero(); N]; C],
            reaction: [[R::zero(); C]; N],
            stiffness: [[R::zero(); C]; C],
            dropped: [true; C],
            rank,
            vanishing: range.vanishing,
            defect: None,
        };
        for k in rank..N {
            for i in 0..N {
                add_scaled(&mut this.compliance[i], &basis[k], reduced.solution[k][i]);
            }
        }
        // Y = Y₀ − P M Y₀, row by row of Yᵀ.
        let mut transfer = inverse;
        for row in transfer.iter_mut().take(rank) {
            let start = *row;
            for k in rank..N {
                add_scaled(row, &reduced.solution[k], -dot(&reduced.inertia[k], &start));
            }
        }
        let mut stiffness = [[R::zero(); C]; C];
        for k in 0..rank {
            let mut momentum = [R::zero(); N];
            for j in 0..N {
                add_scaled(&mut momentum, &mass[j], transfer[k][j]);
            }
            for l in 0..=k {
                let entry = dot(&momentum, &transfer[l]);
                (stiffness[k][l], stiffness[l][k]) = (entry, entry);
            }
        }
        // Back to the user's order of rows.
        for k in 0..rank {
            let row = range.order[k];
            if let (Some(to), Some(dropped)) = (this.transfer.get_mut(row), this.dropped.get_mut(row)) {
                (*to, *dropped) = (transfer[k], false);
            }
            for i in 0..N {
                if let Some(to) = this.reaction[i].get_mut(row) {
                    *to = transfer[k][i];
                }
            }
            for l in 0..rank {
                if let Some(to) = this.stiffness.get_mut(row).and_then(|to| to.get_mut(range.order[l])) {
                    *to = stiffness[k][l];
                }
            }
        }
        this
    }

    /// The shortest multipliers instead of those that leave the dropped rows at zero.
    #[cold]
    #[inline(never)]
    fn shortest(mut self, range: &Range<R, N, C>) -> Self {
        let combinations = range.combinations(self.rank);
        let basis = redundant::basis(&combinations, self.rank);
        for row in self.reaction.iter_mut().chain(&mut self.stiffness) {
            *row = redundant::project(&basis, row, self.rank);
        }
        self
    }

    /// A system whose solutions are NaN.
    #[cold]
    #[inline(never)]
    fn failed(defect: Defect) -> Self {
        let nan = R::from_f64(f64::NAN);
        Self {
            compliance: [[nan; N]; N],
            transfer: [[nan; N]; C],
            reaction: [[nan; C]; N],
            stiffness: [[nan; C]; C],
            dropped: [false; C],
            rank: 0,
            vanishing: None,
            defect: Some(defect),
        }
    }
}

impl<R: Real, const N: usize, const C: usize> SaddlePoint<R, N, C> for Saddle<R, N, C> {
    #[inline]
    fn solve(&self, r: &[R; N], y: &[R; C]) -> ([R; N], [R; C]) {
        // Two sums each, so that the additions of one need not wait for those of the other.
        let (mut v, mut driven) = ([R::zero(); N], [R::zero(); N]);
        let (mut kappa, mut reaction) = ([R::zero(); C], [R::zero(); C]);
        for j in 0..N {
            add_scaled(&mut v, &self.compliance[j], r[j]);
            add_scaled(&mut reaction, &self.reaction[j], r[j]);
        }
        for c in 0..C {
            add_scaled(&mut driven, &self.transfer[c], y[c]);
            add_scaled(&mut kappa, &self.stiffness[c], y[c]);
        }
        for i in 0..N {
            v[i] += driven[i];
        }
        for c in 0..C {
            kappa[c] -= reaction[c];
        }
        (v, kappa)
    }

    #[inline]
    fn rank(&self) -> usize {
        self.rank
    }

    fn defect(&self) -> Option<Defect> {
        // Looked for only when somebody asks, because the solutions show it as well.
        let finite = |block: &[R]| block.iter().all(|x| x.is_finite());
        let all = finite(self.compliance.as_flattened())
            && finite(self.transfer.as_flattened())
            && finite(self.stiffness.as_flattened());
        self.defect.or(if all { None } else { Some(Defect::NotFinite) })
    }

    #[inline]
    fn is_dropped(&self, row: usize) -> bool {
        self.dropped.get(row).copied().unwrap_or(false)
    }

    #[inline]
    fn vanishing(&self) -> Option<usize> {
        self.vanishing
    }
}

#[cfg(test)]
mod tests;
