//! The independence of the rows of a constraint matrix, and the numbers that decide about it.
//!
//! Rows are measured in the metric of the kinetic energy, each relative to its own size. The distance of a
//! row from the span of the others is then about the smallest singular value σ of A M^(−1/2). A constraint
//! function is known to ε of its summands, so coordinates are known to ε/σ. Each decision follows from where
//! that meets another number of the arithmetic:
//!
//! * Below **√ε** a row is dependent. What it alone restricts enters the constraint function by its square.
//!   So rounding errors of the function leave these coordinates uncertain by √ε already, and they hide
//!   everything that a linear row of less than √ε could tell. (Golub and Van Loan, "Matrix Computations", 4th
//!   ed., § 5.5, on numerical rank.)
//! * Below **∜ε** a state is poorly determined: the direction of the motion, a derivative of the gradients,
//!   is known to ε/σ² only, which is √ε there, half of all digits. Steps do not end at such a state where
//!   they can end beside it.
//! * From **a quarter** on rows are far apart. An error across the constraints then changes the direction by
//!   1/σ² ≤ 16 times itself, which the check of a step allows anyway. Below that it is compared with its
//!   square.

use crate::number::real::Real;

/// The independence of the rows of A at a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Independence<R> {
    /// The number of rows.
    pub rows: usize,
    /// The number of independent rows.
    pub rank: usize,
    /// About the smallest distance of an independent row from the span of those before it, relative to its
    /// size; 1 for a single row.
    pub least: R,
    /// The row that depends on the others, or is closest to doing so.
    pub weakest: usize,
}

impl<R: Real> Independence<R> {
    /// The independence of rows that are orthogonal to each other.
    #[inline(always)]
    pub fn clear(rows: usize) -> Self {
        Self { rows, rank: rows, least: R::one(), weakest: 0 }
    }

    /// Whether all rows are clearly independent, in every lane.
    #[inline(always)]
    pub fn is_clear(&self) -> bool {
        self.rank == self.rows && self.is_least(R::from_f64(CLEAR))
    }

    /// Whether all rows are far apart, in every lane.
    #[inline(always)]
    pub(crate) fn are_far_apart(&self) -> bool {
        self.rank == self.rows && self.is_least(R::from_f64(FAR_APART))
    }

    /// Whether no distance is smaller, in any lane.
    #[inline(always)]
    fn is_least(&self, distance: R) -> bool {
        (distance - self.least).largest() <= R::zero().largest()
    }

    /// Adds a row at this distance from those before it.
    #[inline(always)]
    pub(crate) fn take(&mut self, row: usize, distance: R) {
        if (self.least - distance).largest() > R::zero().largest() {
            (self.least, self.weakest) = (self.least.min(distance), row);
        }
    }

    /// Whether all rows are independent and determine the state well, in every lane.
    #[inline]
    pub fn is_determined(&self) -> bool {
        self.rank == self.rows && (self.least - determined()).is_positive()
    }

    /// Whether more is determined than in `other`: more rows are independent, or as many rows are and their
    /// distance is above `least` here and not in `other`.
    pub(crate) fn improves(&self, other: &Self, least: R) -> bool {
        let well = |this: &Self| (this.least - least).is_positive();
        self.rank > other.rank || self.rank == other.rank && well(self) && !well(other)
    }
}

/// The distance from which rows are clearly independent, in any precision: three rows at this distance cost
/// as many digits as `f32` has. Of random systems with as many constraints as coordinates one in a hundred is
/// below, of others hardly any.
pub(crate) const CLEAR: f64 = 1.0 / 256.0;

/// The distance from which rows are far apart.
const FAR_APART: f64 = 0.25;

/// The distance below which a row depends on others: √ε.
#[inline]
pub(crate) fn dependent<R: Real>() -> R {
    R::epsilon().sqrt()
}

/// The distance from which a state is well determined: ∜ε.
#[inline]
pub(crate) fn determined<R: Real>() -> R {
    dependent::<R>().sqrt()
}
