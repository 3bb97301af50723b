//! Guards along the polynomial of a step: polynomials themselves.
//!
//! The series of a motion contains those of reactions, gaps, slips and switching functions, from the same
//! pass over its orders. The coefficients of most guards show that they keep away from zero (`glance`). Other
//! guards are examined on parts of the step, each with its own rounding errors.
//!
//! The truncation error of a guard's series is its difference from the guard itself at the end of the step.
//! If that is larger than the truncation error of the motion, the step ends where the series still converges.
//! A guard without a series is sampled.

mod curve;
mod glance;
mod relieved;
mod shared;
mod zero;

use super::course::Course;
use super::guards::{Guard, Guards, Parts, is_clear};
use super::place::How;
use super::reactions::Borne;
use super::{Along, Functions, Row, Switching};
use crate::motion::roots::{Before, Fall, clear, falls, reach, starts_above, stays_above, touches};
use crate::number::elements::Each;
use crate::number::real::{Ordered, Real, larger, smaller};
use crate::number::rounded::Rounded;
use crate::series::taylor::Taylor;
use crate::system::error::Cause;
use crate::system::state::State;

/// The most halvings of a part of the step for the sake of rounding errors. A guard that starts near zero and
/// changes slowly has small ones where it starts.
const CLEAREST: i32 = 20;

/// A step on which a guard's series does not converge is shortened by factors between these.
const NEARER: f64 = 0.9;
const FURTHER: f64 = 1.0 / 16.0;

/// The most halvings of a step on which a guard's series does not converge.
const HALVINGS: i32 = 40;

/// The part of a guard by which its series may miss it on a step of a length that the caller chose. The error
/// of such a step is that of its order. The series tells where the guard falls, and the guard itself where it
/// is zero.
const FOLLOWED: f64 = 1.0 / 16.0;

/// The length of a part of a step that is too short to matter, as a multiple of the shortest part on which
/// convergence is looked for.
const BEYOND: f64 = 64.0;

/// The result of examining a step.
pub(super) struct Found<R> {
    /// The first guard that falls through zero, and where; `None` if none does.
    pub(super) first: Option<(Fall<R>, Guard)>,
    /// How it does.
    pub(super) how: How,
    /// The part of the step on which the guards are known.
    pub(super) until: R,
}

/// A guard at the end of a part of the step.
#[derive(Clone, Copy)]
struct End<R, const N: usize> {
    part: R,
    state: State<R, N>,
    /// The rounding errors of the state.
    errors: State<R, N>,
    value: Rounded<R>,
}

/// The part of a step on which a guard is known.
enum Known<R, const N: usize> {
    /// The end of the part on which its series converges like the motion.
    Series(End<R, N>),
    /// A part that is too short to matter: the guard has no series on it, as the distance from a centre has
    /// none there, but does not come near zero.
    Clear(R),
    /// No part: the guard has to be sampled.
    Nowhere,
}

/// Where a guard ends a piece, and how.
type Ending<R> = (Fall<R>, How);

/// A guard along a step.
struct Way<R, const N: usize> {
    guard: Guard,
    curve: Taylor<R>,
    /// The end of the part of the step that is examined.
    end: End<R, N>,
    /// The side of zero on which the guard starts.
    before: Before,
}

/// Guards at both ends of a step, without those of reactions.
struct Ends<R, const C: usize, const W: usize> {
    /// The parts of the guards at the start.
    start: Parts<R, C, W>,
    /// The guards at the end.
    end: Functions<R, C, W>,
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Guards<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The first guard that falls through zero along a step to `end`, to the rounding errors of its
    /// polynomial, as far as guards are known. The guard `fired` is zero where the step starts. Each shorter
    /// part that is tried for the sake of rounding errors is one of the `attempts`.
    pub(super) fn first_along(
        &mut self,
        course: &Course<'_, S::Scalar, N>,
        end: &State<S::Scalar, N>,
        fired: Option<Guard>,
        attempts: &mut u64,
    ) -> Result<Found<S::Scalar>, Cause> {
        let State { t, q, v } = self.start;
        let at_end = self.parts(|x| x, end.t, [&end.q, &end.v]);
        let ends = Ends {
            start: self.parts(|x| x, *t, [q, v]),
            end: self.made(|x| x, at_end, &[num_traits::Zero::zero(); C]),
        };
        for guard in Self::every() {
            // A guard below zero at the end has fallen.
            let has_fallen =
                || !self.is_of_reactions(guard) && *ends.end.get(guard) < num_traits::Zero::zero();
            if self.has(guard)
                && !has_fallen()
                && (self.is_far(guard, course, &ends) || self.keeps_away(guard, course, &ends, fired))
            {
                self.pass(guard);
            }
        }
        let relieved = self.relieved();
        if self.all().next().is_none() && relieved == [false; C] {
            return Ok(Found { first: None, how: How::Falls, until: num_traits::One::one() });
        }
        let mut found = self.closely(course, &ends, fired, attempts)?;
        let before = found.first.as_ref().map_or(found.until, |(fall, _)| fall.place);
        if let Some(first) = self.bears_again(&relieved, course, before) {
            (found.first, found.how) = (Some(first), How::Shared);
        }
        Ok(found)
    }

    /// The same for guards that may fall: on parts of the step, with the rounding errors of each.
    #[inline(never)]
    fn closely(
        &mut self,
        course: &Course<'_, S::Scalar, N>,
        ends: &Ends<S::Scalar, C, W>,
        fired: Option<Guard>,
        attempts: &mut u64,
    ) -> Result<Found<S::Scalar>, Cause> {
        let mut found = Found { first: None, how: How::Falls, until: num_traits::One::one() };
        let borne = self.borne(course);
        let sharing = self.sharing_along(course);
        for guard in Self::every() {
            if !self.has(guard) || matches!(guard, Guard::Row(row) if sharing.get(row) == Some(&true)) {
                continue;
            }
            let before = found.first.as_ref().map_or(found.until, |(fall, _)| fall.place);
            let mut whole = self.curve(guard, 0, course, &ends.start);
            let known = match &whole {
                Some(whole) if !self.is_of_reactions(guard) || borne.is_known => {
                    self.known(guard, whole, course, (&ends.start, &borne), before)
                }
                _ => Known::Nowhere,
            };
            let (until, end) = match known {
                Known::Series(end) => (end.part, Some(end)),
                Known::Clear(until) => {
                    self.pass(guard);
                    (until, None)
                }
                Known::Nowhere => {
                    self.sample(guard);
                    (before, None)
                }
            };
            if until < before {
                found = Found { first: None, how: How::Falls, until };
            }
            let Some(end) = end else { continue };
            for direction in self.directions_of(guard) {
                let curve = whole.take().or_else(|| self.curve(guard, direction, course, &ends.start));
                let Some(curve) = curve else { continue };
                let way = Way { guard, curve, end, before: self.before(guard, &curve, fired) };
                if let Some((fall, how)) = self.fall(&way, course, &borne, attempts)?
                    && found.first.as_ref().is_none_or(|(other, _)| fall.place < other.place)
                {
                    (found.first, found.how) = (Some((fall, guard)), how);
                }
            }
        }
        if let Some(guard) = sharing.iter().position(|&shares| shares).map(Guard::Row) {
            let before = found.first.as_ref().map_or(found.until, |(fall, _)| fall.place);
            let until = if borne.is_known { before } else { smaller(before, self.followed(course)) };
            if until < before {
                found = Found { first: None, how: How::Falls, until };
            }
            if let Some(fall) = self.shared(course, until, &ends.start) {
                (found.first, found.how) = (Some((fall, guard)), How::Shared);
            }
        }
        Ok(found)
    }

    /// The first fall of a guard along its way, or where it touches zero if derivatives are asked for; `None`
    /// if it does neither.
    fn fall(
        &self,
        Way { guard, curve, end: last, before }: &Way<S::Scalar, N>,
        course: &Course<'_, S::Scalar, N>,
        borne: &Borne<S::Scalar, N, C>,
        attempts: &mut u64,
    ) -> Result<Option<Ending<S::Scalar>>, Cause> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let clearest = S::Scalar::from_f64(0.5).powi(CLEAREST);
        let until = last.part;
        let (mut from, mut width, mut here) = (zero, until, *self.start);
        let (mut is_above, mut touched) = (false, None);
        loop {
            let to = from + width;
            let end = if to == until { *last } else { self.at_end(*guard, course, to, borne) };
            // With the same errors of the state, so that both differ by the guard alone.
            let own = self.at_state(*guard, course, from, [&here, &end.errors], borne).error;
            let part = Taylor { error: larger(own, end.value.error), ..curve.on(from, width) };
            let wide = Taylor { error: part.error + self.unknown(*guard, &part, course), ..part };
            if !stays_above(&wide) {
                let clear = if width > clearest { clear(&part, own) } else { num_traits::One::one() };
                if clear < num_traits::One::one() {
                    *attempts = attempts.checked_sub(1).ok_or(Cause::TooManySteps)?;
                    width *= clear;
                    continue;
                }
                let first = if from == zero { *before } else { Before::Unknown };
                is_above |= first == Before::Unknown && starts_above(&part);
                let before = if is_above && self.is_gap(*guard) { Before::Above } else { first };
                if let Some(fall) = falls(&part, before) {
                    let [place, fallen] = [fall.place, fall.fallen].each(|place| from + place * width);
                    return Ok(Some((Fall { place, fallen }, How::Falls)));
                }
                if S::Scalar::PARTS > 1 && is_above && starts_above(&wide) {
                    touched = touches(&wide).map(|place| from + place * width);
                    if touched.is_some() {
                        break;
                    }
                }
            }
            (from, here) = (to, end.state);
            // A remainder that is a rounding error is no part of a step.
            if until - from <= S::Scalar::epsilon() {
                break;
            }
            width = smaller(width + width, until - from);
        }
        // Below zero at the end it has fallen, whatever its truncated polynomial says.
        let has_fallen = !self.is_of_reactions(*guard) && last.value.value < -last.value.error;
        let touched = touched.map(|place| (place, How::Touches));
        let fallen = touched.or(has_fallen.then_some((until, How::Falls)));
        Ok(fallen.map(|(place, how)| (Fall { place, fallen: place }, how)))
    }

    /// The part of the step on which a guard is known, no longer than `until` if it has a series there.
    fn known(
        &self,
        guard: Guard,
        whole: &Taylor<S::Scalar>,
        course: &Course<'_, S::Scalar, N>,
        (start, borne): (&Parts<S::Scalar, C, W>, &Borne<S::Scalar, N, C>),
        mut until: S::Scalar,
    ) -> Known<S::Scalar, N> {
        let shortest = S::Scalar::from_f64(0.5).powi(HALVINGS);
        loop {
            let end = self.at_end(guard, course, until, borne);
            let curve = whole.on(num_traits::Zero::zero(), until);
            // A reaction has no value but that of its series, which converges as the motion does. At rest
            // there is no motion to make the step short enough for it, and the limit of a friction has a
            // series that the motion does not see.
            if self.is_of_reactions(guard) {
                let last = course.last_of_reactions(&curve);
                let allowed = course.left * curve.extent();
                let is_short = !last.is_finite() || until < shortest;
                let has_limit = is_short || self.has_limit_on(guard, start, course, &end);
                let is_bounded = course.is_paced || !course.rests() || last <= allowed;
                if is_short || has_limit && is_bounded {
                    return Known::Series(end);
                }
                let order = S::Scalar::from_f64(course.order() as f64);
                let reach =
                    if has_limit { ((allowed / last).ln() / order).exp() } else { S::Scalar::from_f64(0.5) };
                until *= S::Scalar::from_f64(NEARER) * reach;
                continue;
            }
            if self.is_followed(guard, &curve, course, &end, borne) {
                return Known::Series(end);
            }
            if until < shortest {
                let until = S::Scalar::from_f64(BEYOND) * until;
                let value = |place: S::Scalar| self.at_end(guard, course, place * until, borne).value.value;
                return if is_clear(value) { Known::Clear(until) } else { Known::Nowhere };
            }
            // A series that converges to something else, as that of the distance from a centre does behind
            // it, tells nothing about its reach.
            let [nearer, further] = [NEARER, FURTHER].each(S::Scalar::from_f64);
            let reach = reach(&curve, course.order(), course.left);
            until *= if reach < num_traits::One::one() { larger(reach * nearer, further) } else { further };
        }
    }

    /// Whether the series of a guard tells where it falls up to the end of a part of the step. Without a
    /// bound, as beside a pole, it does not.
    fn is_followed(
        &self,
        guard: Guard,
        curve: &Taylor<S::Scalar>,
        course: &Course<'_, S::Scalar, N>,
        end: &End<S::Scalar, N>,
        borne: &Borne<S::Scalar, N, C>,
    ) -> bool {
        let lacks = (curve.end() - end.value.value).abs();
        // The straight lines of order one follow no gap.
        if !course.is_paced || course.order() == 1 {
            let bound = course.allowed() * curve.extent() + end.value.error;
            return lacks <= bound && bound.is_finite();
        }
        // The terms of a series that does not converge are larger than the guard anywhere.
        let half = S::Scalar::from_f64(0.5);
        let middle = self.at_end(guard, course, half * end.part, borne).value;
        let most = larger(larger(curve.start().abs(), end.value.value.abs()), middle.value.abs());
        let bound = S::Scalar::from_f64(FOLLOWED) * smaller(curve.extent(), most);
        let lacks_inside = (curve.at(half) - middle.value).abs();
        bound.is_finite() && lacks <= bound + end.value.error && lacks_inside <= bound + middle.error
    }

    /// Whether the limit of a friction that sticks is that of its series at the end of a part of the step.
    fn has_limit_on(
        &self,
        guard: Guard,
        start: &Parts<S::Scalar, C, W>,
        course: &Course<'_, S::Scalar, N>,
        end: &End<S::Scalar, N>,
    ) -> bool {
        let Guard::Row(row) = guard else { return true };
        let sides = [S::ALONG.fixed[row], S::BACKWARD[row]];
        if !matches!(S::ROWS[row], Row::Friction { .. }) || sides == [Along::Constant; 2] {
            return true;
        }
        let there = self.only(guard).parts(|x| x, end.state.t, [&end.state.q, &end.state.v]);
        let values = |parts: &Parts<S::Scalar, C, W>| [parts.functions.fixed[row], parts.backward[row]];
        let mut known = sides.into_iter().zip(values(start).into_iter().zip(values(&there)));
        known.all(|(along, (start, there))| {
            let Along::Series(index) = along else { return true };
            let gain = course.gain_of_function_at(index, S::FOLLOWED, end.part);
            (start + gain - there).abs() <= course.allowed() * (start.abs() + gain.abs() + there.abs())
        })
    }

    /// A guard at the end of a part of the step.
    fn at_end(
        &self,
        guard: Guard,
        course: &Course<'_, S::Scalar, N>,
        part: S::Scalar,
        borne: &Borne<S::Scalar, N, C>,
    ) -> End<S::Scalar, N> {
        let half = S::Scalar::from_f64(0.5);
        let [state, mut errors] = course.at(self.start, part);
        let passed = part * course.time();
        errors.t *= S::Scalar::epsilon();
        for (i, &rounding) in borne.roundings.iter().enumerate() {
            errors.q[i] = S::Scalar::epsilon() * errors.q[i] + half * passed * part * rounding;
            errors.v[i] = S::Scalar::epsilon() * errors.v[i] + part * rounding;
        }
        let value = self.at_state(guard, course, part, [&state, &errors], borne);
        End { part, state, errors, value }
    }

    /// A guard at a state after a part of the step, with these errors of the state.
    fn at_state(
        &self,
        guard: Guard,
        course: &Course<'_, S::Scalar, N>,
        part: S::Scalar,
        [state, errors]: [&State<S::Scalar, N>; 2],
        borne: &Borne<S::Scalar, N, C>,
    ) -> Rounded<S::Scalar> {
        let own = self.only(guard);
        let mut reactions = [Rounded::exact(num_traits::Zero::zero()); C];
        if own.has_reactions() {
            for (row, reaction) in reactions.iter_mut().enumerate() {
                *reaction =
                    Rounded { value: course.reaction_at(row, C, part), error: borne.error(row, part) };
            }
        }
        let Rounded { value, error } = *own.rounded(state, errors, &reactions).get(guard);
        Rounded { value: value.part(0), error: error.part(0) }
    }
}
