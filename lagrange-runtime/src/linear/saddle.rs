//! The saddle-point system of constrained mechanics, solved in the null space of the constraints.
//!
//! ```text
//! M v − Aᵀ κ = r        M: N × N, symmetric        v: velocities (or accelerations, or Taylor coefficients)
//! A v        = y        A: C × N                   κ: multipliers, Aᵀ κ the forces of constraint
//! ```
//!
//! Coordinates are scaled to unit mass and rows of A to unit size, so that no decision depends on units. Then
//! A gives velocities v₀ that meet the constraints and a basis Z of those that they leave open, in which the
//! equations are Zᵀ M Z t = Zᵀ (r − M v₀). M need be regular only there: coordinates without mass are welcome
//! if the constraints tie them to others. (Nocedal and Wright, "Numerical Optimization", 2nd ed., § 16.2;
//! Golub and Van Loan, "Matrix Computations", 4th ed., §§ 5.4 and 6.2.)
//!
//! Where rows of A are clearly independent, Z comes from an elimination that solves them for as many
//! coordinates; otherwise from a Householder QR of Aᵀ with column pivoting, which decides about the rank.
//!
//! From this the blocks of the inverse are formed explicitly, because a factorisation is used some twenty
//! times:
//!
//! ```text
//! v = P r + Y y,   κ = −Yᵀ r + T y,   P = Z (Zᵀ M Z)⁻¹ Zᵀ,   A Y = 1,   T = Yᵀ M Y
//! ```
//!
//! so that a solution is one product of a matrix and a vector, without divisions and without substitutions
//! that wait for each other. Solutions are as accurate as those by substitution. Residuals are a few ulps
//! where the scaled A and Zᵀ M Z are well conditioned. Unlike those of substitution, they grow with the
//! condition number.

use super::gradients::Gradients;
use super::{CLEAR, Independence};
use crate::number::real::Real;

mod diagonal;
mod loads;
mod partition;
mod parts;
pub(super) mod range;
mod reduced;
pub(super) mod redundant;
pub(super) mod scaled;
mod side_by_side;
mod sparse;
mod switched;
mod tangent_space;
pub(super) mod vectors;

pub use diagonal::Diagonal;
pub use loads::Load;
pub use parts::{Parts, Rows as SwitchedRows};
pub use sparse::Sparse;
pub use switched::Switched;
pub(crate) use tangent_space::TangentSpace;

use partition::partition;
use range::Range;
use reduced::Reduced;
use redundant::Shortest;
use scaled::Scaled;
use vectors::{add_product, add_scaled, poison, transposed};

/// Why a saddle-point system has no solution, or several.
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

/// A factored saddle-point system, for callers that leave the method open.
pub trait SaddlePoint<R, const N: usize, const C: usize> {
    /// A.
    type Gradients: Gradients<R, N, C> + Clone;

    /// (v, κ) with M v − Aᵀ κ = `r` and A v = `y`; not finite where there is a [`defect`](Self::defect) other
    /// than a [negative](Self::negative) mass or friction that jams.
    ///
    /// If rows of A are dependent, v follows from a largest set of independent rows, and κ is the shortest of
    /// all that give the same Aᵀ κ.
    fn solve(&self, r: &[R; N], y: &[R; C]) -> ([R; N], [R; C]);

    /// The same with the friction that multipliers drive, which is no part of a projection.
    #[inline(always)]
    fn solve_motion(&self, r: &[R; N], y: &[R; C]) -> ([R; N], [R; C]) {
        self.solve(r, y)
    }

    /// How independent the rows of A are.
    fn independence(&self) -> Independence<R>;

    /// The number of independent rows of A.
    fn rank(&self) -> usize {
        self.independence().rank
    }

    /// Whether the rows of A that hold at present are independent.
    fn is_independent(&self) -> bool {
        let independence = self.independence();
        independence.rank == independence.rows
    }

    /// The distance of each lane from a state at which all lanes of a vector would have to decide together;
    /// such a state is at a distance of one. `None` where lanes have decided together, so that rounding
    /// errors of a lane depend on the others.
    #[inline(always)]
    fn apart(&self) -> Option<R> {
        None
    }

    /// Why there is no solution; `None` where there is one.
    fn defect(&self) -> Option<Defect>;

    /// The first coordinate whose mass is below zero, where accelerations would not show it.
    #[inline(always)]
    fn negative(&self) -> Option<usize> {
        None
    }

    /// The first row of A that is zero altogether: a constraint without a gradient.
    fn vanishing(&self) -> Option<usize>;

    /// Column scaling of the coordinates, which makes them comparable: 1/√M\[i]\[i] or, where that does not
    /// exist, a unit from other entries of M or from those of A; zero for a coordinate that nothing moves.
    fn units(&self) -> [R; N];
}

/// The inverse of a saddle-point system with any symmetric M.
///
/// With several lanes the order of the pivots and the rank are common to all of them
/// ([`Saddle::factor_side_by_side`] needs neither where it can). A lane with a smaller rank than another,
/// with other dependent rows, or with a singular Zᵀ M Z where another lane has a regular one gives NaN; the
/// other lanes are right. A defect of some lanes is [`Defect::NotFinite`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Saddle<R, const N: usize, const C: usize> {
    /// P, symmetric up to rounding: the row of a component of r.
    compliance: [[R; N]; N],
    /// Yᵀ: the change of v by a component of y.
    transfer: [[R; N]; C],
    /// The part of κ that a component of r takes: Y, projected where rows are dependent.
    reaction: [[R; C]; N],
    /// The change of κ by a component of y: T, likewise projected.
    stiffness: [[R; C]; C],
    units: [R; N],
    independence: Independence<R>,
    vanishing: Option<usize>,
    defect: Option<Defect>,
    /// Whether lanes have decided nothing together.
    apart: bool,
}

impl<R: Real, const N: usize, const C: usize> Saddle<R, N, C> {
    /// Factors the system of a mass matrix that is positive definite on the null space of `a`.
    ///
    /// Only the lower triangle of `mass` is read. If the system cannot be solved, [`SaddlePoint::defect`]
    /// says why.
    #[inline]
    #[must_use]
    pub fn factor(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Self {
        Self::with::<true>(mass, a)
    }

    /// Factors the system of a symmetric matrix of any signature, by partial pivoting in the null space of
    /// `a`.
    ///
    /// Only the lower triangle of `mass` is read. If the system cannot be solved, [`SaddlePoint::defect`]
    /// says why.
    #[inline]
    #[must_use]
    pub fn factor_indefinite(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Self {
        Self::with::<false>(mass, a)
    }

    #[inline(always)]
    fn with<const DEFINITE: bool>(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Self {
        let full = symmetric(mass);
        let mut split = Split { null: [[R::zero(); N]; N], inverse: [[R::zero(); C]; N] };
        // The rank is a constant, so that the loops that depend on it are unrolled. The cold part starts from
        // the arguments again, so that nothing else need be in memory.
        let scaled = Scaled::new(mass, a);
        if let Some(independence) = partition(&scaled, &mut split, |_| true) {
            let mut reduced = Reduced::new(&full, &split.null, C);
            match reduced.factor::<DEFINITE>(C) {
                Ok(()) => return Self::assemble(&split, &reduced, scaled.units, independence),
                Err(direction) if C == 1 => {
                    let singular = scaled.defect(&reduced.motion::<DEFINITE>(C, direction));
                    let finite = full.as_flattened().iter().all(|x| x.is_finite());
                    return Self::failed(if finite { singular } else { Defect::NotFinite });
                }
                Err(_) => {}
            }
        } else if C == 1 && N <= partition::WIDEST && size_of::<R>() == size_of::<R::Lane>() {
            // Each of several lanes may have a gradient, but in no common coordinate.
            return Self::without_gradient(a);
        }
        Self::carefully::<DEFINITE>(mass, a)
    }

    /// A single row of zeros, or one with an entry that is not finite. One row cannot depend on others, so a
    /// program with one constraint does not link the code that decides about rank.
    #[cold]
    #[inline(never)]
    fn without_gradient(a: &[[R; N]; C]) -> Self {
        let is_zero = a.iter().flatten().all(|&x| x == R::zero());
        Self { vanishing: is_zero.then_some(0), ..Self::failed(Defect::NotFinite) }
    }

    /// Factors by the independent rows, in a pivoted order.
    #[cold]
    #[inline(never)]
    fn carefully<const DEFINITE: bool>(mass: &[[R; N]; N], a: &[[R; N]; C]) -> Self {
        let full = symmetric(mass);
        let scaled = Scaled::new(mass, a);
        let range = Range::factor(&scaled);
        let finite = full.iter().flatten().chain(a.iter().flatten()).all(|x| x.is_finite());
        let split = range.split();
        let mut reduced = Reduced::new(&full, &split.null, range.rank);
        if let Err(direction) = reduced.factor::<DEFINITE>(range.rank) {
            let singular = scaled.defect(&reduced.motion::<DEFINITE>(range.rank, direction));
            return Self::failed(if finite { singular } else { Defect::NotFinite });
        }
        let mut this = Self::assemble(&split, &reduced, scaled.units, range.independence());
        this.vanishing = range.vanishing;
        if range.rank < C {
            let shortest = Shortest::new(range.combinations(), range.rank);
            shortest.replace(&mut this.reaction);
            shortest.replace(&mut this.stiffness);
            // A row with NaN is not taken, but it does not depend on others either.
            poison(this.compliance.as_flattened_mut(), a.as_flattened());
            poison(this.transfer.as_flattened_mut(), a.as_flattened());
            poison(this.stiffness.as_flattened_mut(), a.as_flattened());
        }
        this
    }

    /// The system of the active rows alone; multipliers of the others are zero.
    pub(super) fn with_active<const DEFINITE: bool>(
        mass: &[[R; N]; N],
        a: &[[R; N]; C],
        active: &[bool; C],
    ) -> Self {
        let mut rows = *a;
        for (row, _) in rows.iter_mut().zip(active).filter(|(_, is_active)| !**is_active) {
            *row = [R::zero(); N];
        }
        let full = symmetric(mass);
        let mut split = Split { null: [[R::zero(); N]; N], inverse: [[R::zero(); C]; N] };
        let scaled = Scaled::new(mass, &rows);
        if let Some(independence) =
            partition(&scaled, &mut split, |c| active.get(c).copied().unwrap_or(false))
        {
            let mut reduced = Reduced::new(&full, &split.null, independence.rank);
            if reduced.factor::<DEFINITE>(independence.rank).is_ok() {
                return Self::assemble(&split, &reduced, scaled.units, independence);
            }
        }
        let mut this = Self::carefully::<DEFINITE>(mass, &rows);
        this.independence.rows = active.iter().filter(|is_active| **is_active).count();
        let is_zero = |row: &[R; N]| row.iter().all(|&x| x == R::zero());
        this.vanishing = rows.iter().zip(active).position(|(row, &is_active)| is_active && is_zero(row));
        this
    }

    /// The blocks of the inverse from the null space and a right inverse of A. Code that is not optimised
    /// keeps each value in a place of its own, so there these blocks have a frame of their own.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn assemble(
        split: &Split<R, N, C>,
        reduced: &Reduced<'_, R, N>,
        units: [R; N],
        independence: Independence<R>,
    ) -> Self {
        let rank = independence.rank;
        let Split { null, inverse } = split;
        let Reduced { mass, inertia, solution, .. } = reduced;
        let mut drift = [[R::zero(); C]; N];
        for k in rank..N {
            drift[k] = add_product(&drift[k], inverse, &inertia[k]);
        }
        let mut compliance = [[R::zero(); N]; N];
        for (i, to) in compliance.iter_mut().enumerate() {
            let mut row = [R::zero(); N];
            for k in rank..N {
                add_scaled(&mut row, &null[k], solution[k][i]);
            }
            *to = row;
        }
        // Y = Y₀ − Z B⁻¹ Zᵀ M Y₀.
        let mut reaction = *inverse;
        for (i, to) in reaction.iter_mut().enumerate() {
            let mut row = *to;
            for k in rank..N {
                add_scaled(&mut row, &drift[k], -solution[k][i]);
            }
            *to = row;
        }
        let mut stiffness = [[R::zero(); C]; C];
        for (row, mass) in reaction.iter().zip(*mass) {
            let momentum = add_product(&[R::zero(); C], &reaction, mass);
            for (to, &x) in stiffness.iter_mut().zip(row) {
                add_scaled(to, &momentum, x);
            }
        }
        let transfer = transposed(&reaction);
        let (vanishing, defect, apart) = (None, None, false);
        Self { compliance, transfer, reaction, stiffness, units, independence, vanishing, defect, apart }
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
            units: [nan; N],
            independence: Independence { rank: 0, ..Independence::clear(C) },
            vanishing: None,
            defect: Some(defect),
            apart: false,
        }
    }
}

/// A symmetric matrix from its lower triangle.
#[inline(always)]
pub(super) fn symmetric<R: Copy, const N: usize>(lower: &[[R; N]; N]) -> [[R; N]; N] {
    let mut full = *lower;
    for i in 0..N {
        for j in 0..i {
            full[j][i] = lower[i][j];
        }
    }
    full
}

/// The velocities that the constraints leave open, and some that meet them.
pub(super) struct Split<R, const N: usize, const C: usize> {
    /// Zᵀ: vectors of the null space of A, in the rows `rank..N`.
    null: [[R; N]; N],
    /// Y₀ with A Y₀ = 1 on the independent rows; zero in the columns of the others.
    pub(super) inverse: [[R; C]; N],
}

impl<R: Real, const N: usize, const C: usize> SaddlePoint<R, N, C> for Saddle<R, N, C> {
    type Gradients = [[R; N]; C];

    #[inline]
    fn solve(&self, r: &[R; N], y: &[R; C]) -> ([R; N], [R; C]) {
        let mut v = add_product(&[R::zero(); N], &self.compliance, r);
        let driven = add_product(&[R::zero(); N], &self.transfer, y);
        add_scaled(&mut v, &driven, R::one());
        let mut kappa = add_product(&[R::zero(); C], &self.stiffness, y);
        let reaction = add_product(&[R::zero(); C], &self.reaction, r);
        add_scaled(&mut kappa, &reaction, -R::one());
        (v, kappa)
    }

    #[inline]
    fn independence(&self) -> Independence<R> {
        self.independence
    }

    #[inline]
    fn apart(&self) -> Option<R> {
        self.apart.then(|| self.independence.least * R::from_f64(1.0 / CLEAR))
    }

    fn defect(&self) -> Option<Defect> {
        // This is looked for when somebody asks, because the solutions show it as well.
        let finite = |block: &[R]| block.iter().all(|x| x.is_finite());
        let all = finite(self.compliance.as_flattened())
            && finite(self.transfer.as_flattened())
            && finite(self.stiffness.as_flattened());
        self.defect.or(if all { None } else { Some(Defect::NotFinite) })
    }

    #[inline]
    fn vanishing(&self) -> Option<usize> {
        self.vanishing
    }

    #[inline]
    fn units(&self) -> [R; N] {
        self.units
    }
}

#[cfg(test)]
mod tests;
