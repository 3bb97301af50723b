//! A step that the system's own method takes where this one cannot.
//!
//! A Runge–Kutta step evaluates accelerations at stages inside it and beside the constraints. Close to a
//! configuration in which constraints depend on each other both make errors that no length removes: rounding
//! errors grow with the reciprocal of the distance, and so does what a stage is off the constraints. Series
//! evaluate at one end of a step alone. So where a smooth system has inputs that do not change within a step,
//! such a step is one of its series.

use super::super::dop853::{Dop853Memory, Ground};
use super::Driven;
use crate::number::real::Ordered;
use crate::system::System;
use crate::system::control::{Control, Held};
use crate::system::error::{Cause, MotionError};
use crate::system::limits::Limits;
use crate::system::method::Adaptive;
use crate::system::state::State;

/// The memory of the system's own method.
type Own<S, const N: usize, const K: usize> =
    <<S as System<N, K>>::Method as Adaptive<S, Held<<S as System<N, K>>::Scalar, K>, N, K>>::Memory;

impl<S, C, const N: usize, const K: usize> Driven<'_, S, C, N, K>
where
    S: System<N, K>,
    S::Scalar: Ordered,
    C: Control<S::Scalar, N, K>,
{
    /// Takes a step from the state where another has failed. False if series cannot help, or if they lead to
    /// a state where the constraints determine less than they did so far: no other step would go on from
    /// there.
    #[cold]
    #[inline(never)]
    pub(super) fn passes(
        &self,
        memory: &mut Dop853Memory<S::Scalar, N>,
        limits: &Limits<S::Scalar>,
        target: S::Scalar,
        Ground { here, mut determined }: Ground<S::Scalar>,
        attempts: &mut u64,
    ) -> bool {
        if here.are_far_apart() {
            return false;
        }
        let start = memory.end.state;
        let Some(own) = self.passage(&start, limits, target, attempts) else { return false };
        let end = *S::Method::end(&own);
        let Ok(Ground { here, .. }) = self.ground(&end) else { return false };
        if !determined.accepts(&here) {
            return false;
        }
        determined.learn(&here);
        memory.pass(end, target);
        memory.ground = Some(Ground { here, determined });
        true
    }

    /// The state at a part of such a step. The step is taken once more for it: it is rare, and a memory for
    /// it would be as large as that of series.
    #[cold]
    #[inline(never)]
    pub(super) fn on_passage(
        &self,
        memory: &Dop853Memory<S::Scalar, N>,
        limits: &Limits<S::Scalar>,
        target: S::Scalar,
        part: S::Scalar,
    ) -> Result<State<S::Scalar, N>, MotionError<S::Scalar>> {
        let start = memory.start.state;
        let lost = MotionError { cause: Cause::StepTooSmall, t: start.t };
        let mut attempts = u64::MAX;
        let mut own = self.passage(&start, limits, target, &mut attempts).ok_or(lost)?;
        let held = Held(self.control.inputs(&start));
        S::Method::within(&mut own, self.system, self.constants, &held, limits, part)
    }

    /// One step of the system's own method.
    fn passage(
        &self,
        start: &State<S::Scalar, N>,
        limits: &Limits<S::Scalar>,
        target: S::Scalar,
        attempts: &mut u64,
    ) -> Option<Own<S, N, K>> {
        if !C::HELD {
            return None;
        }
        let held = Held(self.control.inputs(start));
        let mut own = S::Method::begin(self.system, *start);
        S::Method::pass(&mut own, self.system, self.constants, &held, limits, target, attempts).then_some(own)
    }
}
