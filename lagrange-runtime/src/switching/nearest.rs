//! The point of a polyhedron that is nearest to the origin.
//!
//! Of the x with pⱼ · x ≥ dⱼ the shortest is a sum of rows, x = Σ yⱼ pⱼ with yⱼ ≥ 0. Rows may have one more
//! entry than the rows of a system, the `last`. Least squares with unknowns that are not negative find it:
//! with u from min |Σ uⱼ (pⱼ, dⱼ) − (0, 1)|, y is u over 1 − Σ uⱼ dⱼ. Only rows whose residual asks for them
//! enter, so those that do are independent (Lawson and Hanson, *Solving Least Squares Problems*, chapter 23).
//! Rows that almost contradict each other almost depend on each other: they are made orthogonal, since
//! products of them would have the square of that small distance.

use super::scene::{above, entry, most, product, put, rounding};
use crate::number::elements::{Each, array};
use crate::number::real::Real;

/// A bound p · x ≥ d. A row of zeros demands nothing.
#[derive(Clone, Copy)]
pub(super) struct Bound<R, const C: usize> {
    /// p.
    pub(super) row: [R; C],
    /// The last entry of p.
    pub(super) last: R,
    /// d.
    pub(super) least: R,
}

impl<R: Real, const C: usize> Bound<R, C> {
    /// None.
    pub(super) fn none() -> Self {
        Self { row: [R::zero(); C], last: R::zero(), least: R::zero() }
    }

    /// The length of p.
    fn length(&self) -> R {
        (product(&self.row, &self.row) + self.last * self.last).sqrt()
    }

    /// The product with another one, d with d.
    fn product(&self, other: &Self) -> R {
        product(&self.row, &other.row) + self.last * other.last + self.least * other.least
    }

    /// The sum with a multiple of another one.
    fn plus(&self, factor: R, other: &Self) -> Self {
        Self {
            row: array(|i| factor.mul_add(other.row[i], self.row[i])),
            last: factor.mul_add(other.last, self.last),
            least: factor.mul_add(other.least, self.least),
        }
    }

    /// The same bound with p of length one, and `far` for a unit of d.
    fn scaled(&self, far: R) -> Self {
        let length = self.length();
        if !length.is_positive() {
            return Self::none();
        }
        let factor = length.recip();
        let least = self.least * factor / far;
        Self { row: self.row.each(|x: R| x * factor), last: self.last * factor, least }
    }
}

/// The nearest point.
pub(super) struct Nearest<R, const C: usize> {
    /// The y, one for each of two bounds of a row, of which one alone is not zero.
    pub(super) pushes: [[R; C]; 2],
    /// Its x, without the last entry. Bounds that hardly differ have large y, whose sum has fewer digits.
    pub(super) point: [R; C],
}

/// The shortest x. It may lack a part `allowed` of the distance of the furthest bound. `None` if no x meets
/// the bounds, or if the shortest is longer than about 1/√[`rounding`] of these distances.
///
/// Two bounds of a row are those of a friction in its two directions. Where both are met exactly, so is that
/// of the reaction that limits it, so one of them is enough.
pub(super) fn nearest<R: Real, const C: usize>(
    sides: [&[Bound<R, C>; C]; 2],
    allowed: R,
) -> Option<Nearest<R, C>> {
    let zero = R::zero();
    let distance = |bound: &Bound<R, C>| {
        let length = bound.length();
        if length.is_positive() { bound.least / length } else { zero }
    };
    let far = sides.iter().flat_map(|side| side.iter()).fold(zero, |far, bound| most(far, distance(bound)));
    if !far.is_positive() {
        return Some(Nearest { pushes: [[zero; C]; 2], point: [zero; C] });
    }
    let units = sides.map(|side| side.each(|bound| bound.scaled(far)));
    // The bound of each row that enters, and its side.
    let mut own = [Bound::none(); C];
    let mut side: [Option<usize>; C] = [None; C];
    let (mut u, mut rest) = ([zero; C], Bound { least: R::one(), ..Bound::none() });
    // Each round makes the residual shorter, so none of the sets comes twice.
    for _ in 0..8 * C {
        let mut most_lacking = (allowed, None);
        for (which, units) in units.iter().enumerate() {
            for (j, (bound, _)) in units.iter().zip(&side).enumerate().filter(|(_, (_, side))| side.is_none())
            {
                let lack = bound.product(&rest);
                if above(lack, most_lacking.0) {
                    most_lacking = (lack, Some((which, j, *bound)));
                }
            }
        }
        let Some((which, j, bound)) = most_lacking.1 else {
            if !above(rest.least, rounding()) {
                return None;
            }
            // x is 1/√rest long. With its own length for a unit of d, no digits are lost.
            let unit = ((R::one() - rest.least) / rest.least).sqrt();
            let own = own.each(|bound: Bound<R, C>| Bound { least: bound.least / unit, ..bound });
            let (u, rest) = among(&own, &side.each(|side: Option<usize>| side.is_some()))?;
            let factor = far * unit / rest.least;
            let found = |which: usize, bounds: &[Bound<R, C>; C]| {
                array(|j| if side[j] == Some(which) { factor * u[j] / bounds[j].length() } else { zero })
            };
            let [first, second] = sides;
            let point = rest.row.each(|x: R| -x * factor);
            return Some(Nearest { pushes: [found(0, first), found(1, second)], point });
        };
        put(&mut own, j, bound);
        put(&mut side, j, Some(which));
        // Goes back to where the first of them is zero, as long as one would be negative.
        loop {
            let enters = side.each(|side: Option<usize>| side.is_some());
            let next;
            (next, rest) = among(&own, &enters)?;
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
            put(&mut side, leaves, None);
            put(&mut u, leaves, zero);
        }
    }
    None
}

/// The u of the bounds that enter with the least |Σ uⱼ (pⱼ, dⱼ) − (0, 1)|, and what is left of (0, 1); `None`
/// where these bounds depend on each other. By Gram and Schmidt's method, each step twice.
fn among<R: Real, const C: usize>(
    bounds: &[Bound<R, C>; C],
    enters: &[bool; C],
) -> Option<([R; C], Bound<R, C>)> {
    let zero = R::zero();
    // Directions across those before, and the parts of a bound, and of (0, 1), along them.
    let mut across = [Bound::none(); C];
    let (mut triangle, mut parts) = ([[zero; C]; C], [zero; C]);
    let mut rest = Bound { least: R::one(), ..Bound::none() };
    let entering = bounds.iter().zip(enters).enumerate().filter(|(_, (_, enters))| **enters);
    for (j, (bound, _)) in entering {
        let (mut own, mut row) = (*bound, [zero; C]);
        for _ in 0..2 {
            for (direction, own_part) in across.iter().zip(&mut row) {
                let part = direction.product(&own);
                own = own.plus(-part, direction);
                *own_part += part;
            }
        }
        let length = own.product(&own).sqrt();
        if !above(length, R::epsilon()) {
            return None;
        }
        put(&mut row, j, length);
        let direction = Bound::none().plus(length.recip(), &own);
        let mut along = zero;
        for _ in 0..2 {
            let part = direction.product(&rest);
            rest = rest.plus(-part, &direction);
            along += part;
        }
        put(&mut triangle, j, row);
        put(&mut across, j, direction);
        put(&mut parts, j, along);
    }
    // From the last one back: what is known of a bound is taken from those before it.
    let mut u = [zero; C];
    let entering = triangle.iter().zip(enters).enumerate().filter(|(_, (_, enters))| **enters);
    for (j, (row, _)) in entering.rev() {
        let known = entry(&parts, j) / entry(row, j);
        put(&mut u, j, known);
        for (i, (part, &along)) in parts.iter_mut().zip(row).enumerate() {
            if i < j {
                *part -= known * along;
            }
        }
    }
    Some((u, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounds_of<const C: usize>(rows: [[f64; C]; C], least: [f64; C]) -> [Bound<f64, C>; C] {
        array(|j| Bound { row: rows[j], last: 0.0, least: least[j] })
    }

    #[track_caller]
    fn close<const C: usize>(rows: [[f64; C]; C], bounds: [f64; C], x: [f64; C]) {
        let Nearest { pushes: [y, none], point } =
            nearest([&bounds_of(rows, bounds), &[Bound::none(); C]], rounding()).unwrap();
        assert!(none == [0.0; C] && y.iter().all(|&y| y >= 0.0), "{y:?}");
        for (i, &wanted) in x.iter().enumerate() {
            let found: f64 = (0..C).map(|j| y[j] * rows[j][i]).sum();
            for found in [found, point[i]] {
                assert!((found - wanted).abs() < 1e-12 * (1.0 + wanted.abs()), "{found} instead of {wanted}");
            }
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
        let own = bounds_of([[1.0, 0.0], [-1.0, 0.0]], [1.0, 1.0]);
        assert!(nearest([&own, &[Bound::none(); 2]], rounding()).is_none());
    }

    #[test]
    fn a_friction_is_bounded_on_both_sides() {
        // |x₁| ≤ x₀, with a force of each sign.
        for force in [2.0, -2.0] {
            let own = bounds_of([[1.0, -1.0, 0.0], [0.0, 1.0, 1.0], [0.0, -1.0, -1.0]], [0.0, force, -force]);
            let back = bounds_of([[1.0, 1.0, 0.0], [0.0; 3], [0.0; 3]], [0.0; 3]);
            let x = nearest([&own, &back], rounding()).unwrap().point;
            let wanted = [2.0 / 3.0, force / 3.0, 2.0 * force / 3.0];
            assert!(x.iter().zip(wanted).all(|(x, wanted)| (x - wanted).abs() < 1e-14), "{x:?}");
        }
    }

    #[test]
    fn bounds_that_almost_contradict_have_a_point() {
        // x₀ ≥ 1, x₁ ≥ 1 and x₀ + x₁ ≤ 2 + distance, and the same turned by an angle.
        for distance in [1e-6, 1e-9, 1e-12, 1e-14, -1e-12] {
            let (s, c) = 0.3_f64.sin_cos();
            let turned = |[x, y]: [f64; 2]| [c * x - s * y, s * x + c * y, 0.0];
            let rows = [turned([1.0, 0.0]), turned([0.0, 1.0]), turned([-1.0, -1.0])];
            let own = bounds_of(rows, [1.0, 1.0, -2.0 - distance]);
            let found = nearest([&own, &[Bound::none(); 3]], rounding());
            assert_eq!(found.is_some(), distance > 0.0, "{distance}");
        }
    }
}
