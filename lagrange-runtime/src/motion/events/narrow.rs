//! Narrow functions in a guard that its polynomial on an interval has passed over.

use core::marker::PhantomData;

use super::Guard;
use super::interval::{Interval, Watched};
use crate::integrator::hidden::{Hiding, Passage, states_of};
use crate::motion::roots::Polynomial;
use crate::number::elements::array;
use crate::number::real::{Ordered, Real, larger, smaller};
use crate::system::System;
use crate::system::control::Control;
use crate::system::hidden::Hidden;
use crate::system::method::Adaptive;
use crate::system::state::State;

/// The noises of a polynomial by which it may differ from the guard: each of both has one.
const APART: f64 = 4.0;

/// The functions in a guard.
struct InGuard<'a, S, G, R> {
    system: &'a S,
    guard: &'a G,
    scalar: PhantomData<R>,
}

impl<S, G: Guard<S, R, N>, R, const N: usize> Hiding<R, N> for InGuard<'_, S, G, R> {
    fn along<const PLACES: usize>(
        &self,
        states: &[State<R, N>; PLACES],
        visit: impl FnMut(Hidden, [R; PLACES]),
    ) {
        self.guard.hidden_along(self.system, states, visit);
    }
}

impl<S, C, M, G, const N: usize, const K: usize> Watched<'_, '_, S, C, M, G, N, K>
where
    S: System<N, K>,
    S::Scalar: Ordered,
    C: Control<S::Scalar, N, K>,
    M: Adaptive<S, C, N, K>,
    G: Guard<S, S::Scalar, N>,
{
    /// Whether the guard differs from its polynomial on an interval where functions in it may be narrow.
    pub fn strays(&mut self, interval: Interval<S::Scalar>, polynomial: &Polynomial<S::Scalar>) -> bool {
        let (system, guard) = (self.motion.system, self.guard);
        let state_at = states_of(|theta: S::Scalar| {
            let inside = smaller(larger(theta, num_traits::Zero::zero()), num_traits::One::one());
            let State { t, q, v } = self.motion.peek(interval.time(inside)).ok()?;
            // A search for an extremum may look beyond the interval, where the motion would go on.
            let beyond = (theta - inside) * (interval.to - interval.from);
            Some(State { t: t + beyond, q: array(|i| q[i] + beyond * v[i]), v })
        });
        let bound = S::Scalar::from_f64(APART) * polynomial.noise();
        let hiding = InGuard { system, guard, scalar: PhantomData };
        let theta = num_traits::One::one();
        let strays = Passage { hiding: &hiding, state_at: &state_at, theta }.search(|theta: S::Scalar| {
            let apart = (guard.value(system, &state_at(theta)) - polynomial.value(theta)).abs();
            if apart <= bound { num_traits::Zero::zero() } else { num_traits::One::one() }
        });
        strays.is_positive()
    }
}
