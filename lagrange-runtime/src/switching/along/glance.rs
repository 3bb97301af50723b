//! A first look at guards: most keep away from zero on the whole of a step.

use super::super::course::Course;
use super::super::guards::{Guard, Guards, Parts};
use super::super::scene::entry;
use super::super::{Along, Row, Switching};
use super::Ends;
use crate::motion::roots::{rises, stays_above};
use crate::number::real::{Ordered, Real, smaller};
use crate::series::taylor::Taylor;

/// The degree to which a first look takes polynomials: the cost of Bernstein's coefficients grows with the
/// square of the degree.
const DEGREE: usize = 8;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Guards<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// Whether a guard starts further above zero than the sum of its terms can take it down on the step.
    pub(super) fn is_far(
        &self,
        guard: Guard,
        course: &Course<'_, S::Scalar, N>,
        ends: &Ends<S::Scalar, C, W>,
    ) -> bool {
        let Parts { functions, backward } = &ends.start;
        let is_followed = |along: Along, start: S::Scalar, sign: S::Scalar| {
            let Along::Series(index) = along else { return false };
            let Some(gain) = course.gain_of_function(index, S::FOLLOWED) else { return false };
            let (start, end) = (start.part(0), ends.end.get(guard).part(0));
            let lacks = ((start + gain.whole) * sign - end).abs();
            let size = start.abs() + gain.most;
            start * sign > gain.most && end.is_positive() && lacks <= course.allowed() * size
        };
        let row = match guard {
            Guard::Kink(kink) => {
                return is_followed(S::ALONG.kinks[kink], functions.kinks[kink], self.regime.kinks[kink]);
            }
            Guard::Row(row) => row,
        };
        let reaction = |row: usize| {
            let (start, gain) = course.gain_of_reaction(row, C)?;
            let is_known = gain.last <= course.left.sqrt() * (start.abs() + gain.most);
            is_known.then_some((start * entry(&self.regime.side, row).part(0), gain.most))
        };
        let function = |sign| is_followed(S::ALONG.rows[row], functions.rows[row], sign);
        let Some(&kind) = S::ROWS.get(row) else { return false };
        let is_active = self.regime.active[row];
        match kind {
            Row::Unilateral if !is_active => function(num_traits::One::one()),
            Row::Bilateral | Row::Load | Row::Unilateral => {
                reaction(row).is_some_and(|(start, most)| start > most)
            }
            Row::Friction { normal, pair: None } if is_active => {
                let is_constant = [S::ALONG.fixed[row], S::BACKWARD[row]] == [Along::Constant; 2];
                let coefficient = smaller(functions.fixed[row], backward[row]).part(0);
                let least = match normal.map(reaction) {
                    None => Some(coefficient),
                    Some(load) => load.map(|(start, most)| coefficient * (start - most)),
                };
                let force = reaction(row).map(|(start, most)| start.abs() + most);
                is_constant && least.zip(force).is_some_and(|(least, force)| least > force)
            }
            Row::Friction { pair: None, .. } => function(self.regime.slip[row]),
            Row::Friction { pair: Some(_), .. } => false,
        }
    }

    /// The error of the motion in a guard by which a motion with derivatives may miss it. Where it touches a
    /// gap, a friction or a kink there may be none. Zero without derivatives, and for other guards.
    pub(super) fn unknown(
        &self,
        guard: Guard,
        curve: &Taylor<S::Scalar>,
        course: &Course<'_, S::Scalar, N>,
    ) -> S::Scalar {
        let may_touch = || match guard {
            Guard::Row(row) => self.is_gap(guard) || matches!(S::ROWS.get(row), Some(Row::Friction { .. })),
            Guard::Kink(_) => true,
        };
        let is_asked = S::Scalar::PARTS > 1 && may_touch();
        if is_asked { course.left * curve.extent() } else { num_traits::Zero::zero() }
    }

    /// Whether a guard stays above zero after the start of the step, or at zero, as far as its polynomial and
    /// its end show that without parts of the step.
    pub(super) fn keeps_away(
        &self,
        guard: Guard,
        course: &Course<'_, S::Scalar, N>,
        ends: &Ends<S::Scalar, C, W>,
        fired: Option<Guard>,
    ) -> bool {
        self.directions_of(guard).all(|direction| {
            let Some(curve) = self.curve(guard, direction, course, &ends.start) else { return false };
            // Others may bear what this one does not: then its own guard tells nothing.
            if curve.start() < num_traits::Zero::zero() && self.may_share(guard) {
                return false;
            }
            let converges = if self.is_of_reactions(guard) {
                course.last_of_reactions(&curve) <= course.left.sqrt() * curve.extent()
            } else {
                (curve.end() - ends.end.get(guard).part(0)).abs() <= course.allowed() * curve.extent()
            };
            let (before, mut short) = (self.before(guard, &curve, fired), curve.shortened(DEGREE));
            if self.is_of_reactions(guard) {
                short.error += course.last_of_reactions(&curve);
            }
            // A switching function that is zero without roundings is that of something at rest.
            let rests = matches!(guard, Guard::Kink(_)) && curve.extent() == num_traits::Zero::zero();
            short.error += self.unknown(guard, &short, course);
            converges && (rests || stays_above(&short) || rises(&short, before))
        })
    }
}
