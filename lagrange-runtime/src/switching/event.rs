//! The search for the place where a piece of the motion ends before its step.

use super::course::Course;
use super::guards::{Guard, Guards};
use super::place::{Event, How};
use super::rest::RESOLVED;
use super::run::Run;
use super::{Row, Switching};
use crate::motion::roots::Fall;
use crate::number::elements::array;
use crate::number::real::{Ordered, Real, larger};
use crate::system::System;
use crate::system::control::Held;
use crate::system::error::Cause;
use crate::system::method::Adaptive;
use crate::system::state::State;

/// The part of a piece at which its guard is compared with the end, for its slope.
const EARLIER: f64 = 1.0 - 1e-3;

/// How many times half of the step is tried where guards have no values on all of it.
const HALVINGS: usize = 8;

impl<S, M, const N: usize, const K: usize, const C: usize, const W: usize> Run<'_, S, M, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    /// The first event of the piece: a guard falls through zero, or guards are known no further. `None` if
    /// they are known on the whole piece and none falls.
    pub(super) fn event(&mut self, attempts: &mut u64) -> Result<Option<Event<S::Scalar, N, W>>, Cause> {
        let memory = &mut *self.memory;
        let (start, end) = (memory.start, memory.end);
        let (in_regime, constants) = (&memory.in_regime, &memory.constants);
        let inputs = &self.control.0;
        let mut guards = Guards::new(
            self.system,
            in_regime,
            &memory.regime,
            inputs,
            &start,
            M::terms(&memory.inner).is_some(),
        );
        if guards.is_empty() {
            return Ok(None);
        }
        guards.cross(&memory.flips);
        guards.begins(&memory.begins);
        let (zero, one) = (num_traits::Zero::zero(), num_traits::One::one());
        let (control, limits) = (self.control, self.limits);
        let narrow = guards.fallen_inside::<M>(&mut memory.inner, constants, control, limits);
        let (mut fall, mut known, mut how) = (None, one, How::Falls);
        if let Some(terms) = M::terms(&memory.inner) {
            let course = Course::new(terms, limits.relative, S::FOLLOWED, M::IS_PACED);
            let found = guards.first_along(&course, &end, memory.fired, attempts)?;
            let has_none = narrow.is_none() && found.first.is_none() && found.until == one;
            if has_none && guards.all().next().is_none() {
                return Ok(None);
            }
            (known, how) = (found.until, found.how);
            fall = found.first.map(|found| {
                let sizes = terms.sizes(&start, found.0.place);
                (found, sizes, terms.length * terms.unit, terms.residue)
            });
        }
        let inner = &mut memory.inner;
        let mut at = |part: S::Scalar| {
            if part == zero {
                return Some(start);
            }
            M::within(inner, in_regime, constants, control, limits, part).ok()
        };
        let mut first = None;
        if let Some(((Fall { place, fallen }, guard), sizes, ..)) = &fall {
            let parts = [*place, larger(*fallen, known)];
            let zero = match how {
                How::Falls => guards.at_zero(*guard, parts, sizes, &mut at),
                How::Shared | How::Touches => Some(*place),
            };
            // Half the step has hardly a truncation error, if rounding of time leaves room for it. A series
            // of fixed order has its error anyway. Another one from there is a step of Newton's method.
            let nearer = if M::IS_PACED { *place } else { S::Scalar::from_f64(0.5) * *place };
            first = if zero.is_none() && start.t + nearer * (end.t - start.t) != start.t {
                known = nearer;
                None
            } else {
                Some((zero.unwrap_or(*place), *guard))
            };
        }
        // The time from the start to this part of the step, without the rounding of times.
        let mut passed = first.zip(fall).map(|((part, _), (.., length, residue))| part * length + residue);
        let mut until = first.map_or(known, |(part, _)| part);
        let mut tries = HALVINGS;
        let sampled = loop {
            // What a regime needs may end within the step. The next piece begins nearer to that.
            match guards.first(&memory.scales, [start.t, end.t], until, attempts, &mut at) {
                Err(Cause::NotFinite) if tries > 0 => {
                    until *= S::Scalar::from_f64(0.5);
                    (first, passed, known, tries) = (None, None, until, tries - 1);
                }
                found => break found?,
            }
        };
        if sampled.is_some() {
            (first, passed, how) = (sampled, None, How::Falls);
        }
        if let Some((place, guard)) =
            narrow.filter(|&(place, _)| first.map_or(known, |(part, _)| part) >= place)
        {
            let nearer = S::Scalar::from_f64(0.5) * place;
            let is_resolved = start.t + nearer * (end.t - start.t) != start.t;
            first = if is_resolved { None } else { Some((place, guard)) };
            (known, passed, how) = (if is_resolved { nearer } else { place }, None, How::Falls);
        }
        let (part, guard) = match first {
            Some((part, guard)) => (part, Some(guard)),
            None if known < one => (known, None),
            None => return Ok(None),
        };
        // The polynomial gives the state at the zero itself, too.
        let exact = if S::InRegime::CONSTRAINED || passed.is_none() { None } else { at(part) };
        // A state belongs to a rounded time. The time without rounding, or else the guard, tells how much
        // rounding has moved it.
        let span = end.t - start.t;
        let is_beyond = |t: S::Scalar| (t - end.t) * span > zero;
        let mut at_time = |t: S::Scalar| {
            if t == start.t {
                return Ok(start);
            }
            M::sample(inner, in_regime, constants, control, limits, t, &mut 0).map_err(|error| error.cause)
        };
        let time = |part: S::Scalar| {
            let t = start.t + part * span;
            if part == one || is_beyond(t) { end.t } else { t }
        };
        let before = time(part * S::Scalar::from_f64(EARLIER));
        let (mut state, mut earlier) = (at_time(time(part))?, None);
        let late = match (passed, guard) {
            (Some(passed), Some(guard)) => {
                let late = |t: S::Scalar| (t - start.t) - passed.part(0);
                // At a time that is rounded to before the zero of its guard a contact still presses, and
                // would close again at once. A friction still sticks: a slip would go the wrong way. A load
                // has a direction only where rounding errors of time do not turn it.
                let kind = if let Guard::Row(row) = guard { S::ROWS.get(row) } else { None };
                let ulps = match kind {
                    Some(Row::Load) => S::Scalar::from_f64(RESOLVED),
                    Some(Row::Unilateral | Row::Friction { .. }) if late(state.t) * span < zero => one,
                    _ => zero,
                };
                let next = state.t + ulps * S::Scalar::epsilon() * state.t.abs() * span.signum();
                if !guards.is_of_reactions(guard) {
                    earlier = Some(at_time(before)?);
                } else if next != state.t && !is_beyond(next) {
                    state = at_time(next)?;
                }
                late(state.t)
            }
            (None, Some(guard)) => guards.late(guard, [&at_time(before)?, &state]),
            (_, None) => zero,
        };
        let (accelerations, crossed) = ([zero; N], [false; W]);
        let mut event = Event { state, guard, how, late, place: state, accelerations, crossed };
        let Some(guard) = guard else { return Ok(Some(event)) };
        let State { t, q, v } = state;
        event.accelerations = in_regime.accelerations_at(constants, t, &q, &v, inputs);
        // The place of an event has rounding errors. What forces do on the way from there to the zero of the
        // guard would change the energy in each regime by another amount.
        match exact {
            Some(exact) => event.place = exact.at_time(state.t),
            None => event.go_back(late),
        }
        if let Some(earlier) = &earlier {
            let late = guards.late(guard, [earlier, &event.place]).part(0);
            event.late += late;
            event.go_back(late);
        }
        if let Guard::Kink(fired) = guard {
            let earlier = if W > 1 { earlier.map_or_else(|| at_time(before), Ok)? } else { start };
            event.crossed = array(|kink| kink == fired || guards.has_fallen(kink, [&earlier, &state]));
        }
        Ok(Some(event))
    }
}
