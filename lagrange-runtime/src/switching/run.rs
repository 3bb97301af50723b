//! A motion on its way from regime to regime.

use super::guards::Guard;
use super::hybrid::{Memory, sum};
use super::kinks::{followed, jumped};
use super::known::Known;
use super::memory::HybridMemory;
use super::place::{Event, How};
use super::scene::{Scene, Status, most};
use super::standstill::is_at_rest;
use super::turning::has_pairs;
use super::way::{Way, shift};
use super::{Regime, Row, Switching};
use crate::integrator::jets::probe::restrained;
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real};
use crate::system::System;
use crate::system::control::Held;
use crate::system::error::{Cause, MotionError};
use crate::system::limits::Limits;
use crate::system::method::Adaptive;
use crate::system::state::State;

/// The most changes of regime without any time between them, for each row and kink. More count as endless.
pub(super) const CHANGES: usize = 4;

/// The most times that a step without a known end is tried shorter, and the factor.
const NEARER: usize = 4;
const NEARER_BY: f64 = 1024.0;

/// A motion on its way.
pub(super) struct Run<'a, S, M, const N: usize, const K: usize, const C: usize, const W: usize>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    pub(super) system: &'a S,
    pub(super) memory: &'a mut Memory<S, M, N, K, C, W>,
    pub(super) control: &'a Held<S::Scalar, K>,
    pub(super) limits: &'a Limits<S::Scalar>,
}

impl<S, M, const N: usize, const K: usize, const C: usize, const W: usize> Run<'_, S, M, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    /// Begins a regime at a state.
    pub(super) fn enter(&mut self, regime: Regime<S::Scalar, C, W>, state: State<S::Scalar, N>) {
        let memory = &mut *self.memory;
        memory.counts = sum(memory.counts, M::counts(&memory.inner));
        memory.take_impulses();
        memory.regime = regime;
        memory.in_regime = self.system.in_regime(&regime);
        memory.constants = memory.in_regime.constants();
        M::go_on(&mut memory.inner, &memory.in_regime, state);
        (memory.start, memory.end, memory.next) = (state, state, None);
        memory.is_way = false;
    }

    /// The regime and the state that follow a state: after its impact, projected onto the regime, moved by
    /// the delay of the time that is rounded, and a little later yet if a slip in two directions begins.
    pub(super) fn settle_once(
        &mut self,
        state: &mut State<S::Scalar, N>,
        mut present: Regime<S::Scalar, C, W>,
        mut known: Known<C>,
        late: S::Scalar,
    ) -> Result<Regime<S::Scalar, C, W>, Cause> {
        self.memory.way = Way::with([num_traits::Zero::zero(); N]);
        self.memory.landed = [false; C];
        self.memory.switched = state.t.part(0);
        if S::ROWS.iter().any(|row| *row != Row::Bilateral) {
            let inputs = &self.control.0;
            let scales = &mut self.memory.scales;
            let impulses = &mut self.memory.impulses;
            *impulses = [num_traits::Zero::zero(); C];
            scales.see(state.t, &self.system.laws_at(state.t, &state.q, &state.v, inputs));
            let first = Scene::new(self.system, state, inputs, present.kinks, scales, &known);
            let (later, last);
            let mut scene = &first;
            scene.has_gradients()?;
            if scene.has_impact() {
                let begins = self.memory.is_fresh;
                scene.can_collide(&scales.coefficients)?;
                scales.strike(&scene.status.each(|status| status == Status::Meets), &scene.laws);
                (state.v, *impulses) =
                    scene.collide(&present.active, (known.fired, begins), scales, self.limits.relative)?;
                let rested = scene.stopped(&state.v, impulses);
                present.kinks = jumped(self.system, state, inputs, &present.kinks);
                known = Known { rested, ..Known::struck(scene.is_closed) };
                later = Scene::new(self.system, state, inputs, present.kinks, scales, &known);
                scene = &later;
            }
            // A body that begins or lands rests on all its feet, even on those that bear nothing.
            let lands = self.memory.is_fresh || known.settled;
            let from = if lands { scene.touching(&present) } else { present };
            let (mut choice, mut grown) = scene.follow(&from, known.fired, scales)?;
            if S::Scalar::PARTS > 1 && self.memory.is_fresh {
                scene.touched_by_chance(&choice, self.limits.relative)?;
            }
            let struck = first.has_impact().then_some((&first, &*impulses));
            let gathered = scene.gathered(&choice.accelerations, scales, self.limits.relative, struck);
            if let Some((v, all)) = gathered {
                if S::Scalar::PARTS > 1 {
                    return Err(scene.accumulation());
                }
                state.v = v;
                *impulses = all;
                present.kinks = jumped(self.system, state, inputs, &present.kinks);
                known = Known { closed: scene.is_closed, settled: true, only: true, ..known };
                last = Scene::new(self.system, state, inputs, present.kinks, scales, &known);
                scene = &last;
                (choice, grown) = (scene.choose(&scene.touching(&from), None)?, None);
            }
            let active = &choice.regime.active;
            let bears = |row: usize| S::ROWS[row] == Row::Unilateral && active[row] && !present.active[row];
            self.memory.landed = array(|row| (lands || known.settled) && bears(row));
            if S::Scalar::PARTS > 1 && !lands {
                scene.closed_by_chance(known.fired, bears)?;
            }
            for (seen, &now) in scales.reactions.iter_mut().zip(&choice.multipliers) {
                *seen = most(*seen, now.abs());
            }
            self.memory.way = Way::with(choice.accelerations);
            state.t = state.t.part(0); // Its variation is in `late`.
            let mut begin = *state;
            let gained = choice.known_accelerations();
            shift(&mut begin, &gained, late);
            if let Some(grown) = grown.or_else(|| scene.grown(&choice, scales)) {
                grown.take_on(state, late);
                self.memory.way = grown.way;
                choice.regime = grown.regime;
            } else if choice.later.is_positive() {
                let later = choice.later.part(0);
                state.t += later;
                shift(state, &gained, late + later);
            } else {
                state.v = choice.velocities;
                shift(state, &gained, late);
            }
            let before = state.q;
            scene.bring_onto(&choice.regime, state)?;
            scene.part(&choice.regime, state);
            first.hold_lost(&choice.velocities, &state.v, &mut choice.regime);
            first.still(&mut state.v, &choice.regime);
            first.place(&before, state, &choice.regime, scales);
            if const { has_pairs(&S::ROWS) } && state.t != begin.t {
                self.memory.way.join(&begin, state);
            }
            return Ok(choice.regime);
        }
        let in_regime = self.system.in_regime(&present);
        let State { t, q, v } = *state;
        let constants = in_regime.constants();
        let a = in_regime.accelerations_at(&constants, t, &q, &v, &self.control.0);
        state.t = t.part(0);
        shift(state, &a, late);
        in_regime.project_at(&constants, state, None)?;
        Ok(present)
    }

    /// One piece, towards time `t`.
    pub(super) fn step(&mut self, t: S::Scalar, attempts: &mut u64) -> Result<(), MotionError<S::Scalar>> {
        let at = |state: &State<S::Scalar, N>, cause| MotionError { cause, t: state.t };
        self.memory.scales.relative = self.limits.relative;
        if let Some(cause) = self.memory.stuck {
            return Err(at(&self.memory.end, cause));
        }
        loop {
            if self.memory.is_fresh {
                let opened = self.open();
                opened.map_err(|cause| at(&self.memory.end, cause))?;
            }
            if let Some((regime, state)) = self.memory.next {
                if self.memory.go_on_way() {
                    return Ok(());
                }
                self.enter(regime, state);
            }
            let here = self.memory.end;
            let rests = is_at_rest(&self.memory.start, &here);
            if here.t == t {
                return Ok(());
            }
            if t < here.t && S::ROWS.iter().any(|row| *row != Row::Bilateral) {
                return Err(at(&here, Cause::Irreversible));
            }
            if !M::FOLLOWS_REACTIONS && self.catches_up().map_err(|cause| at(&here, cause))? {
                continue;
            }
            if S::AUTONOMOUS && (rests && self.stays() || C > 0 && self.is_balanced(&here)) {
                (self.memory.start, self.memory.end) = (here, here.at_time(t));
                M::restart(&mut self.memory.inner, self.memory.end);
                return Ok(());
            }
            if rests && S::InRegime::CONSTRAINED {
                // A step at rest that an event has cut short does not bound the next one.
                let (left, last) = ((t - here.t).abs(), (here.t - self.memory.start.t).abs());
                let longest = |last| restrained(left, last, left);
                if longest(last) < longest(num_traits::Zero::zero()) {
                    M::restart(&mut self.memory.inner, here);
                }
            }
            let t_end = if M::IS_PACED { self.steady(t) } else { self.alike_until(t) };
            let mut limits = self.limits_towards(t);
            let memory = &mut *self.memory;
            let (in_regime, constants) = (&memory.in_regime, &memory.constants);
            // The end of a series may also lie where no configuration is known well enough.
            let mut tries = if M::IS_PACED { 0 } else { NEARER };
            let stepped = loop {
                let (inner, control) = (&mut memory.inner, self.control);
                let stepped = M::step(inner, in_regime, constants, control, &limits, t_end, attempts);
                let is_undetermined =
                    matches!(stepped, Err(MotionError { cause: Cause::Undetermined { .. }, .. }));
                match limits.step.as_mut() {
                    Some(longest) if is_undetermined && tries > 0 => {
                        *longest /= S::Scalar::from_f64(NEARER_BY)
                    }
                    _ => break stepped,
                }
                tries -= 1;
                M::restart(&mut memory.inner, here);
            };
            if let Err(error) = stepped {
                if self.lets_go(&error.cause).map_err(|cause| at(&here, cause))? {
                    continue;
                }
                return Err(error);
            }
            let memory = &mut *self.memory;
            let (start, end) = (*M::start(&memory.inner), *M::end(&memory.inner));
            (memory.start, memory.end) = (start, end);
            let found = self.event(attempts).and_then(|found| self.agreed_until(found));
            let found = found.and_then(|found| self.valid_until(found)).map_err(|cause| {
                // A later call begins here again, not at the end of the step.
                M::restart(&mut self.memory.inner, start);
                self.memory.end = start;
                at(&start, cause)
            })?;
            (self.memory.fired, self.memory.begins) =
                (found.as_ref().and_then(|event| event.guard), [false; C]);
            self.memory.is_cut = found.is_some() && self.memory.fired.is_none();
            // Kinks alone have no gaps, and no scales.
            if C > 0 && self.memory.fired.is_none() {
                let State { t, q, v } = found.as_ref().map_or(end, |event| event.state);
                let laws = self.system.laws_at(t, &q, &v, &self.control.0);
                self.memory.scales.see(t, &laws);
                // No piece ends behind an open contact, even if a polynomial has missed it.
                if let Some(cause) = self.missed(&laws) {
                    self.memory.end = start;
                    self.memory.stuck = Some(cause);
                    return Err(at(&start, cause));
                }
            }
            let Some(mut event) = found else {
                self.memory.passes(start.t, end.t);
                self.come_to_rest().map_err(|cause| at(&end, cause))?;
                return Ok(());
            };
            let state = event.state;
            self.memory.end = state;
            let has_passed = self.memory.passes(start.t, state.t);
            match event.guard.map(|guard| self.switch(guard, &mut event)) {
                None => self.memory.next = Some((self.memory.regime, state)),
                Some(Ok(())) => {}
                Some(Err(cause)) => {
                    // A target within the piece lies before the error.
                    self.memory.stuck = Some(cause);
                    return if has_passed { Ok(()) } else { Err(at(&state, cause)) };
                }
            }
            // A time that is asked for may lie so near that no time has passed beyond rounding.
            if has_passed || self.memory.tells || t != state.t && self.memory.covers(t) {
                return Ok(());
            }
            if *attempts == 0 {
                return Err(at(&state, Cause::TooManySteps));
            }
            *attempts -= 1;
        }
    }

    /// Changes the regime where a guard has fired.
    pub(super) fn switch(&mut self, guard: Guard, event: &mut Event<S::Scalar, N, W>) -> Result<(), Cause> {
        let memory = &mut *self.memory;
        let (state, mut present) = (memory.end, memory.regime);
        memory.changes += 1;
        let (mut fired, mut beyond) = (None, num_traits::Zero::zero());
        match guard {
            Guard::Kink(_) => {
                for (kink, _) in event.crossed.iter().enumerate().filter(|(_, is_crossed)| **is_crossed) {
                    self.cross(kink, &mut present, &state)?;
                }
                let before = &self.memory.regime.kinks;
                present.kinks = followed(self.system, &state, &self.control.0, before, &present.kinks);
                beyond = self.beyond_corner(&event.place, &present.kinks)?;
            }
            Guard::Row(row) => {
                if memory.changes > CHANGES * (C + W) {
                    return Err(Cause::EndlessSwitching { constraint: row, name: S::NAMES.constraint(row) });
                }
                fired = Some(row);
            }
        }
        // A slip in two directions that has turned by a right angle has not ended: a new piece begins, with
        // the direction that the slip has there.
        let mut regime_ends = true;
        if let Some(row) = fired
            && let Some(&Row::Friction { pair: Some(other), .. }) = S::ROWS.get(row)
            && present.active.get(row) == Some(&false)
            && !self.rests(row, other, &state)
        {
            (fired, regime_ends) = (None, false);
        }
        self.memory.note_end(&S::ROWS, fired);
        if S::Scalar::PARTS > 1 {
            self.complete(guard, &mut event.accelerations, state.t);
            event.place = state;
            event.go_back(event.late);
        }
        // What has held is at rest, whatever the roundings of its rate are. At a kink the rate may jump.
        let rested = if fired.is_some() { present.active } else { [false; C] };
        let HybridMemory { opened, ended, .. } = *self.memory;
        let known = Known { fired, rested, opened, ended, ..Known::new(present.active) };
        let go_beyond = |state: &mut State<S::Scalar, N>, a: &[S::Scalar; N]| {
            shift(state, a, beyond);
            state.t += beyond;
        };
        let varied = if S::Scalar::PARTS > 1 && regime_ends {
            let a = &event.accelerations;
            self.varied(guard, event.how, &state, a, |run, state| {
                go_beyond(state, a);
                run.settle(state, present, known, event.late)
            })?
        } else {
            num_traits::Zero::zero()
        };
        if event.how == How::Touches {
            let memory = &mut *self.memory;
            (memory.fired, memory.is_cut, memory.next) = (None, true, Some((memory.regime, state)));
            return Ok(());
        }
        let mut state = event.place;
        shift(&mut state, &event.accelerations, varied);
        state.t += varied;
        go_beyond(&mut state, &event.accelerations);
        let regime = self.settle(&mut state, present, known, event.late - varied)?;
        self.memory.note_ends(&S::ROWS, [&present, &regime], fired);
        self.memory.next = Some((regime, state));
        Ok(())
    }

    /// The state at time `t`.
    pub(super) fn state_at(
        &mut self,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>> {
        loop {
            if !self.memory.is_fresh {
                if let Some(state) = self.memory.beside(t) {
                    return Ok(state);
                }
                if self.memory.covers(t) {
                    let memory = &mut *self.memory;
                    if memory.is_way {
                        return Ok(memory.on_way(t));
                    }
                    if is_at_rest(&memory.start, &memory.end) {
                        return Ok(memory.start.at_time(t));
                    }
                    let (in_regime, constants) = (&memory.in_regime, &memory.constants);
                    let inner = &mut memory.inner;
                    return M::sample(inner, in_regime, constants, self.control, self.limits, t, &mut 0);
                }
                self.turn(t);
            }
            self.step(t, attempts)?;
        }
    }

    /// Goes back to the start of the piece where `t` lies before it.
    pub(super) fn turn(&mut self, t: S::Scalar) {
        let memory = &mut *self.memory;
        let (start, end) = (memory.start, memory.end);
        let is_behind = if start.t <= end.t { t < start.t } else { t > start.t };
        if is_behind && start.t != end.t {
            M::restart(&mut memory.inner, start);
            (memory.end, memory.next, memory.is_way) = (start, None, false);
        }
    }
}
