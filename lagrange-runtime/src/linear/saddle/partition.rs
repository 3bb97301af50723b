//! The fast way to the null space: as many coordinates are expressed by the others as there are constraints.
//!
//! A Gauss–Jordan elimination of A, row by row in the order given, each solved for the coordinate in which it
//! is largest: v\[lead] = Y₀ y − X v\[free]. (Wehage and Haug, "Generalized coordinate partitioning for
//! dimension reduction in analysis of constrained dynamic systems", 1982.) That is as accurate as orthogonal
//! vectors where all pivots are well away from zero, and half the work; where one is not,
//! [`Range`](super::range::Range) decides.

use crate::linear::independence::{CLEAR, Independence};
use crate::number::elements::{Each, array};
use crate::number::real::Real;

use super::Split;
use super::scaled::Scaled;
use super::vectors::{add_scaled, pick, put, scale, smallest};

/// A length of rows up to which the largest entry is certainly above [`CLEAR`]: the magnitudes add up to one.
pub(super) const WIDEST: usize = 128;

/// Fills `split` from the active rows where they are clearly independent, and says how much they are.
///
/// `None`, with `split` in disorder, if there are more of them than coordinates, or if a pivot is no larger a
/// part of its row than [`CLEAR`]: in any lane, since the coordinates are common to all lanes.
#[inline(always)]
pub(super) fn partition<R: Real, const N: usize, const C: usize>(
    scaled: &Scaled<R, N, C>,
    split: &mut Split<R, N, C>,
    is_active: impl Fn(usize) -> bool,
) -> Option<Independence<R>> {
    let count = (0..C).filter(|&k| is_active(k)).count();
    if count > N {
        return None;
    }
    let mut independence = Independence::clear(count);
    let mut rows = scaled.rows;
    // The unit matrix with the operations on rows made so far. It is not stored in place of columns of A, nor
    // computed up to the diagonal only: constant indices and lengths are faster than half the work.
    let mut parts = [[R::zero(); C]; C];
    // The coordinates of the rows in the order of elimination, then those that stay free.
    let mut places: [usize; N] = array(|i| i);
    // The coordinate of each row, by the index of the row.
    let mut leads = [0; C];
    let mut rank = 0;
    for k in 0..C {
        if !is_active(k) {
            continue;
        }
        parts[k][k] = scaled.factors[k];
        let lead = largest(&rows[k]);
        let pivot = pick(&rows[k], lead);
        if !(pivot.abs() - R::from_f64(CLEAR)).is_positive() {
            return None;
        }
        if rank > 0 {
            independence.take(k, pivot.abs());
        }
        let inverse = pivot.recip();
        scale(&mut rows[k], inverse);
        scale(&mut parts[k], inverse);
        // The column of a lead becomes 0 up to rounding, and is not read again.
        let (row, part) = (rows[k], parts[k]);
        for c in 0..C {
            if c != k && is_active(c) {
                let l = -pick(&rows[c], lead);
                add_scaled(&mut rows[c], &row, l);
                add_scaled(&mut parts[c], &part, l);
            }
        }
        for i in rank..N {
            if places[i] == lead {
                places[i] = places[rank];
            }
        }
        put(&mut places, rank, lead);
        leads[k] = lead;
        rank += 1;
    }
    for k in 0..C {
        if is_active(k) {
            let unit = pick(&scaled.units, leads[k]);
            put(&mut split.inverse, leads[k], parts[k].each(|x| x * unit));
        }
    }
    #[expect(clippy::needless_range_loop, reason = "a loop that counts is unrolled on every target")]
    for i in count..N {
        let (vector, free) = (&mut split.null[i], places[i]);
        put(vector, free, pick(&scaled.units, free));
        for k in 0..C {
            if is_active(k) {
                let entry = pick(&rows[k], free) * pick(&scaled.units, leads[k]);
                put(vector, leads[k], -entry);
            }
        }
    }
    Some(independence)
}

/// The index of the entry whose smallest lane is largest: by halves, so that few comparisons wait for
/// others.
#[inline(always)]
fn largest<R: Real, const N: usize>(row: &[R; N]) -> usize {
    let mut places: [usize; N] = array(|i| i);
    let mut sizes = row.each(|x| smallest(x.abs()));
    let mut length = N;
    while length > 1 {
        let half = length.div_ceil(2);
        for i in 0..length - half {
            if sizes[i + half] > sizes[i] {
                (places[i], sizes[i]) = (places[i + half], sizes[i + half]);
            }
        }
        length = half;
    }
    places.first().copied().unwrap_or(0)
}
