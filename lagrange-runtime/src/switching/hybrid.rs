//! [`Hybrid`]: motions whose equations switch, by a method for smooth ones.
//!
//! The method `M` runs in one regime. All guards of the regime are watched over each of its steps, as
//! polynomials where the step is one, else by samples of it; they take no steps of their own. The step is cut
//! at the first zero, and the regime that goes on from there is chosen. The rest of a step behind the cut is
//! never seen.
//!
//! A step in one regime, or its beginning up to the cut, is a *piece* of the motion. Its start and end are
//! limits from inside: at the end of a piece an impact has not happened yet. [`Adaptive::sample`] and
//! [`Adaptive::advance`] give the state after it.

use core::marker::PhantomData;

use super::ended::Ended;
use super::memory::HybridMemory;
use super::run::Run;
use super::scales::Scales;
use super::standstill::is_at_rest;
use super::way::Way;
use super::{Regime, Switching};
use crate::number::real::{Ordered, Real};
use crate::system::System;
use crate::system::control::Held;
use crate::system::error::MotionError;
use crate::system::limits::Limits;
use crate::system::method::{Adaptive, Steps};
use crate::system::state::State;

/// The method for motions whose equations switch. Between switches it is the method `M`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Hybrid<M, const C: usize, const W: usize>(PhantomData<M>);

/// The memory of a motion of `S` by `M`.
pub(super) type Memory<S, M, const N: usize, const K: usize, const C: usize, const W: usize> = HybridMemory<
    <S as Switching<N, K, C, W>>::InRegime,
    <<S as Switching<N, K, C, W>>::InRegime as System<N, K>>::Constants,
    <M as Adaptive<
        <S as Switching<N, K, C, W>>::InRegime,
        Held<<S as System<N, K>>::Scalar, K>,
        N,
        K,
    >>::Memory,
    <S as System<N, K>>::Scalar,
    N,
    C,
    W,
>;

impl<S, M, const N: usize, const K: usize, const C: usize, const W: usize>
    Adaptive<S, Held<S::Scalar, K>, N, K> for Hybrid<M, C, W>
where
    S: Switching<N, K, C, W>,
    M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
{
    type Memory = Memory<S, M, N, K, C, W>;

    fn begin(system: &S, start: State<S::Scalar, N>) -> Self::Memory
    where
        S::Scalar: Ordered,
    {
        const {
            assert!(S::Scalar::DEPTH < 2, "motions through contacts and kinks have first derivatives alone");
        }
        let regime = Regime::open(&S::ROWS);
        let in_regime = system.in_regime(&regime);
        HybridMemory {
            regime,
            in_regime,
            constants: in_regime.constants(),
            inner: M::begin(&in_regime, start),
            start,
            end: start,
            next: None,
            impulses: [num_traits::Zero::zero(); C],
            begun_by: [num_traits::Zero::zero(); C],
            begun_at: start.t,
            switched: start.t,
            told: None,
            tells: false,
            way: Way::with([num_traits::Zero::zero(); N]),
            is_way: false,
            landed: [false; C],
            is_fresh: true,
            is_cut: false,
            stuck: None,
            fired: None,
            begins: [false; C],
            scales: Scales::new(),
            flips: [0; W],
            changes: 0,
            opened: [false; C],
            ended: Ended::none(),
            counts: Steps::default(),
        }
    }

    fn restart(memory: &mut Self::Memory, state: State<S::Scalar, N>)
    where
        S::Scalar: Ordered,
    {
        // At the state that follows a piece the motion begins with the regime that follows, inside a piece
        // with that of the piece.
        if let Some((regime, after)) = memory.next.take()
            && after.t == state.t
        {
            memory.take_impulses();
            memory.regime = regime;
        }
        memory.impulses = [num_traits::Zero::zero(); C];
        (memory.start, memory.end, memory.is_way) = (state, state, false);
        (memory.is_fresh, memory.is_cut, memory.stuck, memory.told) = (true, false, None, None);
    }

    fn begin_anew(memory: &mut Self::Memory, state: State<S::Scalar, N>)
    where
        S::Scalar: Ordered,
    {
        <Self as Adaptive<S, Held<S::Scalar, K>, N, K>>::restart(memory, state);
        // A state on a kink is on the side on which the motion was. Which way friction slipped tells nothing
        // about a body that has been put at rest.
        memory.regime = Regime { kinks: memory.regime.kinks, ..Regime::open(&S::ROWS) };
        memory.begun_by = [num_traits::Zero::zero(); C];
    }

    fn start(memory: &Self::Memory) -> &State<S::Scalar, N> {
        &memory.start
    }

    fn end(memory: &Self::Memory) -> &State<S::Scalar, N> {
        &memory.end
    }

    fn step(
        memory: &mut Self::Memory,
        system: &S,
        _constants: &S::Constants,
        control: &Held<S::Scalar, K>,
        limits: &Limits<S::Scalar>,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> Result<(), MotionError<S::Scalar>>
    where
        S::Scalar: Ordered,
    {
        let mut run = Run::<S, M, N, K, C, W> { system, memory, control, limits };
        run.turn(t);
        run.step(t, attempts)
    }

    fn within(
        memory: &mut Self::Memory,
        _system: &S,
        _constants: &S::Constants,
        control: &Held<S::Scalar, K>,
        limits: &Limits<S::Scalar>,
        part: S::Scalar,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>>
    where
        S::Scalar: Ordered,
    {
        if part == num_traits::Zero::zero() || memory.start.t == memory.end.t {
            return Ok(memory.start);
        }
        if part == num_traits::One::one() {
            return Ok(memory.end);
        }
        let t = memory.start.t + part * (memory.end.t - memory.start.t);
        if memory.is_way {
            return Ok(memory.on_way(t));
        }
        if is_at_rest(&memory.start, &memory.end) {
            return Ok(memory.start.at_time(t));
        }
        // The piece may be the beginning of a step that was cut.
        let whole = M::end(&memory.inner).t - memory.start.t;
        let part = part * ((memory.end.t - memory.start.t) / whole);
        M::within(&mut memory.inner, &memory.in_regime, &memory.constants, control, limits, part)
    }

    fn counts(memory: &Self::Memory) -> Steps {
        sum(memory.counts, M::counts(&memory.inner))
    }

    fn advance(
        memory: &mut Self::Memory,
        system: &S,
        _constants: &S::Constants,
        control: &Held<S::Scalar, K>,
        limits: &Limits<S::Scalar>,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>>
    where
        S::Scalar: Ordered,
    {
        Run::<S, M, N, K, C, W> { system, memory, control, limits }.state_at(t, attempts)
    }

    fn sample(
        memory: &mut Self::Memory,
        system: &S,
        _constants: &S::Constants,
        control: &Held<S::Scalar, K>,
        limits: &Limits<S::Scalar>,
        t: S::Scalar,
        attempts: &mut u64,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>>
    where
        S::Scalar: Ordered,
    {
        Run::<S, M, N, K, C, W> { system, memory, control, limits }.state_at(t, attempts)
    }
}

/// Both counts together.
pub(super) fn sum(a: Steps, b: Steps) -> Steps {
    Steps {
        accepted: a.accepted + b.accepted,
        rejected: a.rejected + b.rejected,
        evaluations: a.evaluations + b.evaluations,
    }
}
