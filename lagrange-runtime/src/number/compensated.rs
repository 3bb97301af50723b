//! Sums that keep what rounding would lose (W. Kahan, "Further remarks on reducing truncation errors", Comm.
//! ACM 8, 1965).

use super::real::Real;

/// x + d, and the residue that the next sum takes up; `residue` is that of the last one.
#[inline(always)]
pub(crate) fn add<R: Real>(x: R, residue: R, d: R) -> (R, R) {
    let d = d + residue;
    let sum = x + d;
    (sum, d - (sum - x))
}
