//! A part of a step, and a guard on it.

use num_traits::Zero;

use super::Guard;
use crate::error::MotionError;
use crate::integrator::Adaptive;
use crate::real::{Ordered, Real, larger};
use crate::simulation::{Control, Simulation};
use crate::state::State;
use crate::system::System;

/// How many times larger than those of other motions the roundings of a state under constraints are: it is the
/// result of an iteration.
const PROJECTED: f64 = 16.0;

/// A part of the last step of a motion, from `from` on in the direction of the search.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interval<R> {
    pub from: R,
    pub to: R,
}

impl<R: Ordered> Interval<R> {
    /// The time at a part θ in \[0, 1] of the interval.
    pub fn time(&self, theta: R) -> R {
        let t = self.from + theta * (self.to - self.from);
        // Rounding may lead beyond the end, and beyond the step.
        let beyond = if self.from <= self.to { t > self.to } else { t < self.to };
        if beyond || theta >= R::one() { self.to } else { t }
    }

    /// Whether time runs backward.
    pub fn is_backward(&self) -> bool {
        self.to < self.from
    }
}

/// A motion with one of its guards.
pub(super) struct Watched<'w, 's, S, C, M, G, const N: usize, const K: usize>
where
    S: System<N, K>,
    M: Adaptive<S, C, N, K>,
{
    pub motion: &'w mut Simulation<'s, S, C, M, N, K>,
    pub guard: &'w G,
}

impl<S, C, M, G, const N: usize, const K: usize> Watched<'_, '_, S, C, M, G, N, K>
where
    S: System<N, K>,
    S::Scalar: Ordered,
    C: Control<S::Scalar, N, K>,
    M: Adaptive<S, C, N, K>,
    G: Guard<S, S::Scalar, N>,
{
    /// The guard at a state.
    pub fn at(&self, state: &State<S::Scalar, N>) -> S::Scalar {
        self.guard.value(self.motion.system, state)
    }

    /// The guard at a time in the last step; no number where the state there is not known, for which the reason
    /// is left in `error`.
    pub fn at_time(&mut self, t: S::Scalar, error: &mut Option<MotionError<S::Scalar>>) -> S::Scalar {
        match self.motion.peek(t) {
            Ok(state) => self.at(&state),
            Err(reason) => {
                *error = Some(reason);
                S::Scalar::from_f64(f64::NAN)
            }
        }
    }

    /// What the roundings of the guard are relative to: at the start of an interval alone, and on all of it.
    ///
    /// A state is known up to roundings of its components. What they do to the guard is measured, since a
    /// function that is given as such does not tell. A time is a rounded number as well.
    pub fn sizes(&self, states: &[State<S::Scalar, N>; 3]) -> [S::Scalar; 2] {
        let [from, middle, to] = states;
        let step = M::start(&self.motion.memory);
        let near = magnitudes(step, from);
        let far = magnitudes(&near, to);
        let [first, half, last] = [from, middle, to].map(|state| self.at(state));
        let change = larger((half - first).abs(), (last - half).abs());
        let two = S::Scalar::from_f64(2.0);
        let rate = two * change / (to.t - from.t).abs();
        let by_time = rate * larger(from.t.abs(), to.t.abs());
        let by_time = if by_time.is_finite() { by_time } else { S::Scalar::zero() };
        let factor = S::Scalar::from_f64(if S::CONSTRAINED { PROJECTED } else { 1.0 });
        let at_start = factor * self.sensitivity(from, first, &near);
        let whole =
            larger(factor * self.sensitivity(from, first, &far), factor * self.sensitivity(to, last, &far));
        [larger(at_start, first.abs()) + by_time, whole + by_time]
    }

    /// Σ |∂g/∂x| · (magnitude of x) over all coordinates and velocities, by differences.
    fn sensitivity(
        &self,
        state: &State<S::Scalar, N>,
        value: S::Scalar,
        magnitudes: &State<S::Scalar, N>,
    ) -> S::Scalar {
        let part = S::Scalar::epsilon().sqrt();
        let change = |moved: State<S::Scalar, N>| {
            let change = (self.at(&moved) - value).abs() / part;
            if change.is_finite() { change } else { S::Scalar::zero() }
        };
        let mut sum = S::Scalar::zero();
        for (i, (&q, &v)) in magnitudes.q.iter().zip(&magnitudes.v).enumerate() {
            let mut moved = *state;
            moved.q[i] += part * q;
            sum += change(moved);
            let mut moved = *state;
            moved.v[i] += part * v;
            sum += change(moved);
        }
        sum
    }
}

/// The larger of the components of two states, without signs.
fn magnitudes<R: Ordered, const N: usize>(a: &State<R, N>, b: &State<R, N>) -> State<R, N> {
    let of = |a: &[R; N], b: &[R; N]| core::array::from_fn(|i| larger(a[i].abs(), b[i].abs()));
    State { t: b.t, q: of(&a.q, &b.q), v: of(&a.v, &b.v) }
}
