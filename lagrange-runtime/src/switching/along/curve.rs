//! The polynomial of a guard along a step, made of those of functions and reactions.

use super::super::course::Course;
use super::super::guards::{Guard, Guards, Parts};
use super::super::scene::entry;
use super::super::{Along, Row, Switching};
use crate::motion::roots::Before;
use crate::number::real::{Ordered, Real};
use crate::series::taylor::Taylor;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Guards<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The polynomial of a guard in one of the directions in which it may be exceeded; `None` for a guard
    /// without one.
    pub(super) fn curve(
        &self,
        guard: Guard,
        direction: usize,
        course: &Course<'_, S::Scalar, N>,
        start: &Parts<S::Scalar, C, W>,
    ) -> Option<Taylor<S::Scalar>> {
        let Parts { functions, backward } = start;
        let along = |along: Along, start: S::Scalar| course.curve_of_function(along, S::FOLLOWED, start);
        let row = match guard {
            Guard::Kink(kink) => {
                let curve = along(S::ALONG.kinks[kink], functions.kinks[kink])?;
                return Some(curve.scaled(self.regime.kinks[kink]));
            }
            Guard::Row(row) => row,
        };
        let function = |row: usize| along(*S::ALONG.rows.get(row)?, *functions.rows.get(row)?);
        let reaction =
            |row: usize| Some(course.curve_of_reaction(row, C)?.scaled(entry(&self.regime.side, row)));
        let kind = *S::ROWS.get(row)?;
        let is_active = self.regime.active[row];
        match kind {
            Row::Bilateral | Row::Load => reaction(row),
            Row::Unilateral if is_active => reaction(row),
            Row::Unilateral => {
                let gap = function(row)?;
                Some(if self.has_begun(guard) { without_return(gap, 2) } else { gap })
            }
            Row::Friction { normal, pair } if is_active => {
                let (known, fixed) = match direction {
                    0 => (S::ALONG.fixed[row], functions.fixed[row]),
                    _ => (S::BACKWARD[row], backward[row]),
                };
                let coefficient = along(known, fixed)?;
                let limit = match normal {
                    Some(normal) => reaction(normal)?.times(&coefficient, course.order()),
                    None => coefficient,
                };
                let force = reaction(row)?;
                let Some(other) = pair else {
                    let sign: S::Scalar = num_traits::One::one();
                    return Some(limit.plus(if direction == 0 { sign } else { -sign }, &force));
                };
                let square = |curve: &Taylor<S::Scalar>| curve.times(curve, course.order());
                let minus: S::Scalar = -<S::Scalar as num_traits::One>::one();
                let left = square(&limit).plus(minus, &square(&force));
                Some(left.plus(minus, &square(&reaction(other)?)))
            }
            Row::Friction { pair: None, .. } => {
                let slip = function(row)?.scaled(self.regime.slip[row]);
                Some(if self.has_begun(guard) { without_return(slip, 1) } else { slip })
            }
            Row::Friction { pair: Some(other), .. } => {
                let directions = self.directions();
                let one = function(row)?.scaled(directions[row].part(0));
                Some(one.plus(entry(directions, other).part(0), &function(other)?))
            }
        }
    }

    /// The directions in which a guard may be exceeded. A friction along one direction sticks as long as its
    /// force exceeds the limit neither forward nor backward.
    pub(super) fn directions_of(&self, guard: Guard) -> core::ops::Range<usize> {
        match guard {
            Guard::Row(row)
                if self.regime.active[row] && matches!(S::ROWS[row], Row::Friction { pair: None, .. }) =>
            {
                0..2
            }
            _ => 0..1,
        }
    }

    /// The side of zero on which a guard starts, whatever its polynomial says. The guard that has fired is
    /// zero, and so is that of a kink that has just been crossed. A gap or a guard of reactions that starts
    /// below zero counts as zero, too: it has been decided that these are not below zero.
    pub(super) fn before(&self, guard: Guard, curve: &Taylor<S::Scalar>, fired: Option<Guard>) -> Before {
        let is_held = matches!(guard, Guard::Row(row)
            if S::ROWS[row] == Row::Unilateral || self.is_reaction(row));
        let begins = fired == Some(guard)
            || self.has_crossed(guard)
            || is_held && curve.start() < num_traits::Zero::zero();
        if begins { Before::Zero } else { Before::Unknown }
    }
}

/// A gap or slip that has just begun, whose power `order` does not lead it back.
///
/// Neither accelerates back, or another regime would have been chosen. Where a reaction has just vanished or
/// friction has just reached its limit, the acceleration is a rounding error of the forces that it is a
/// difference of.
fn without_return<T: Real + Ordered>(mut curve: Taylor<T>, order: usize) -> Taylor<T> {
    if let Some(first) = curve.coefficients.get_mut(order).filter(|first| **first < T::zero()) {
        *first = T::zero();
    }
    curve
}
