//! Guards that narrow functions take below zero inside a step.
//!
//! A bump in the ground or a step of it may lie between the places at which the polynomial of a gap is
//! compared with the gap, far from where its series starts. What such functions depend on shows where they
//! are narrow ([`hidden`](crate::integrator::hidden)). A guard that has fallen there, but not on its
//! polynomial, ends the piece on the way. The next series starts nearer, and knows more.

use super::Switching;
use super::course::Course;
use super::guards::{Guard, Guards};
use crate::integrator::hidden::{Hiding, Passage, states_of};
use crate::number::real::{Ordered, smaller};
use crate::system::System;
use crate::system::control::Held;
use crate::system::hidden::Hidden;
use crate::system::limits::Limits;
use crate::system::method::Adaptive;
use crate::system::state::State;

/// The functions in the guards of a regime.
pub(super) struct InGuards<
    'a,
    S: Switching<N, K, C, W>,
    const N: usize,
    const K: usize,
    const C: usize,
    const W: usize,
> {
    pub(super) in_regime: &'a S::InRegime,
    pub(super) inputs: &'a [S::Scalar; K],
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Hiding<S::Scalar, N>
    for InGuards<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    fn along<const PLACES: usize>(
        &self,
        states: &[State<S::Scalar, N>; PLACES],
        visit: impl FnMut(Hidden, [S::Scalar; PLACES]),
    ) {
        S::hidden_in(self.in_regime, states, &[*self.inputs; PLACES], visit);
    }
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Guards<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The first part of the step at which a narrow function has taken a guard below zero.
    pub(super) fn fallen_inside<M>(
        &self,
        inner: &mut M::Memory,
        constants: &<S::InRegime as System<N, K>>::Constants,
        control: &Held<S::Scalar, K>,
        limits: &Limits<S::Scalar>,
    ) -> Option<(S::Scalar, Guard)>
    where
        M: Adaptive<S::InRegime, Held<S::Scalar, K>, N, K>,
    {
        let own = if S::NARROW {
            let at = |part| M::within(inner, self.in_regime, constants, control, limits, part).ok();
            self.crossed_inside(at)
        } else {
            None
        };
        let overloaded = M::terms(inner).filter(|_| self.can_be_overloaded()).and_then(|terms| {
            self.overloaded_inside(&Course::new(terms, limits.relative, S::FOLLOWED, M::IS_PACED))
        });
        let falls = own.into_iter().chain(overloaded);
        falls.reduce(|one, other| if other.0 < one.0 { other } else { one })
    }

    /// The same for guards that are not made of reactions. `at` gives the state after a part.
    fn crossed_inside(
        &self,
        at: impl FnMut(S::Scalar) -> Option<State<S::Scalar, N>>,
    ) -> Option<(S::Scalar, Guard)> {
        let state_at = states_of(at);
        let mut first: Option<(S::Scalar, Guard)> = None;
        let hiding: InGuards<'_, S, N, K, C, W> = InGuards { in_regime: self.in_regime, inputs: self.inputs };
        Passage { hiding: &hiding, state_at: &state_at, theta: num_traits::One::one() }.search(
            |part: S::Scalar| {
                let state = state_at(part);
                let mut own = self.all().filter(|&guard| !self.is_of_reactions(guard));
                let fallen = own.find(|&guard| {
                    // The time of an impact is rounded, so that a gap may be below zero where a piece starts.
                    let [before, there] = [self.start, &state].map(|state| self.value(guard, state, state));
                    there.value < smaller(before.value, num_traits::Zero::zero()) - there.error
                });
                if let Some(guard) = fallen
                    && first.is_none_or(|(other, _)| part < other)
                {
                    first = Some((part, guard));
                }
                num_traits::Zero::zero()
            },
        );
        first
    }
}
