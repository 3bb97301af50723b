//! The walk along a motion, interval by interval.

use super::interval::{Interval, POINTS, Watched};
use super::track::{Pending, RESOLVED, Refused, Track};
use super::{Crossing, Event, Guard};
use crate::integrator::step_size;
use crate::motion::roots::Unresolved;
use crate::motion::simulation::Simulation;
use crate::number::real::{Ordered, larger, smaller};
use crate::system::System;
use crate::system::attitude;
use crate::system::control::Control;
use crate::system::error::{Cause, MotionError};
use crate::system::method::Adaptive;
use crate::system::state::State;

/// Growth factor of the interval that follows one that had to be shortened.
const GROWTH: f64 = 4.0;

/// How much shorter than the step an interval may become only because its start drowns in its end.
const SHORTEST: f64 = 1e-13;

/// A start that is less than this part of the end counts as zero: the last digits of times next to zero are
/// finer than the states are.
const FAR: f64 = 1e-9;

/// The largest number of consecutive intervals as short as the resolution of time. A kink or a jump takes
/// fewer; more mean that the guard cannot be resolved.
const BLIND: u8 = 16;

/// A search for the zeros of `E` guards up to a time.
#[derive(Clone, Debug)]
pub(super) struct Search<R, const N: usize, const E: usize> {
    until: R,
    /// Up to here all zeros are known.
    front: State<R, N>,
    /// The interval that ends there.
    interval: Interval<R>,
    tracks: [Track<R>; E],
    /// The length of the next interval \[s], where that is not the rest of the step.
    length: Option<R>,
    /// Intervals in a row that were too short for polynomials.
    blind: u8,
    /// Whether the motion jumps at the front, and the guards have not been asked what that means.
    leaps: bool,
    begun: bool,
    ended: bool,
}

impl<R: Ordered, const N: usize, const E: usize> Search<R, N, E> {
    pub fn new(front: State<R, N>, until: R) -> Self {
        let interval = Interval { from: front.t, to: front.t };
        let tracks = core::array::from_fn(|_| Track::new());
        Self {
            until,
            front,
            interval,
            tracks,
            length: None,
            blind: 0,
            leaps: false,
            begun: false,
            ended: false,
        }
    }

    /// The next event, to which the motion moves.
    pub fn next<S, C, M, G, const K: usize>(
        &mut self,
        motion: &mut Simulation<'_, S, C, M, N, K>,
        guards: &[G; E],
        only: Option<Crossing>,
    ) -> Result<Option<Event<R, N>>, MotionError<R>>
    where
        S: System<N, K, Scalar = R>,
        C: Control<R, N, K>,
        M: Adaptive<S, C, N, K>,
        G: Guard<S, R, N>,
    {
        if self.ended {
            return Ok(None);
        }
        if !self.begun {
            self.ended = true;
            motion.check(self.until)?;
            motion.begin()?;
            self.front = motion.state;
            (self.begun, self.ended) = (true, false);
        }
        let mut attempts = motion.limits.attempts;
        loop {
            let mut found = self.pending(motion, guards);
            if found.is_none() && core::mem::take(&mut self.leaps) {
                for (track, guard) in self.tracks.iter_mut().zip(guards) {
                    track.jumped(Watched { motion: &mut *motion, guard }.at(&self.front), self.interval);
                }
                found = self.pending(motion, guards);
            }
            match found {
                Some((index, Pending { theta, crossing, blur }))
                    if only.is_none_or(|only| only == crossing) =>
                {
                    let t = self.interval.time(theta);
                    let state = if t == self.front.t { Ok(self.front) } else { motion.peek(t) };
                    self.ended = state.is_err();
                    motion.state = state?;
                    motion.event = Some([t, blur]);
                    return Ok(Some(Event { state: motion.state, crossing, index }));
                }
                Some(_) => {}
                None if self.front.t == self.until => {
                    self.ended = true;
                    motion.state = self.front;
                    return Ok(None);
                }
                None => {
                    let gone = self.go_on(motion, guards, &mut attempts);
                    if gone.is_err() {
                        self.ended = true;
                        motion.state = self.front;
                    }
                    gone?;
                }
            }
        }
    }

    /// The earliest zero on the interval that has not been reported; of simultaneous ones that of the first
    /// guard. Where the search ends, a zero that a guard has just reached is one of them.
    fn pending<S, C, M, G, const K: usize>(
        &mut self,
        motion: &mut Simulation<'_, S, C, M, N, K>,
        guards: &[G; E],
    ) -> Option<(usize, Pending<R>)>
    where
        S: System<N, K, Scalar = R>,
        C: Control<R, N, K>,
        M: Adaptive<S, C, N, K>,
        G: Guard<S, R, N>,
    {
        let (interval, ends) = (self.interval, self.front.t == self.until);
        let all = self.tracks.iter().map(|track| track.next(interval, ends)).enumerate();
        let mut found = all.filter_map(|(index, next)| Some((index, next?)));
        let first = found.next()?;
        // Several parts of an interval may round to one time, so the times are compared.
        let is_before = |next: &Pending<R>, first: &Pending<R>| interval.is_before(next.theta, first.theta);
        let (index, pending) =
            found.fold(first, |first, next| if is_before(&next.1, &first.1) { next } else { first });
        if let (Some(track), Some(guard)) = (self.tracks.get_mut(index), guards.get(index)) {
            track.count(&mut Watched { motion, guard }, interval);
        }
        Some((index, pending))
    }

    /// Looks at the next interval.
    fn go_on<S, C, M, G, const K: usize>(
        &mut self,
        motion: &mut Simulation<'_, S, C, M, N, K>,
        guards: &[G; E],
        attempts: &mut u64,
    ) -> Result<(), MotionError<R>>
    where
        S: System<N, K, Scalar = R>,
        C: Control<R, N, K>,
        M: Adaptive<S, C, N, K>,
        G: Guard<S, R, N>,
    {
        let Some(end) = self.reach(motion, guards, attempts)? else { return Ok(()) };
        // Two jumps of the motion may be a rounding error of time apart: then the front has moved on.
        let from = self.front.t;
        let step = (end - from).abs();
        let ahead = if end < from { -R::one() } else { R::one() };
        // Time is resolved as at the start of the interval, unless that is next to zero.
        let near = if from.abs() > R::from_f64(FAR) * end.abs() { from.abs() } else { end.abs() };
        let resolution = R::from_f64(RESOLVED) * R::epsilon() * near + step_size::smallest();
        let mut length = self.length.map_or(step, |length| smaller(length, step));
        // A kink does not make the intervals behind it shorter.
        let mut uncut = length;
        loop {
            let to = if length < step { from + ahead * length } else { end };
            let interval = Interval { from, to };
            let mut states = [self.front; POINTS];
            for (i, state) in states.iter_mut().enumerate().skip(1) {
                *state = motion.peek(interval.time(R::from_f64(i as f64 / (POINTS - 1) as f64)))?;
            }
            let strict = length > R::from_f64(SHORTEST) * step && length > resolution;
            // A polynomial leads to the state before a jump.
            let (mut smooth, before) = (states, *M::end(&motion.memory));
            let leaps = before.t == to && smooth.last().is_some_and(|after| *after != before);
            if let (true, Some(last)) = (leaps, smooth.last_mut()) {
                *last = before;
            }
            match self.look(motion, guards, interval, &smooth, (strict, resolution)) {
                Ok(()) => (self.blind, self.leaps) = (0, leaps),
                Err(Refused::Failed(error)) => return Err(error),
                Err(Refused::TooLong(cause)) if length <= resolution => {
                    let is_number = self.compare(motion, guards, interval, &states);
                    self.blind = self.blind.saturating_add(1);
                    if !is_number || self.blind > BLIND {
                        let infinite = !is_number || cause == Unresolved::NotFinite;
                        let cause = if infinite { Cause::NotFinite } else { Cause::StepTooSmall };
                        return Err(MotionError { cause, t: from });
                    }
                }
                Err(Refused::TooLong(_)) => {
                    spend(attempts, from)?;
                    length = larger(length * R::from_f64(0.5), resolution);
                    uncut = length;
                    continue;
                }
                Err(Refused::Beyond(part)) => {
                    spend(attempts, from)?;
                    length *= part;
                    continue;
                }
            }
            self.length = (uncut < step).then_some(uncut * R::from_f64(GROWTH));
            [.., self.front] = states;
            self.interval = interval;
            for (track, guard) in self.tracks.iter_mut().zip(guards) {
                track.refill(&mut Watched { motion: &mut *motion, guard }, interval, R::zero());
            }
            return Ok(());
        }
    }

    /// How far the motion is known ahead of the front: to the end of its last step, or to `until` if that
    /// comes first. Takes another step if the last one does not lead ahead. `None` if the new step led
    /// nowhere.
    fn reach<S, C, M, G, const K: usize>(
        &mut self,
        motion: &mut Simulation<'_, S, C, M, N, K>,
        guards: &[G; E],
        attempts: &mut u64,
    ) -> Result<Option<R>, MotionError<R>>
    where
        S: System<N, K, Scalar = R>,
        C: Control<R, N, K>,
        M: Adaptive<S, C, N, K>,
        G: Guard<S, R, N>,
    {
        let (from, until) = (self.front.t, self.until);
        let is_ahead = |t: R| if until < from { t < from } else { t > from };
        let inside = |[a, b]: [R; 2]| (a <= from && from <= b) || (b <= from && from <= a);
        let ends =
            |motion: &Simulation<'_, S, C, M, N, K>| [M::start(&motion.memory).t, M::end(&motion.memory).t];
        let mut step = ends(motion);
        if !(inside(step) && step.into_iter().any(is_ahead)) {
            let Simulation { system, constants, control, limits, memory, .. } = motion;
            if step[1] != from {
                // The other way, or from a sample that the method has left behind.
                M::restart(memory, self.front);
            }
            spend(attempts, from)?;
            M::step(memory, system, constants, control, limits, until, attempts)?;
            // Where the motion jumps, the step starts behind the jump.
            let before = core::mem::replace(&mut self.front, *M::start(memory));
            if attitude::settle(S::ORIENTATIONS, &before).is_some_and(|settled| settled == self.front) {
                for (track, guard) in self.tracks.iter_mut().zip(guards) {
                    let watched = Watched { motion: &mut *motion, guard };
                    track.renamed(watched.at(&before), watched.at(&self.front));
                }
            }
            step = ends(motion);
        }
        let end = step.into_iter().find(|&t| is_ahead(t));
        let nearer = |end: R| if (end - until) * (from - until) < R::zero() { until } else { end };
        Ok(end.map(nearer))
    }

    /// Interpolates all guards on an interval.
    fn look<S, C, M, G, const K: usize>(
        &mut self,
        motion: &mut Simulation<'_, S, C, M, N, K>,
        guards: &[G; E],
        interval: Interval<R>,
        states: &[State<R, N>; POINTS],
        (strict, resolution): (bool, R),
    ) -> Result<(), Refused<R>>
    where
        S: System<N, K, Scalar = R>,
        C: Control<R, N, K>,
        M: Adaptive<S, C, N, K>,
        G: Guard<S, R, N>,
    {
        let blur = motion.event.filter(|[t, _]| *t == interval.from).map(|[_, blur]| blur);
        for (track, guard) in self.tracks.iter_mut().zip(guards) {
            track.look(
                &mut Watched { motion: &mut *motion, guard },
                interval,
                states,
                (blur, strict, resolution),
            )?;
        }
        Ok(())
    }

    /// Compares all guards at the ends of an interval; false if one is no number.
    fn compare<S, C, M, G, const K: usize>(
        &mut self,
        motion: &mut Simulation<'_, S, C, M, N, K>,
        guards: &[G; E],
        interval: Interval<R>,
        states: &[State<R, N>; POINTS],
    ) -> bool
    where
        S: System<N, K, Scalar = R>,
        C: Control<R, N, K>,
        M: Adaptive<S, C, N, K>,
        G: Guard<S, R, N>,
    {
        let mut tracks = self.tracks.iter_mut().zip(guards);
        tracks.all(|(track, guard)| track.compare(&Watched { motion: &mut *motion, guard }, interval, states))
    }
}

/// Counts an attempt.
fn spend<R: Ordered>(attempts: &mut u64, t: R) -> Result<(), MotionError<R>> {
    *attempts = attempts.checked_sub(1).ok_or(MotionError { cause: Cause::TooManySteps, t })?;
    Ok(())
}
