//! Whether a load can be shared at all, and how far that is from its end.
//!
//! The margin of shares is the largest m with which every limit is kept by m times its unit: m = max over the
//! shares of min over the rows of slackⱼ / wⱼ. It is concave in the shares, changes sign where the last
//! possible shares are gone, and always exists, so the sign is known to rounding there. The question
//! whether *some* shares keep all limits is known there to the square root of that alone.
//!
//! The proximal bundle method finds it: cones of friction are cut by planes, the next point is that nearest
//! to the centre and a reach more of margin, and all cuts of a cone that were active are kept as their mean
//! (Kiwiel, *Methods of Descent for Nondifferentiable Optimization*, chapter 2).

use super::nearest::{Bound, Nearest, nearest};
use super::scene::{Scene, Sticking, above, entry, most, product, rounding};
use super::shares::Cut;
use super::turning::TURNS;
use super::{Regime, Row, Switching};
use crate::number::elements::array;
use crate::number::real::Real;

/// The part of the predicted gain of margin that makes a point the next centre.
const GAIN: f64 = 0.1;

/// The factor by which the gain of margin that is sought becomes larger or smaller.
const REACH: f64 = 4.0;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// Whether reactions are possible that give the same motion as the `known` ones. Limits of rows whose
    /// reactions the motion determines as a whole are not asked for.
    #[cold]
    pub(super) fn can_share(
        &self,
        bearing: &Regime<S::Scalar, C, W>,
        drags: &[S::Scalar; C],
        known: &[S::Scalar; C],
    ) -> bool {
        // Loads are sizes of forces, so the possible reactions are no convex set.
        if S::ROWS.contains(&Row::Load) {
            return false;
        }
        let number = S::Scalar::from_f64;
        let (zero, one): (S::Scalar, S::Scalar) = (num_traits::Zero::zero(), num_traits::One::one());
        let spread = self.spread(bearing, drags);
        let base = spread.shortest(known);
        let free = |cut: &Cut<S::Scalar, C>| {
            let held = spread.shortest(&cut.normal);
            array(|i| cut.normal[i] - held[i])
        };
        // A friction without a force has no direction: it is cut when it has one.
        let mut units = [zero; C];
        let mut unit_of = |row: usize, cut: &Cut<S::Scalar, C>| {
            if let Some(unit) = units.get_mut(row).filter(|unit| !unit.is_positive()) {
                let own: [S::Scalar; C] = free(cut);
                let length = product(&own, &own).sqrt();
                let is_free =
                    above(length, S::Scalar::epsilon().sqrt() * product(&cut.normal, &cut.normal).sqrt());
                *unit = if is_free { length } else { zero };
            }
            entry(&units, row)
        };
        // Whether shares change the force of a friction, in any direction, or its limit.
        let is_partly_free = |row: usize| {
            let Some(&Row::Friction { normal, pair }) = S::ROWS.get(row) else { return false };
            [Some(row), pair, normal].into_iter().flatten().any(|own| {
                let unit = array(|row| if row == own { one } else { zero });
                let free: [S::Scalar; C] = free(&Cut { normal: unit, bound: zero });
                above(product(&free, &free).sqrt(), S::Scalar::epsilon().sqrt())
            })
        };
        let mut size = product(&base, &base).sqrt();
        let mut cuts: [Option<Cut<S::Scalar, C>>; C] = [None; C];
        let mut centre = base;
        let mut margin: Option<S::Scalar> = None;
        let mut point = base;
        let mut predicted = zero;
        let mut reach = size;
        let furthest = rounding::<S::Scalar>().sqrt().recip();
        for _ in 0..TURNS {
            // Tangents at the point, and the margin there.
            let mut least: Option<S::Scalar> = None;
            for row in 0..C {
                let Some(cut) = self.cut(row, bearing, &point, Sticking::ByForces) else { continue };
                let unit = unit_of(row, &cut);
                if !unit.is_positive() {
                    // No shares change the distance from this plane. A friction may have others in other
                    // directions, so its own guard is not watched.
                    let slack = product(&cut.normal, &point) - cut.bound;
                    if above(zero, slack) && is_partly_free(row) {
                        return false;
                    }
                    continue;
                }
                size = most(size, cut.bound.abs() / unit);
                let cut = Cut { normal: array(|i| cut.normal[i] / unit), bound: cut.bound / unit };
                let slack = product(&cut.normal, &point) - cut.bound;
                least = Some(least.map_or(slack, |least| if above(least, slack) { slack } else { least }));
                if let Some(own) = cuts.get_mut(row) {
                    *own = Some(cut);
                }
            }
            let Some(least) = least.filter(|&least| above(zero, least)) else { return true };
            if margin.is_none_or(|margin| above(least, margin + number(GAIN) * predicted)) {
                (margin, centre) = (Some(least), point);
            }
            let margin = margin.unwrap_or(least);
            if !reach.is_positive() {
                reach = size;
            }
            // The nearest point, with the margin that it lacks to the reach for a last entry.
            let limits = array(|j| {
                cuts[j].as_ref().map_or(Bound::none(), |cut| {
                    let least = margin + reach - (product(&cut.normal, &centre) - cut.bound);
                    Bound { row: free(cut), last: one, least }
                })
            });
            let found = nearest([&limits, &[Bound::none(); C]], rounding());
            let Some(Nearest { pushes: [pushes, _], point: step }) = found else { return false };
            let rest = pushes.iter().fold(zero, |sum, &push| sum + push);
            predicted = reach - rest;
            point = array(|i| centre[i] + step[i]);
            // The mean of the active cuts bounds the margin by that of the centre, its error there, and its
            // slope times the distance. Shares so far away that their rounding errors change the motion are
            // none.
            let slope = product(&step, &step).sqrt() / rest;
            let error = predicted - slope * slope * rest;
            let gain = most(error, zero) + slope * furthest * size;
            if above(-margin, gain) || !above(gain, S::Scalar::epsilon() * size) {
                return false;
            }
            // A longer reach lowers the slope, a shorter one the error, and those of the nearest point.
            let factor = number(REACH);
            reach = if above(slope * size, error) { reach * factor } else { reach / factor };
            reach = if above(reach, size) { size } else { reach };
            // All cuts of a cone that were active go on as their mean, in the place of its second row.
            for (row, kind) in S::ROWS.iter().enumerate() {
                let Row::Friction { pair: Some(other), .. } = *kind else { continue };
                if other < row {
                    continue;
                }
                let [own, kept] = [row, other].map(|row| entry(&pushes, row));
                let sum = own + kept;
                if !sum.is_positive() {
                    continue;
                }
                if let (Some(first), Some(second)) = (cuts.get(row).copied().flatten(), cuts.get_mut(other)) {
                    let [mine, its] = [own / sum, kept / sum];
                    let old = second.unwrap_or(first);
                    let normal = array(|i| mine * first.normal[i] + its * old.normal[i]);
                    *second = Some(Cut { normal, bound: mine * first.bound + its * old.bound });
                }
            }
        }
        false
    }
}
