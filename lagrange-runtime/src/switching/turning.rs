//! Directions of slips in two directions.
//!
//! Friction points against the slip, and the slip follows from friction: x = F(x / |x|) with the slip x
//! after an impact. That is a monotone equation, but plain iteration overshoots where friction is
//! strong and the slip is slow. [`Turning`] takes steps of the length that the last change suggests (J.
//! Barzilai, J. M. Borwein, "Two-point step size gradient methods", IMA J. Numer. Anal. 8, 1988): secants
//! along one direction, at the cost of one F each.
//!
//! [`newton`] is Newton's method with derivatives by differences. It finds what these steps do not find in
//! time, and gives impulses all their digits.

use super::Row;
use super::scene::{above, entry, most, put};
use crate::linear::Lu;
use crate::number::elements::{Each, array};
use crate::number::real::Real;

/// The most steps of a search.
pub(super) const TURNS: usize = 300;

/// A search for the slips of some rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turning<R, const C: usize> {
    /// The first share, and the largest one.
    shares: [R; 2],
    last: Option<([R; C], [R; C])>,
}

impl<R: Real, const C: usize> Turning<R, C> {
    /// A search with this first share, and the largest one.
    pub(super) fn new(shares: [f64; 2]) -> Self {
        Self { shares: shares.each(R::from_f64), last: None }
    }

    /// The share of their lacks F − x by which the `x` are to change.
    pub(super) fn share(&mut self, x: &[R; C], lack: &[R; C]) -> R {
        let [mut share, largest] = self.shares;
        if let Some((before, lacked)) = self.last {
            let (mut along, mut square) = (R::zero(), R::zero());
            // Derivatives are iterated as the values are, by the same operator.
            for (row, part) in (0..C).flat_map(|row| (0..R::PARTS).map(move |part| (row, part))) {
                let change = (lack[row] - lacked[row]).part(part);
                along += (x[row] - before[row]).part(part) * change;
                square += change * change;
            }
            if square.is_positive() && along != R::zero() {
                share = along.abs() / square;
            }
            share = if above(share, largest) { largest } else { most(share, R::from_f64(1e-4)) };
        }
        self.last = Some((*x, *lack));
        share
    }
}

/// The least share of a step of Newton's method that is tried.
const LEAST_SHARE: f64 = 1.0 / 1024.0;

/// Newton's method for x = F(x), with derivatives by differences. `image` gives F and whether x is as close
/// to it as can be. `units` are those of the components of x; F is not varied by a component whose unit is
/// zero. `None` where no step leads nearer, since slips that come to rest have no direction, where F or a
/// step has no value, and where [`TURNS`] steps do not end.
#[cold]
pub(super) fn newton<R: Real, const N: usize>(
    start: [R; N],
    units: &[R; N],
    image: impl Fn(&[R; N]) -> Option<([R; N], bool)>,
) -> Option<[R; N]> {
    let one = R::one();
    let extent = |x: &[R; N]| {
        let parts = x.iter().zip(units).filter(|(_, unit)| unit.is_positive());
        parts.fold(R::zero(), |largest, (&x, &unit)| most(largest, (x / unit).abs().part(0)))
    };
    let apart = |x: &[R; N], y: &[R; N]| -> [R; N] { array(|i| y[i] - x[i]) };
    let (mut x, (mut reached, mut is_done)) = (start, image(&start)?);
    // One more step gives values all their digits. Derivatives follow one step behind: differences give the
    // matrix to half of all digits, so each step gives derivatives that many more.
    let mut more = if R::PARTS > 1 { 2 } else { 1 };
    for _ in 0..TURNS {
        if is_done {
            if more == 0 {
                return Some(x);
            }
            more -= 1;
        }
        let change = R::epsilon().sqrt() * most(extent(&x), extent(&reached));
        let mut matrix = [[R::zero(); N]; N];
        for (j, &unit) in units.iter().enumerate() {
            let (mut beside, own) = (x, change * unit);
            if let Some(row) = matrix.get_mut(j) {
                put(row, j, one);
            }
            if own.is_positive() {
                put(&mut beside, j, entry(&x, j) + own);
                let (moved, _) = image(&beside)?;
                for (row, (&moved, &reached)) in matrix.iter_mut().zip(moved.iter().zip(&reached)) {
                    let by_difference = ((moved - reached) / own).part(0);
                    put(row, j, entry(row, j) - by_difference);
                }
            }
        }
        let lack = apart(&x, &reached);
        let step = Lu::factor(matrix).ok()?.solve(lack);
        let mut share = one;
        loop {
            let next: [R; N] = array(|i| x[i] + share * step[i]);
            if let Some((after, ends)) = image(&next)
                && (is_done || ends || above(extent(&lack), extent(&apart(&next, &after))))
            {
                (x, reached, is_done) = (next, after, ends || is_done);
                break;
            }
            share *= R::from_f64(0.5);
            if above(R::from_f64(LEAST_SHARE), share) {
                return None;
            }
        }
    }
    None
}

/// Whether any friction acts in two directions: a system without has no code for what follows from them.
pub(super) const fn has_pairs<const C: usize>(rows: &[Row; C]) -> bool {
    let mut row = 0;
    while row < C {
        if matches!(rows[row], Row::Friction { pair: Some(_), .. }) {
            return true;
        }
        row += 1;
    }
    false
}

/// The rows of each slip in two directions.
pub(super) fn pairs<const C: usize>(rows: &[Row; C]) -> impl Iterator<Item = [usize; 2]> + '_ {
    rows.iter().enumerate().filter_map(|(row, kind)| match kind {
        Row::Friction { pair: Some(other), .. } if row < *other && *other < C => Some([row, *other]),
        _ => None,
    })
}
