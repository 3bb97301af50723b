//! Fixed steps through switches: [`Jet`](crate::Jet) of a system with contacts, friction or kinks.
//!
//! A step is one Taylor series, or a few where a slip in two directions has just begun or constraints ask for
//! shorter ones. If a guard falls through zero on it, the step is cut there, the next regime is chosen, and a
//! series of that regime goes on to the end of the step. So the state after a step belongs to one regime, and
//! its accuracy is that of the order.

use super::guards::{Guard, Guards};
use super::place::Event;
use super::run::Run;
use super::scene::{above, entry, product, rounding};
use super::since::{InRegimeSince, Since};
use super::turning::pairs;
use super::way::is_beyond_rounding;
use super::{Hybrid, HybridMemory, Regime, Switching};
use crate::integrator::jets::JetsMemory;
use crate::integrator::jets::paced::Paced;
use crate::integrator::{Jet, Limits};
use crate::number::elements::Each;
use crate::number::real::{Ordered, Real};
use crate::system::System;
use crate::system::control::Held;
use crate::system::error::Cause;
use crate::system::method::{Adaptive, FixedStep};
use crate::system::smooth::Smooth;
use crate::system::state::State;

/// The most parts of one step: series that are tried, changes of regime without time between them, and
/// further parts of a series on which a guard is examined.
const PIECES: u64 = 256;

/// The memory of fixed steps through switches.
#[derive(Clone, Copy, Debug)]
pub struct StepsMemory<H, R, const K: usize> {
    motion: H,
    /// The length \[s] of the step before, and the inputs that were held in it. `None` before the first step
    /// and after one that was not taken.
    last: Option<(R, [R; K])>,
}

/// The memory of a motion of `S` in pieces of order `ORDER`, whose time is counted from the start of the last
/// step on.
type Motion<S, const N: usize, const K: usize, const C: usize, const W: usize, const ORDER: usize> =
    HybridMemory<
        InRegimeSince<<S as Switching<N, K, C, W>>::InRegime, <S as System<N, K>>::Scalar>,
        <<S as Switching<N, K, C, W>>::InRegime as System<N, K>>::Constants,
        JetsMemory<
            <<S as Switching<N, K, C, W>>::InRegime as Smooth<N, K>>::JetConstants,
            <<S as Switching<N, K, C, W>>::InRegime as Smooth<N, K>>::Tables<ORDER>,
            <S as System<N, K>>::Scalar,
            N,
            ORDER,
        >,
        <S as System<N, K>>::Scalar,
        N,
        C,
        W,
    >;

impl<S, const ORDER: usize, const N: usize, const K: usize, const C: usize, const W: usize> FixedStep<S, N, K>
    for Hybrid<Jet<ORDER>, C, W>
where
    S: Switching<N, K, C, W>,
    S::InRegime: Smooth<N, K>,
    S::Scalar: Ordered,
{
    type Memory = StepsMemory<Motion<S, N, K, C, W, ORDER>, S::Scalar, K>;
    const SWITCHES: bool = true;

    fn begin(system: &S) -> Self::Memory {
        let zero = num_traits::Zero::zero();
        let system = Since { system, instant: zero };
        let start = State { t: zero, q: [zero; N], v: [zero; N] };
        StepsMemory {
            motion: <Hybrid<Paced<ORDER>, C, W> as Adaptive<_, _, N, K>>::begin(&system, start),
            last: None,
        }
    }

    fn step(
        memory: &mut Self::Memory,
        system: &S,
        _constants: &S::Constants,
        from: &State<S::Scalar, N>,
        h: S::Scalar,
        u: &[S::Scalar; K],
    ) -> Result<State<S::Scalar, N>, Cause> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let system = Since { system, instant: from.t };
        let StepsMemory { motion, last } = memory;
        let goes_on = last.filter(|(length, inputs)| inputs == u && (*length > zero) == (h > zero));
        motion.count_from(last.map_or(zero, |(length, _)| length));
        if goes_on.is_none() {
            let here = from.at_time(zero);
            <Hybrid<Paced<ORDER>, C, W> as Adaptive<Since<'_, S, S::Scalar>, _, N, K>>::restart(motion, here);
        }
        motion.in_regime.instant = from.t;
        *last = None;
        let regime: Regime<S::Scalar, C, W> = *motion.regime();
        let (control, limits) = (Held(*u), Limits::new());
        let mut run = Run::<_, Paced<ORDER>, N, K, C, W> {
            system: &system,
            memory: motion,
            control: &control,
            limits: &limits,
        };
        match run.state_at(h, &mut { PIECES }) {
            Ok(state) => {
                *last = Some((h, *u));
                Ok(state.at_time(from.t + h))
            }
            Err(error) => {
                // The step is not taken.
                (motion.regime, motion.next) = (regime, None);
                // No limit of a caller's: a step has so many parts.
                Err(if error.cause == Cause::TooManySteps { Cause::StepTooLong } else { error.cause })
            }
        }
    }
}

impl<S, M, const N: usize, const K: usize, const C: usize, const W: usize> Run<'_, S, M, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    /// Changes the regime where a reaction has passed its limit between two steps, and says whether it has.
    ///
    /// Series of low order have few orders of reactions or none but their values at the start, so that no
    /// guard falls on a step. What the step before has left tells.
    pub(super) fn catches_up(&mut self) -> Result<bool, Cause> {
        let memory = &*self.memory;
        let (here, inputs) = (memory.end, &self.control.0);
        // Where a regime begins, it has been decided that its reactions are within their limits.
        if !is_beyond_rounding(memory.switched, here.t) {
            return Ok(false);
        }
        let in_regime = &memory.in_regime;
        let guards = Guards::new(self.system, in_regime, &memory.regime, inputs, &here, false);
        if !guards.has_reactions() {
            return Ok(false);
        }
        let values = guards.guards_at(&here, &here);
        // No smaller excess decides about a regime.
        let least = rounding::<S::Scalar>().sqrt();
        let exceeds = |guard: &Guard| match guard {
            Guard::Row(row) if guards.is_of_reactions(*guard) => {
                let excess = -(values.get(*guard).value + least * guards.scale(*row, &memory.scales));
                excess.is_positive()
            }
            _ => false,
        };
        let Some(guard) = guards.all().find(exceeds) else { return Ok(false) };
        let mut event = Event { guard: Some(guard), ..Event::cut(here) };
        let State { t, q, v } = here;
        event.accelerations = in_regime.accelerations_at(&memory.constants, t, &q, &v, inputs);
        self.switch(guard, &mut event)?;
        Ok(true)
    }

    /// The time, up to `t` \[s], to which a series can lead whose length nothing else controls. A slip in two
    /// directions that has just begun is slow, so that its direction, and with it friction, may turn within
    /// the time in which the slip doubles. The series converges no further.
    pub(super) fn steady(&self, t: S::Scalar) -> S::Scalar {
        let memory = &*self.memory;
        let State { t: now, q, v } = memory.end;
        let zero: S::Scalar = num_traits::Zero::zero();
        let slips = |row: usize| entry(&memory.regime.slip, row) != zero;
        if !pairs(&S::ROWS).any(|[row, _]| slips(row)) {
            return t;
        }
        let inputs = &self.control.0;
        let a = memory.in_regime.accelerations_at(&memory.constants, now, &q, &v, inputs);
        let own = self.system.laws_at(now, &q, &v, inputs).rows.rates;
        let all = Regime { active: [true; C], kinks: memory.regime.kinks, ..Regime::open(&S::ROWS) };
        let Some(rows) = S::rows_in(&self.system.in_regime(&all), now, &q, &v, inputs) else { return t };
        // The rate of a slip: A a − γ.
        let along = |row: usize| rows.gradients.get(row).map_or(zero, |gradient| product(gradient, &a));
        let rate = |row: usize| along(row) - entry(&rows.gamma, row);
        let mut least = (t - now).abs();
        for [row, other] in pairs(&S::ROWS).filter(|[row, _]| slips(*row)) {
            let [x, y] = [row, other].each(|row| entry(&own, row));
            let [gain_x, gain_y] = [row, other].each(rate);
            let (slip, gain) = (x.hypot(y), gain_x.hypot(gain_y));
            // A slip that comes to rest does so in a straight line, on which the series goes on beyond it.
            let falls = !(x * gain_x + y * gain_y).is_positive();
            let within = if falls { slip + slip } else { slip };
            if slip.is_positive() && above(least * gain, within) {
                least = within / gain;
            }
        }
        if above((t - now).abs(), least) { now + if above(t, now) { least } else { -least } } else { t }
    }
}
