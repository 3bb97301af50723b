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
mod partition;
mod range;
mod reduced;
pub(super) mod redundant;
mod scaled;
pub(super) mod vectors;

pub use diagonal::Diagonal;

use partition::partition;
use range::Range;
use reduced::Reduced;
use scaled::Scaled;
use vectors::{add_scaled, put};

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
        Self::with::<true>(mass, a)
    }

    /// Factors the system of a symmetric matrix of any signature, by partial pivoting in the null space of `a`.
    ///
    /// Only the lower triangle of `mass` is read. What cannot be solved is left to [`SaddlePoint::defect`].
    #[inline]
    #[must_use]
    pub fn factor_indefinite(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Self {
        Self::with::<false>(mass, a)
    }

    #[inline(always)]
    fn with<const DEFINITE: bool>(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Self {
        let full = symmetric(mass);
        let mut split = Split { null: [[R::zero(); N]; N], inverse: [[R::zero(); C]; N] };
        // The rank as a constant, so that the loops that depend on it are unrolled; and what is cold starts from the
        // arguments again, so that nothing else need be in memory.
        if partition(&Scaled::new(&full, a), &mut split) {
            let mut reduced = Reduced::new(&full, &split.null, C);
            if reduced.factor::<DEFINITE>(C).is_ok() {
                return Self::assemble(&split, &reduced, C);
            }
        }
        Self::carefully::<DEFINITE>(mass, a)
    }

    /// By the rows that are independent, in a pivoted order.
    #[cold]
    #[inline(never)]
    fn carefully<const DEFINITE: bool>(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Self {
        let full = symmetric(mass);
        let scaled = Scaled::new(&full, a);
        let range = Range::factor(&scaled);
        let finite = full.iter().flatten().chain(a.iter().flatten()).all(|x| x.is_finite());
        if range.rank < C && !finite {
            return Self::failed(Defect::NotFinite);
        }
        let split = range.split();
        let mut reduced = Reduced::new(&full, &split.null, range.rank);
        if let Err(direction) = reduced.factor::<DEFINITE>(range.rank) {
            let singular = scaled.defect(&reduced.motion::<DEFINITE>(range.rank, direction));
            return Self::failed(if finite { singular } else { Defect::NotFinite });
        }
        let mut this = Self::assemble(&split, &reduced, range.rank);
        this.vanishing = range.vanishing;
        if range.rank < C {
            for &row in range.order.iter().skip(range.rank) {
                put(&mut this.dropped, row, true);
            }
            this.shorten(&range);
        }
        this
    }

    /// The blocks of the inverse from the null space and a right inverse of A.
    #[inline(always)]
    fn assemble(split: &Split<R, N, C>, reduced: &Reduced<'_, R, N>, rank: usize) -> Self {
        // Y = Y₀ − Z B⁻¹ Zᵀ M Y₀.
        let mut drift = [[R::zero(); C]; N];
        for k in rank..N {
            for i in 0..N {
                add_scaled(&mut drift[k], &split.inverse[i], reduced.inertia[k][i]);
            }
        }
        let mut compliance = [[R::zero(); N]; N];
        let mut reaction = split.inverse;
        for i in 0..N {
            for k in rank..N {
                add_scaled(&mut compliance[i], &split.null[k], reduced.solution[k][i]);
                add_scaled(&mut reaction[i], &drift[k], -reduced.solution[k][i]);
            }
        }
        let mut stiffness = [[R::zero(); C]; C];
        let mut transfer = [[R::zero(); N]; C];
        for i in 0..N {
            let mut momentum = [R::zero(); C];
            for j in 0..N {
                add_scaled(&mut momentum, &reaction[j], reduced.mass[i][j]);
            }
            for c in 0..C {
                add_scaled(&mut stiffness[c], &momentum, reaction[i][c]);
                transfer[c][i] = reaction[i][c];
            }
        }
        Self {
            compliance,
            transfer,
            reaction,
            stiffness,
            dropped: [false; C],
            rank,
            vanishing: None,
            defect: None,
        }
    }

    /// The shortest multipliers instead of those that leave the dropped rows at zero.
    fn shorten(&mut self, range: &Range<R, N, C>) {
        let basis = redundant::basis(&range.combinations(), self.rank);
        for row in self.reaction.iter_mut().chain(&mut self.stiffness) {
            *row = redundant::project(&basis, row, self.rank);
        }
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

/// A symmetric matrix from its lower triangle.
#[inline(always)]
fn symmetric<R: Copy, const N: usize>(lower: &[[R; N]; N]) -> [[R; N]; N] {
    core::array::from_fn(|i| core::array::from_fn(|j| lower[i.max(j)][i.min(j)]))
}

/// The velocities that the constraints leave open, and some that meet them.
struct Split<R, const N: usize, const C: usize> {
    /// Zᵀ: vectors of the null space of A, in the rows `rank..N`.
    null: [[R; N]; N],
    /// Y₀ with A Y₀ = 1 on the independent rows; zero in the columns of the others.
    inverse: [[R; C]; N],
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
