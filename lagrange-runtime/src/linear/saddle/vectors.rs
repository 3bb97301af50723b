//! Sums over vectors of fixed length, in an order that the processor need not wait for.

use crate::real::Real;

/// aᵀ b in four partial sums.
#[inline(always)]
pub(in crate::linear) fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    let mut sums = [R::zero(); 4];
    for i in 0..N {
        sums[i % 4] = if i < 4 { a[i] * b[i] } else { R::mul_add(a[i], b[i], sums[i % 4]) };
    }
    match N {
        0 | 1 => sums[0],
        2 => sums[0] + sums[1],
        3 => sums[0] + sums[1] + sums[2],
        _ => (sums[0] + sums[2]) + (sums[1] + sums[3]),
    }
}

/// Σ |aᵢ|.
#[inline(always)]
pub(in crate::linear) fn magnitude<R: Real, const N: usize>(a: &[R; N]) -> R {
    let mut sums = [R::zero(); 4];
    for i in 0..N {
        sums[i % 4] = if i < 4 { a[i].abs() } else { sums[i % 4] + a[i].abs() };
    }
    (sums[0] + sums[2]) + (sums[1] + sums[3])
}

/// sum ← sum + a · factor.
#[inline(always)]
pub(in crate::linear) fn add_scaled<R: Real, const N: usize>(sum: &mut [R; N], a: &[R; N], factor: R) {
    for i in 0..N {
        sum[i] = R::mul_add(a[i], factor, sum[i]);
    }
}

/// `value` in the lanes where `excess` is positive, NaN in the others; `None` if it is positive nowhere.
#[cold]
#[inline(never)]
pub(in crate::linear) fn where_positive<R: Real>(value: R, excess: R) -> Option<R> {
    let excess = excess.max(R::zero());
    if excess.largest() > R::zero().largest() { Some(value * (excess / excess)) } else { None }
}

/// The entry at a place known at run time only; zero outside.
///
/// A few entries are compared one by one, which keeps the array in registers.
#[inline(always)]
pub(in crate::linear) fn pick<R: Real, const N: usize>(row: &[R; N], place: usize) -> R {
    if N > 4 {
        return row.get(place).copied().unwrap_or(R::zero());
    }
    let mut entry = R::zero();
    for i in 0..N {
        if i == place {
            entry = row[i];
        }
    }
    entry
}

/// Writes the entry at a place known at run time only.
#[inline(always)]
pub(in crate::linear) fn put<T: Copy, const N: usize>(row: &mut [T; N], place: usize, entry: T) {
    if N > 4 {
        if let Some(to) = row.get_mut(place) {
            *to = entry;
        }
        return;
    }
    for i in 0..N {
        if i == place {
            row[i] = entry;
        }
    }
}
