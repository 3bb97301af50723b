//! Directions of slips in two directions.
//!
//! Friction points against the slip, and the slip follows from friction: x = F(x / |x|) with the slip x, or
//! its rate where it begins. That is a monotone equation, but plain iteration overshoots where friction is
//! strong and the slip is slow. Steps of the length that the last change suggests (J. Barzilai, J. M.
//! Borwein, "Two-point step size gradient methods", IMA J. Numer. Anal. 8, 1988) are secants along one
//! direction.

use super::Row;
use super::scene::{above, most};
use crate::number::real::Real;

/// The most steps of a search.
pub(super) const TURNS: usize = 300;

/// A search for the slips of some rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turning<R, const C: usize> {
    last: Option<([R; C], [R; C])>,
}

impl<R: Real, const C: usize> Turning<R, C> {
    pub(super) const fn new() -> Self {
        Self { last: None }
    }

    /// The share of their lacks by which some slips are to change.
    pub(super) fn share(&mut self, x: &[R; C], lack: &[R; C]) -> R {
        let mut share = R::from_f64(0.25);
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
            let (least, whole) = (R::from_f64(1e-4), R::one());
            share = if above(share, whole) { whole } else { most(share, least) };
        }
        self.last = Some((*x, *lack));
        share
    }
}

/// The rows of each slip in two directions.
pub(super) fn pairs<const C: usize>(rows: &[Row; C]) -> impl Iterator<Item = [usize; 2]> + '_ {
    rows.iter().enumerate().filter_map(|(row, kind)| match kind {
        Row::Friction { pair: Some(other), .. } if row < *other && *other < C => Some([row, *other]),
        _ => None,
    })
}
