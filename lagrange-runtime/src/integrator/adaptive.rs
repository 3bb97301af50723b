//! Dormand–Prince 8(5,3) as a method that chooses its own steps ([`Adaptive`]).

mod narrow;
mod passage;
mod reach;

use super::Field;
use super::dop853::{Dop853Memory, Ground};
use super::landing::{Check, Determined};
use super::lengths::{Lengths, Verdict};
use super::slopes::Slope;
use super::step_size;
use crate::number::real::{Ordered, Real, larger};
use crate::system::System;
use crate::system::attitude;
use crate::system::control::Control;
use crate::system::diagnose;
use crate::system::error::{Cause, MotionError};
use crate::system::limits::Limits;
use crate::system::method::{Adaptive, Steps};
use crate::system::state::State;
use narrow::halve;

/// Dormand–Prince 8(5,3): an explicit Runge–Kutta method of order 8 with dense output, for any system.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dop853;

impl<S, C, const N: usize, const K: usize> Adaptive<S, C, N, K> for Dop853
where
    S: System<N, K>,
    C: Control<S::Scalar, N, K>,
{
    type Memory = Dop853Memory<S::Scalar, N>;

    #[inline]
    fn begin(_: &S, start: State<S::Scalar, N>) -> Self::Memory
    where
        S::Scalar: Ordered,
    {
        const {
            assert!(
                C::HELD || !S::SWITCHED,
                "this system has contacts or dry friction, and goes through them with inputs that are held: write a law of the \
                 state as a `#[force]`, or set the inputs at the times of a controller (`set_inputs`, then `advance_by`)"
            );
            assert!(
                !S::SWITCHED,
                "this system has contacts or dry friction, which `Dop853` alone does not see: use `simulate(…)`"
            );
        }
        Dop853Memory::new(start)
    }

    #[inline]
    fn restart(memory: &mut Self::Memory, state: State<S::Scalar, N>)
    where
        S::Scalar: Ordered,
    {
        memory.restart(state);
    }

    #[inline]
    fn start(memory: &Self::Memory) -> &State<S::Scalar, N> {
        &memory.start.state
    }

    #[inline]
    fn end(memory: &Self::Memory) -> &State<S::Scalar, N> {
        &memory.end.state
    }

    #[inline]
    fn step(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        control: &C,
        limits: &Limits<S::Scalar>,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> Result<(), MotionError<S::Scalar>>
    where
        S::Scalar: Ordered,
    {
        Driven { system, constants, control }.step(memory, limits, t, false, attempts)
    }

    #[inline]
    fn within(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        control: &C,
        limits: &Limits<S::Scalar>,
        part: S::Scalar,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>>
    where
        S::Scalar: Ordered,
    {
        Driven { system, constants, control }.at_part(memory, limits, part)
    }

    #[inline]
    fn counts(memory: &Self::Memory) -> Steps {
        memory.counts
    }

    #[inline]
    fn advance(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        control: &C,
        limits: &Limits<S::Scalar>,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>>
    where
        S::Scalar: Ordered,
    {
        let driven = Driven { system, constants, control };
        if memory.end.state.t != t && !memory.ahead(t) {
            // A step that series have taken is not cut at a target. The state is taken inside it.
            if memory.passage.is_some() && memory.covers(t) {
                return driven.inside(memory, limits, t);
            }
            memory.rewind();
        }
        while memory.end.state.t != t {
            driven.step(memory, limits, t, true, attempts)?;
            // A step that could not end at the target went beyond it.
            if !memory.ahead(t) {
                return driven.inside(memory, limits, t);
            }
        }
        Ok(memory.end.state)
    }

    #[inline]
    fn sample(
        memory: &mut Self::Memory,
        system: &S,
        constants: &S::Constants,
        control: &C,
        limits: &Limits<S::Scalar>,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>>
    where
        S::Scalar: Ordered,
    {
        let driven = Driven { system, constants, control };
        while !memory.covers(t) {
            if !memory.ahead(t) {
                memory.rewind();
            }
            driven.step(memory, limits, t, false, attempts)?;
        }
        driven.inside(memory, limits, t)
    }
}

/// A system under control, in the form that the integrator takes.
struct Driven<'a, S: System<N, K>, C, const N: usize, const K: usize> {
    system: &'a S,
    constants: &'a S::Constants,
    control: &'a C,
}

impl<S, C, const N: usize, const K: usize> Driven<'_, S, C, N, K>
where
    S: System<N, K>,
    S::Scalar: Ordered,
    C: Control<S::Scalar, N, K>,
{
    /// One step towards `target`. With `exactly` it ends there instead of leading beyond.
    #[inline]
    fn step(
        &self,
        memory: &mut Dop853Memory<S::Scalar, N>,
        limits: &Limits<S::Scalar>,
        target: S::Scalar,
        exactly: bool,
        attempts: &mut u64,
    ) -> Result<(), MotionError<S::Scalar>> {
        let ground = memory.ground;
        loop {
            self.stride(memory, limits, target, exactly, attempts)?;
            if !S::STEEP || !self.misses(memory, limits) {
                return if S::JUMPS { self.passable(memory) } else { Ok(()) };
            }
            halve(memory);
            memory.ground = ground;
            let start = memory.end.state.t;
            if step_size::is_below(memory.length(), Dop853Memory::<_, N>::resolution(start)) {
                return Err(MotionError { cause: Cause::StepTooSmall, t: start });
            }
        }
    }

    /// Refuses a step across a kink at which something jumps, and returns to its start.
    #[cold]
    fn passable(&self, memory: &mut Dop853Memory<S::Scalar, N>) -> Result<(), MotionError<S::Scalar>> {
        let (from, to) = (memory.start.state, memory.end.state);
        let passed = self.system.passed_at(&from, &to, &self.control.inputs(&from));
        passed.map_err(|cause| {
            memory.rewind();
            MotionError { cause, t: from.t }
        })
    }

    /// The same without a search for narrow functions inside the step, and for kinks that it has passed.
    #[inline]
    fn stride(
        &self,
        memory: &mut Dop853Memory<S::Scalar, N>,
        limits: &Limits<S::Scalar>,
        target: S::Scalar,
        exactly: bool,
        attempts: &mut u64,
    ) -> Result<(), MotionError<S::Scalar>> {
        if let Some(settled) = attitude::settle(S::ORIENTATIONS, &memory.end.state) {
            memory.restart(settled);
        }
        if !S::CONSTRAINED {
            return memory.step(self, limits, target, exactly, attempts);
        }
        let ground = match memory.ground {
            Some(ground) => ground,
            None => self.ground(&memory.end.state)?,
        };
        memory.ground = Some(ground);
        let natural = memory.length();
        let landed = match memory.step(self, limits, target, exactly, attempts) {
            Ok(()) => self.land(memory, limits, target, (ground, natural), attempts),
            Err(MotionError { cause: Cause::Undetermined { .. } | Cause::StepTooSmall, .. })
                if self.passes(memory, limits, target, ground, attempts) =>
            {
                Ok(())
            }
            Err(error) => Err(error),
        };
        landed.map_err(|error| self.named(memory, limits, target, natural, error))
    }

    /// How well the constraints determine the start of a motion.
    fn ground(&self, start: &State<S::Scalar, N>) -> Result<Ground<S::Scalar>, MotionError<S::Scalar>> {
        let footing = self.system.land_at(self.constants, &mut start.clone(), None);
        let here = footing.map_err(|cause| MotionError { cause, t: start.t })?.independence;
        Ok(Ground { here, determined: Determined::at_start(&here) })
    }

    /// Brings the end of a step back onto the constraints, or takes another step whose end can be.
    fn land(
        &self,
        memory: &mut Dop853Memory<S::Scalar, N>,
        limits: &Limits<S::Scalar>,
        target: S::Scalar,
        (ground, natural): (Ground<S::Scalar>, S::Scalar),
        attempts: &mut u64,
    ) -> Result<(), MotionError<S::Scalar>> {
        let from = memory.start.state;
        let inputs = self.control.inputs(&from);
        let check =
            Check { system: self.system, constants: self.constants, inputs: &inputs, limits, from: &from };
        let failed = |cause| MotionError { cause, t: from.t };
        let mut length = (memory.end.state.t - from.t).abs();
        let resolution = Dop853Memory::<_, N>::resolution(from.t);
        let longest = larger(natural, length);
        let mut lengths =
            Lengths::new(ground.determined, &ground.here, limits.relative, [longest, longest, length]);
        let mut is_first = true;
        loop {
            let (next, cause) = match lengths.judge(&check, length, check.land(&memory.end.state, None)) {
                Verdict::Take(landing, determined) => {
                    memory.ground = Some(Ground { here: landing.footing.independence, determined });
                    memory.correct(landing.end);
                    return Ok(());
                }
                Verdict::Try { length, cause } => (Some(length), cause),
                Verdict::GiveUp(cause) => (None, cause),
            };
            // Shorter steps would only come closer to the configuration in which constraints depend on each
            // other.
            if is_first {
                memory.rewind();
                if self.passes(memory, limits, target, ground, attempts) {
                    return Ok(());
                }
            }
            is_first = false;
            let Some(next) = next.filter(|&next| !step_size::is_below(next, resolution)) else {
                memory.retry(num_traits::Zero::zero());
                return Err(failed(cause));
            };
            length = next;
            memory.retry(length);
            memory.step(self, limits, target, false, attempts)?;
        }
    }

    /// The state at a time inside the step.
    fn inside(
        &self,
        memory: &mut Dop853Memory<S::Scalar, N>,
        limits: &Limits<S::Scalar>,
        t: S::Scalar,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>> {
        let (start, end) = (memory.start.state.t, memory.end.state.t);
        let zero = num_traits::Zero::zero();
        let part = if start == end { zero } else { (t - start) / (end - start) };
        let state = self.at_part(memory, limits, if t == end { num_traits::One::one() } else { part })?;
        Ok(state.at_time(t))
    }

    /// The state at a part of the step.
    fn at_part(
        &self,
        memory: &mut Dop853Memory<S::Scalar, N>,
        limits: &Limits<S::Scalar>,
        part: S::Scalar,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>> {
        if let Some(target) = memory.passage {
            return self.on_passage(memory, limits, target, part);
        }
        let end = memory.end.state.t;
        let failed = |cause| MotionError { cause, t: end };
        let mut state = memory.sample(self, part).map_err(failed)?;
        self.system.project_at(self.constants, &mut state, None).map_err(failed)?;
        Ok(state)
    }
}

impl<S, C, const N: usize, const K: usize> Field<S::Scalar, N> for Driven<'_, S, C, N, K>
where
    S: System<N, K>,
    C: Control<S::Scalar, N, K>,
{
    #[inline(always)]
    fn accelerations(&self, t: S::Scalar, q: &[S::Scalar; N], v: &[S::Scalar; N]) -> [S::Scalar; N] {
        let u = self.control.inputs(&State { t, q: *q, v: *v });
        self.system.accelerations_at(self.constants, t, q, v, &u)
    }

    #[inline]
    fn along(&self, state: &State<S::Scalar, N>, change: Slope<S::Scalar, N>) -> Slope<S::Scalar, N> {
        let change = State { t: num_traits::Zero::zero(), q: change.q, v: change.v };
        let State { q, v, .. } = self.system.tangential_at(state, &change);
        Slope { q, v }
    }

    #[cold]
    fn cause(&self, t: S::Scalar, q: &[S::Scalar; N], v: &[S::Scalar; N]) -> Cause {
        diagnose(self.system, self.constants, t, q, v)
    }
}
