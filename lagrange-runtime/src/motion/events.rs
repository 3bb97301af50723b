//! Events: the zeros of functions along a motion, with the exact state at each.
//!
//! A [`Guard`] is a function of the state. [`Simulation::advance_to_event`] moves to its next zero,
//! [`Simulation::events`] visits one after the other, and `advance_to_event_of` and `events_of` do the same
//! with several guards at once. No zero is found by comparing the signs of samples: between the ends of a
//! step the method has a polynomial of the motion, the guard along it is interpolated until only rounding
//! errors are left, and the zeros of the interpolant are isolated (see the module `roots`). So two zeros
//! within one step are two events, a guard that touches zero is seen, and no step is ever shortened for an
//! event.
//!
//! *What counts.* Zero means zero within the rounding errors of the guard: those of its value, of the state
//! at which it is evaluated and of the time itself. A zero where a search begins is not reported, because the
//! event that led there has been reported before. A zero exactly at the end of a search is reported. A guard
//! that is zero throughout has no events.
//!
//! *Kinks and jumps.* A guard need not be smooth. Where no polynomial fits it, the search takes ever shorter
//! parts of the step, down to the resolution of time. A jump across zero counts as a crossing, also if the
//! motion itself jumps, as in an impact. The tip of a kink that only touches zero may be missed.

use crate::motion::simulation::Simulation;
use crate::number::real::Ordered;
use crate::system::System;
use crate::system::control::Control;
use crate::system::error::MotionError;
use crate::system::hidden::Hidden;
use crate::system::method::Adaptive;
use crate::system::state::State;

mod interval;
mod kinks;
mod narrow;
mod search;
mod track;

use search::Search;

/// A function of the state whose zeros are events.
///
/// Closures are guards, and so are the events of a description, by name. A closure names the type of its
/// argument: `|state: &State<f64, 2>| state.q[0]`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no guard of `{S}`",
    label = "not a function of its state",
    note = "a closure names the type of its argument: `|state: &State<f64, 2>| state.q[0]`"
)]
pub trait Guard<S: ?Sized, R, const N: usize> {
    /// The value whose zeros matter. It must depend on the state alone.
    fn value(&self, system: &S, state: &State<R, N>) -> R;

    /// Whether a function in it can hide from a step.
    #[doc(hidden)]
    const NARROW: bool = false;

    /// Visits such functions as [`System::hidden_along`] does.
    #[doc(hidden)]
    fn hidden_along<const PLACES: usize>(
        &self,
        _system: &S,
        _states: &[State<R, N>; PLACES],
        _visit: impl FnMut(Hidden, [R; PLACES]),
    ) {
    }

    /// One of the functions at the zeros of which it has a kink or a jump; `None` if there are no more.
    #[doc(hidden)]
    fn kink(&self, _system: &S, _state: &State<R, N>, _kink: usize) -> Option<R> {
        None
    }
}

impl<F, S: ?Sized, R, const N: usize> Guard<S, R, N> for F
where
    F: Fn(&State<R, N>) -> R,
{
    #[inline]
    fn value(&self, _: &S, state: &State<R, N>) -> R {
        self(state)
    }
}

/// The kind of a zero, as time grows: a motion backward in time meets the same kind.
///
/// The pieces before and after an impact have their own zeros. So the gap of a contact that bounces has two
/// events whose times differ by an ulp at most: it falls with the velocity before the impact and rises with
/// the one after it. A gap that stays closed only falls. `.falling()` selects one event for each impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// It goes from below to above as time grows, also in a motion that runs backward.
    Rising,
    /// It goes from above to below.
    Falling,
    /// It reaches zero and stays on the side it came from.
    Touching,
}

/// A zero of a guard along a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event<R, const N: usize> {
    /// The state there, with the time.
    pub state: State<R, N>,
    /// How the guard goes through zero there.
    pub crossing: Crossing,
    /// The index of the guard among several.
    pub index: usize,
}

impl<S, C, M, const N: usize, const K: usize> Simulation<'_, S, C, M, N, K>
where
    S: System<N, K>,
    S::Scalar: Ordered,
    C: Control<S::Scalar, N, K>,
    M: Adaptive<S, C, N, K>,
{
    /// Moves to the next zero of `guard`. If none comes before time `until` \[s], moves there and returns
    /// `None`.
    ///
    /// Searches backward if `until` lies before the present time.
    ///
    /// # Errors
    /// As [`Simulation::advance_to`], and [`Cause::NotFinite`](crate::Cause) with the time where the guard is
    /// infinite or no number, [`Cause::StepTooSmall`](crate::Cause) where it jumps again and again within the
    /// resolution of time. The state is the last one before that.
    #[inline]
    pub fn advance_to_event<G>(
        &mut self,
        guard: G,
        until: S::Scalar,
    ) -> Result<Option<Event<S::Scalar, N>>, MotionError<S::Scalar>>
    where
        G: Guard<S, S::Scalar, N>,
    {
        self.events(guard, until).next().transpose()
    }

    /// Moves to the next zero of any of several guards; see [`Simulation::advance_to_event`].
    ///
    /// Of several guards that are zero at the same time only the first is reported. To see all of them, use
    /// [`Simulation::events_of`].
    ///
    /// # Errors
    /// As [`Simulation::advance_to_event`].
    #[inline]
    pub fn advance_to_event_of<G, const E: usize>(
        &mut self,
        guards: [G; E],
        until: S::Scalar,
    ) -> Result<Option<Event<S::Scalar, N>>, MotionError<S::Scalar>>
    where
        G: Guard<S, S::Scalar, N>,
    {
        self.events_of(guards, until).next().transpose()
    }

    /// An iterator over the zeros of `guard` up to time `until` \[s].
    ///
    /// It moves the motion: to each event as that is returned, and to `until` at the end.
    #[inline]
    pub fn events<G>(&mut self, guard: G, until: S::Scalar) -> Events<'_, Self, G, S::Scalar, N, 1>
    where
        G: Guard<S, S::Scalar, N>,
    {
        self.events_of([guard], until)
    }

    /// An iterator over the zeros of several guards up to time `until` \[s], in the order of time.
    ///
    /// Simultaneous zeros come one after the other, in the order of the guards. Where the motion jumps, as in
    /// an impact, those of the motion before the jump come first.
    #[inline]
    pub fn events_of<G, const E: usize>(
        &mut self,
        guards: [G; E],
        until: S::Scalar,
    ) -> Events<'_, Self, G, S::Scalar, N, E>
    where
        G: Guard<S, S::Scalar, N>,
    {
        let search = Search::new(*self.state(), until);
        Events { motion: self, guards, search, only: None }
    }
}

/// The events of a motion; see [`Simulation::events`]. It ends at its last time, or after an error.
#[derive(Debug)]
pub struct Events<'m, M, G, R, const N: usize, const E: usize> {
    motion: &'m mut M,
    guards: [G; E],
    search: Search<R, N, E>,
    only: Option<Crossing>,
}

impl<M, G, R, const N: usize, const E: usize> Events<'_, M, G, R, N, E> {
    /// Only those at which a guard goes from below to above as time grows.
    #[inline]
    #[must_use]
    pub fn rising(self) -> Self {
        Self { only: Some(Crossing::Rising), ..self }
    }

    /// Only those at which a guard goes from above to below as time grows.
    #[inline]
    #[must_use]
    pub fn falling(self) -> Self {
        Self { only: Some(Crossing::Falling), ..self }
    }

    /// Only those at which a guard reaches zero and returns.
    #[inline]
    #[must_use]
    pub fn touching(self) -> Self {
        Self { only: Some(Crossing::Touching), ..self }
    }
}

impl<S, C, M, G, const N: usize, const K: usize, const E: usize> Iterator
    for Events<'_, Simulation<'_, S, C, M, N, K>, G, S::Scalar, N, E>
where
    S: System<N, K>,
    S::Scalar: Ordered,
    C: Control<S::Scalar, N, K>,
    M: Adaptive<S, C, N, K>,
    G: Guard<S, S::Scalar, N>,
{
    type Item = Result<Event<S::Scalar, N>, MotionError<S::Scalar>>;

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        self.search.next(self.motion, &self.guards, self.only).transpose()
    }
}

impl<S, C, M, G, const N: usize, const K: usize, const E: usize> core::iter::FusedIterator
    for Events<'_, Simulation<'_, S, C, M, N, K>, G, S::Scalar, N, E>
where
    S: System<N, K>,
    S::Scalar: Ordered,
    C: Control<S::Scalar, N, K>,
    M: Adaptive<S, C, N, K>,
    G: Guard<S, S::Scalar, N>,
{
}

#[cfg(test)]
mod tests;
