//! A motion on its way from regime to regime.

use super::guards::{Guard, Guards};
use super::hybrid::{Memory, sum};
use super::scene::{Known, Scene, above, most};
use super::{Regime, Row, Switching};
use crate::motion::roots::Unresolved;
use crate::number::real::{Ordered, Real};
use crate::system::System;
use crate::system::control::Held;
use crate::system::error::{Cause, MotionError};
use crate::system::limits::Limits;
use crate::system::method::Adaptive;
use crate::system::state::State;

/// Changes of regimes without any time between them, for each row and kink, until they count as endless.
const CHANGES: usize = 4;

/// The part of a piece at which its guard is compared with the end, for its slope.
const EARLIER: f64 = 1.0 - 1e-3;

/// Where a guard has fired.
struct Event<R, const N: usize> {
    state: State<R, N>,
    guard: Guard,
    /// How long after the zero of the guard the time of the state is, which is rounded.
    late: R,
}

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
        memory.regime = regime;
        memory.in_regime = self.system.in_regime(&regime);
        memory.constants = memory.in_regime.constants();
        M::go_on(&mut memory.inner, &memory.in_regime, state);
        (memory.start, memory.end, memory.next) = (state, state, None);
    }

    /// What follows a state: its impact, the regime that goes on, and the state projected onto that, so much later
    /// as the time of the state is rounded.
    pub(super) fn settle(
        &mut self,
        state: &mut State<S::Scalar, N>,
        present: &Regime<S::Scalar, C, W>,
        mut known: Known<C>,
        avoid: bool,
        late: S::Scalar,
    ) -> Result<Regime<S::Scalar, C, W>, Cause> {
        if C > 0 {
            let inputs = &self.control.0;
            let scales = &mut self.memory.scales;
            scales.see(&self.system.laws_at(state.t, &state.q, &state.v));
            let first = Scene::new(self.system, state, inputs, present.kinks, scales, &known);
            let mut later;
            let mut scene = &first;
            if scene.has_impact() {
                scales.strike(&scene.status, &scene.laws);
                state.v = scene.impact()?;
                known = Known { closed: scene.is_closed, fired: None, settled: true };
                later = Scene::new(self.system, state, inputs, present.kinks, scales, &known);
                scene = &later;
            }
            if let Some(v) = scene.gathered(present, scales, self.limits.relative)? {
                state.v = v;
                (known.closed, known.settled) = (scene.is_closed, true);
                later = Scene::new(self.system, state, inputs, present.kinks, scales, &known);
                scene = &later;
            }
            let choice = scene.choose(present, known.fired.filter(|_| avoid))?;
            for (seen, &now) in scales.reactions.iter_mut().zip(&choice.multipliers) {
                *seen = most(*seen, now.abs());
            }
            state.v = choice.velocities;
            shift(state, &choice.accelerations, late);
            let in_regime = self.system.in_regime(&choice.regime);
            in_regime.project_at(&in_regime.constants(), state, None)?;
            first.still(&mut state.v);
            return Ok(choice.regime);
        }
        let in_regime = self.system.in_regime(present);
        let State { t, q, v } = *state;
        let a = in_regime.accelerations_at(&in_regime.constants(), t, &q, &v, &self.control.0);
        shift(state, &a, late);
        Ok(*present)
    }

    /// One piece, towards time `t`.
    pub(super) fn step(&mut self, t: S::Scalar, attempts: &mut u64) -> Result<(), MotionError<S::Scalar>> {
        let at = |state: &State<S::Scalar, N>, cause| MotionError { cause, t: state.t };
        if let Some(cause) = self.memory.stuck {
            return Err(at(&self.memory.end, cause));
        }
        loop {
            if self.memory.is_fresh {
                let opened = self.open();
                opened.map_err(|cause| at(&self.memory.end, cause))?;
            }
            if let Some((regime, state)) = self.memory.next {
                self.enter(regime, state);
            }
            let here = self.memory.end;
            if S::InRegime::CONSTRAINED && is_at_rest(&self.memory.start, &here) {
                // Nothing bounds the length of a step by that of one before it.
                M::restart(&mut self.memory.inner, here);
            }
            if here.t == t {
                return Ok(());
            }
            if t < here.t && S::ROWS.iter().any(|row| *row != Row::Bilateral) {
                return Err(at(&here, Cause::Irreversible));
            }
            let memory = &mut *self.memory;
            let (in_regime, constants) = (&memory.in_regime, &memory.constants);
            M::step(&mut memory.inner, in_regime, constants, self.control, self.limits, t, attempts)?;
            let (start, end) = (*M::start(&memory.inner), *M::end(&memory.inner));
            (memory.start, memory.end) = (start, end);
            let found = self.event();
            let found = found.map_err(|cause| {
                self.memory.end = start;
                at(&start, cause)
            })?;
            self.memory.fired = found.as_ref().map(|event| event.guard);
            let Some(Event { state, guard, late }) = found else {
                let laws = self.system.laws_at(end.t, &end.q, &end.v);
                self.memory.scales.see(&laws);
                // Whatever a polynomial has not shown, no step ends behind a contact that is open.
                if let Some(cause) = self.missed(&laws) {
                    self.memory.end = start;
                    self.memory.stuck = Some(cause);
                    return Err(at(&start, cause));
                }
                self.passed(start.t, end.t);
                self.come_to_rest().map_err(|cause| at(&end, cause))?;
                return Ok(());
            };
            self.memory.end = state;
            let has_passed = self.passed(start.t, state.t);
            if let Err(cause) = self.switch(guard, late) {
                self.memory.stuck = Some(cause);
                return Err(at(&state, cause));
            }
            if has_passed {
                return Ok(());
            }
            if *attempts == 0 {
                return Err(at(&state, Cause::TooManySteps));
            }
            *attempts -= 1;
        }
    }

    /// A gap of an open contact that is negative by more than what a start may penetrate.
    fn missed(&self, laws: &super::Laws<S::Scalar, C, W>) -> Option<Cause> {
        let share = S::Scalar::from_f64(1.0 / 16.0) * S::Scalar::epsilon().sqrt();
        (0..C).find_map(|row| {
            let gap = laws.rows.positions[row];
            let size = most(laws.rows.position_sizes[row], self.memory.scales.gaps[row]);
            let is_open = S::ROWS[row] == Row::Unilateral && !self.memory.regime.active[row];
            (is_open && above(-gap, share * size)).then(|| Cause::Penetrates {
                constraint: row,
                name: S::NAMES.constraint(row),
                by: crate::system::error::magnitude(-gap),
            })
        })
    }

    /// Whether time has passed that is more than rounding; forgets the changes before it if so.
    fn passed(&mut self, from: S::Scalar, to: S::Scalar) -> bool {
        let resolution = S::Scalar::from_f64(16.0) * S::Scalar::epsilon() * from.abs();
        let has_passed = (to - from).abs() > resolution;
        if has_passed {
            (self.memory.flips, self.memory.changes) = ([0; W], 0);
        }
        has_passed
    }

    /// The first event of the piece.
    fn event(&mut self) -> Result<Option<Event<S::Scalar, N>>, Cause> {
        let memory = &mut *self.memory;
        let (start, end) = (memory.start, memory.end);
        let (in_regime, constants) = (&memory.in_regime, &memory.constants);
        let terms = M::terms(&memory.inner);
        let is_along = terms.is_some();
        let inputs = &self.control.0;
        let guards = Guards::new(self.system, in_regime, &memory.regime, inputs, &start, is_along);
        if guards.is_empty() {
            return Ok(None);
        }
        let (zero, one) = (num_traits::Zero::zero(), num_traits::One::one());
        let mut fall = None;
        if let Some(terms) = terms {
            let found = guards.first_along(&start, &terms, memory.fired).map_err(Unresolved::cause)?;
            fall = found.map(|found| (found, terms.length * terms.unit, terms.residue));
        }
        let inner = &mut memory.inner;
        let (control, limits) = (self.control, self.limits);
        let mut at = |part: S::Scalar| {
            if part == zero {
                return Some(start);
            }
            M::within(inner, in_regime, constants, control, limits, part).ok()
        };
        let mut first = fall.map(|((fall, guard), ..)| (guards.at_zero(guard, fall, &mut at), guard));
        // The time since the start that a part of the step is, without the rounding of times.
        let mut passed = first.zip(fall).map(|((part, _), (_, length, residue))| part * length + residue);
        let until = first.map_or(one, |(part, _)| part);
        let sampled = guards.first(&memory.scales, [start.t, end.t], until, &mut at)?;
        if sampled.is_some() {
            (first, passed) = (sampled, None);
        }
        let Some((part, guard)) = first else { return Ok(None) };
        // A state belongs to a time that has been rounded; how much that is, the guard tells.
        let mut at_time = |part: S::Scalar| {
            let t = start.t + part * (end.t - start.t);
            let is_beyond =
                part == num_traits::One::one() || (t - end.t) * (end.t - start.t) > num_traits::Zero::zero();
            let t = if is_beyond { end.t } else { t };
            if t == start.t {
                return Ok(start);
            }
            M::sample(inner, in_regime, constants, control, limits, t, &mut 0).map_err(|error| error.cause)
        };
        let state = at_time(part)?;
        let late = match passed {
            Some(passed) => (state.t - start.t) - passed,
            None => guards.late(guard, [&at_time(part * S::Scalar::from_f64(EARLIER))?, &state]),
        };
        Ok(Some(Event { state, guard, late }))
    }

    /// Changes the regime where a guard has fired.
    fn switch(&mut self, guard: Guard, late: S::Scalar) -> Result<(), Cause> {
        let memory = &mut *self.memory;
        let (mut state, mut present) = (memory.end, memory.regime);
        memory.changes += 1;
        let (mut fired, mut avoid) = (None, false);
        match guard {
            Guard::Kink(kink) => {
                present.kinks[kink] = -present.kinks[kink];
                memory.flips[kink] += 1;
                if memory.flips[kink] > CHANGES {
                    return Err(Cause::HeldAtKink { kink, name: S::KINKS[kink] });
                }
                // The force of an energy that jumps would act at a point, where no equation has it.
                let [jumps, sizes] = self.system.jumps_at(state.t, &state.q, &state.v);
                if above(jumps[kink].abs(), S::Scalar::epsilon().sqrt() * sizes[kink]) {
                    return Err(Cause::EnergyJumps { kink, name: S::KINKS[kink] });
                }
            }
            Guard::Row(row) => {
                if memory.changes > CHANGES * (C + W) {
                    return Err(Cause::EndlessSwitching { constraint: row, name: S::NAMES.constraint(row) });
                }
                fired = Some(row);
                avoid = S::ROWS[row] != Row::Unilateral || present.active[row];
            }
        }
        // A slip in two directions has turned by a right angle: the step goes on from there.
        if let Some(row) = fired
            && let Row::Friction { pair: Some(other), .. } = S::ROWS[row]
            && !present.active[row]
            && !self.rests(row, other, &state)
        {
            (fired, avoid) = (None, false);
        }
        // Back to the event itself.
        let State { t, q, v } = state;
        let a = self.memory.in_regime.accelerations_at(&self.memory.constants, t, &q, &v, &self.control.0);
        shift(&mut state, &a, -late);
        let known = Known { closed: present.active, fired, settled: false };
        let regime = self.settle(&mut state, &present, known, avoid, late)?;
        self.memory.next = Some((regime, state));
        Ok(())
    }

    /// Whether what is left of a slip in two directions is less than the tolerance of what it has been.
    fn rests(&self, row: usize, other: usize, state: &State<S::Scalar, N>) -> bool {
        let rows = self.system.laws_at(state.t, &state.q, &state.v).rows;
        let least = S::Scalar::from_f64(256.0) * S::Scalar::epsilon();
        let scales = &self.memory.scales;
        let size = most(scales.speeds[row], scales.speeds[other]);
        let slip = rows.rates[row].hypot(rows.rates[other]);
        !above(slip, most(self.limits.relative, least) * size)
    }

    /// Ends a slip in two directions that is about to come to rest: its direction turns ever faster there, and
    /// steps, which end before, become shorter and shorter. From within the tolerance the rest is a straight line.
    fn come_to_rest(&mut self) -> Result<(), Cause> {
        for (row, kind) in S::ROWS.iter().enumerate() {
            let Row::Friction { pair: Some(other), .. } = *kind else { continue };
            let slips = self.memory.regime.slip[row] != num_traits::Zero::zero();
            if !slips || other < row || !self.rests(row, other, &self.memory.end) {
                continue;
            }
            let (memory, inputs) = (&*self.memory, &self.control.0);
            let State { t, q, v } = memory.end;
            let known = Known { closed: memory.regime.active, fired: None, settled: true };
            let scene =
                Scene::new(self.system, &memory.end, inputs, memory.regime.kinks, &memory.scales, &known);
            let Some(equations) = S::equations_in(&memory.in_regime, t, &q, &v, inputs) else { continue };
            let mut a = equations.balance().accelerations;
            let (x, y) = (scene.laws.rows.rates[row], scene.laws.rows.rates[other]);
            let falls = -(x * scene.rate(row, &a) + y * scene.rate(other, &a));
            let mut left = (x * x + y * y) / falls;
            if x == num_traits::Zero::zero() && y == num_traits::Zero::zero() {
                // It is there, and has no direction any more.
                (left, a) = (num_traits::Zero::zero(), [num_traits::Zero::zero(); N]);
            } else if !falls.is_positive() {
                continue;
            }
            let half = S::Scalar::from_f64(0.5);
            let mut state = State {
                t: t + left,
                q: core::array::from_fn(|i| q[i] + left * (v[i] + half * left * a[i])),
                v: core::array::from_fn(|i| v[i] + left * a[i]),
            };
            let present = memory.regime;
            let known = Known { closed: present.active, fired: Some(row), settled: false };
            let regime = self.settle(&mut state, &present, known, true, num_traits::Zero::zero())?;
            self.memory.next = Some((regime, state));
            return Ok(());
        }
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
                let after = self.memory.after();
                if t == after.t {
                    return Ok(after);
                }
                if self.memory.covers(t) {
                    let memory = &mut *self.memory;
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
            (memory.end, memory.next) = (start, None);
        }
    }
}

/// Whether nothing moves.
fn is_at_rest<R: Real, const N: usize>(start: &State<R, N>, end: &State<R, N>) -> bool {
    start.t != end.t && end.v.iter().all(|&v| v == R::zero()) && start.q == end.q
}

/// Moves a state by a time that is shorter than the resolution of its own.
fn shift<R: Real, const N: usize>(state: &mut State<R, N>, accelerations: &[R; N], dt: R) {
    // Where a slip in two directions has come to rest, its regime has no accelerations.
    if dt == R::zero() || !accelerations.iter().all(|a| a.is_finite()) {
        return;
    }
    for ((q, v), &a) in state.q.iter_mut().zip(&mut state.v).zip(accelerations) {
        *q += dt * *v;
        *v += dt * a;
    }
}
