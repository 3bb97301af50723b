//! The point of a polyhedron that is nearest to the origin.
//!
//! Of the x with pⱼ · x ≥ dⱼ the shortest is a sum of rows, x = Σ yⱼ pⱼ with yⱼ ≥ 0. Rows may have one more
//! entry than the rows of a system, the `last`. Least squares with
//! unknowns that are not negative find it: with u from min |Σ uⱼ (pⱼ, dⱼ) − (0, 1)|, y is u over 1 − Σ uⱼ dⱼ.
//! Only rows whose residual asks for them enter, so those that do are independent (Lawson and Hanson,
//! *Solving Least Squares Problems*, chapter 23).

use super::scene::{above, entry, most, product, put, rounding};
use crate::number::elements::array;
use crate::number::real::Real;

/// The y of the shortest x. `None` where there is no x, or none nearer than some 1/√[`rounding`] times the
/// distance of the furthest bound. Rows of zeros demand nothing.
pub(super) fn nearest<R: Real, const C: usize>(
    rows: &[[R; C]; C],
    last: &[R; C],
    bounds: &[R; C],
) -> Option<[R; C]> {
    let (zero, one) = (R::zero(), R::one());
    let times = |i: usize, j: usize| product(&rows[i], &rows[j]) + last[i] * last[j];
    // Rows of unit length, and the largest of the bounds for a unit.
    let scales: [R; C] = array(|j| {
        let length = times(j, j).sqrt();
        if length.is_positive() { length.recip() } else { zero }
    });
    let far = (0..C).fold(zero, |far, j| most(far, bounds[j] * scales[j]));
    if !far.is_positive() {
        return Some([zero; C]);
    }
    let asked: [R; C] = array(|j| bounds[j] * scales[j] / far);
    let counts = |j: usize| scales[j].is_positive();
    let product_of = |i: usize, j: usize| times(i, j) * scales[i] * scales[j] + asked[i] * asked[j];
    let gram: [[R; C]; C] =
        array(|i| array(|j| if counts(i) && counts(j) { product_of(i, j) } else { zero }));
    let (mut enters, mut u) = ([false; C], [zero; C]);
    // Each round makes the residual shorter, so none of the sets comes twice.
    for _ in 0..8 * C {
        let lacks = |j: usize| asked[j] - product(&gram[j], &u);
        let free = (0..C).filter(|&j| !enters[j] && counts(j));
        let most_lacking = free.fold(None, |most: Option<(usize, R)>, j| {
            let lack = lacks(j);
            if most.is_none_or(|(_, other)| above(lack, other)) { Some((j, lack)) } else { most }
        });
        let Some((j, _)) = most_lacking.filter(|&(_, lack)| above(lack, rounding())) else {
            let rest = one - product(&asked, &u);
            return above(rest, rounding()).then(|| array(|j| u[j] / rest * far * scales[j]));
        };
        enters[j] = true;
        // Goes back to where the first of them is zero, as long as one would be negative.
        while enters.contains(&true) {
            let next = among(&gram, &asked, &enters)?;
            let first = (0..C).filter(|&j| enters[j] && !next[j].is_positive());
            let first = first.fold(None, |first: Option<(usize, R)>, j| {
                let share = if u[j].is_positive() { u[j] / (u[j] - next[j]) } else { zero };
                if first.is_none_or(|(_, other)| above(other, share)) { Some((j, share)) } else { first }
            });
            let Some((leaves, share)) = first else {
                u = next;
                break;
            };
            for (u, next) in u.iter_mut().zip(next) {
                *u += share * (next - *u);
            }
            (enters[leaves], u[leaves]) = (false, zero);
        }
    }
    None
}

/// The u with Σ gram u = `wanted` in the rows that enter, and zero in all others; `None` where these rows
/// depend on each other. The matrix is positive definite, so that elimination needs no exchange of rows.
fn among<R: Real, const C: usize>(gram: &[[R; C]; C], wanted: &[R; C], enters: &[bool; C]) -> Option<[R; C]> {
    let count = enters.iter().filter(|&&enters| enters).count();
    let ulps = R::from_f64(2.0 * count as f64) * R::epsilon();
    let (mut left, mut right) = (*gram, *wanted);
    for (k, _) in enters.iter().enumerate().filter(|(_, enters)| **enters) {
        let size = gram.iter().zip(enters).filter(|(_, enters)| **enters);
        let size = size.fold(R::zero(), |sum, (row, _)| sum + entry(row, k).abs());
        let (above_it, own) = (left.get(k).copied()?, entry(&right, k));
        let pivot = entry(&above_it, k);
        if !above(pivot, ulps * size) {
            return None;
        }
        let inverse = pivot.recip();
        let later = left.iter_mut().zip(&mut right).zip(enters).skip(k + 1);
        for ((row, right), _) in later.filter(|(_, enters)| **enters) {
            let share = entry(row, k) * inverse;
            let entries = row.iter_mut().zip(&above_it).zip(enters).skip(k + 1);
            for ((x, &above_it), _) in entries.filter(|(_, enters)| **enters) {
                *x -= share * above_it;
            }
            *right -= share * own;
        }
    }
    let mut u = [R::zero(); C];
    for (i, (row, &right)) in left.iter().zip(&right).enumerate().rev() {
        if enters.get(i) == Some(&true) {
            let known = row.iter().zip(&u).skip(i + 1).fold(right, |rest, (&x, &u)| rest - x * u);
            put(&mut u, i, known / entry(row, i));
        }
    }
    Some(u)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn close<const C: usize>(rows: [[f64; C]; C], bounds: [f64; C], x: [f64; C]) {
        let y = nearest(&rows, &[0.0; C], &bounds).unwrap();
        assert!(y.iter().all(|&y| y >= 0.0), "{y:?}");
        for (i, &wanted) in x.iter().enumerate() {
            let found: f64 = (0..C).map(|j| y[j] * rows[j][i]).sum();
            assert!((found - wanted).abs() < 1e-12 * (1.0 + wanted.abs()), "{found} instead of {wanted}");
        }
    }

    #[test]
    fn an_origin_that_meets_all_bounds_is_the_nearest() {
        close([[1.0, 0.0], [0.0, 1.0]], [-1.0, 0.0], [0.0, 0.0]);
    }

    #[test]
    fn the_nearest_point_lies_on_an_edge_or_in_a_corner() {
        close([[1.0, 1.0], [0.0, 1.0]], [2.0, -5.0], [1.0, 1.0]);
        close([[1.0, 0.0], [1.0, 1.0]], [3.0, 4.0], [3.0, 1.0]);
        close([[1e-6, 0.0], [1e6, 1e6]], [3e-6, 4e6], [3.0, 1.0]);
    }

    #[test]
    fn a_bound_that_others_hide_leaves_again() {
        // Of unit rows the first lacks most and enters at once. Where the others meet, it lacks nothing.
        close([[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, -1.0, 0.0]], [3.0, 4.0, 4.0], [4.0, 0.0, 0.0]);
    }

    #[test]
    fn a_bound_that_others_meet_never_enters() {
        close(
            [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0]],
            [1.0, 4.0, 4.0],
            [8.0 / 3.0, 4.0 / 3.0, 4.0 / 3.0],
        );
    }

    #[test]
    fn rows_twice_and_rows_of_zero_do_no_harm() {
        close([[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0; 3]], [2.0, 2.0, 1.0], [1.0, 1.0, 0.0]);
    }

    #[test]
    fn bounds_that_contradict_have_no_point() {
        assert_eq!(nearest(&[[1.0, 0.0], [-1.0, 0.0]], &[0.0; 2], &[1.0, 1.0]), None);
    }
}
