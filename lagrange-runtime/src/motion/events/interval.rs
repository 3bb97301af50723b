//! A part of a step, and a guard on it.

use num_traits::Zero;

use super::Guard;
use crate::motion::simulation::Simulation;
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real, larger, smaller};
use crate::system::System;
use crate::system::control::Control;
use crate::system::error::MotionError;
use crate::system::method::Adaptive;
use crate::system::state::State;

/// Rounding errors of a state under constraints, relative to those of a free motion. They are larger because
/// the state is the result of an iteration.
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

    /// Whether the search meets the time at one part before that at another.
    pub fn is_before(&self, theta: R, other: R) -> bool {
        let (t, other) = (self.time(theta), self.time(other));
        if self.is_backward() { t > other } else { t < other }
    }

    /// Whether time runs backward.
    pub fn is_backward(&self) -> bool {
        self.to < self.from
    }
}

/// The larger one of two changes of a number, as a part of it, over which the sensitivity of a guard is
/// measured. The other one is √ε.
const WIDE: f64 = 1.0 / 16.0;

/// The number of states at which an interval is first sampled, its ends included.
pub(super) const POINTS: usize = 5;

/// The scales of the rounding errors of a guard on an interval.
pub(super) struct Sizes<R> {
    /// At the state where it starts, as a state by itself.
    pub start: R,
    /// At the same state, as a result of the step so far.
    pub near: R,
    /// Anywhere on it, times included.
    pub far: R,
    /// The part of it that comes from times.
    pub by_time: R,
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

    /// The guard at a time in the last step; at its end as the motion comes there, before it jumps. If the
    /// state is not known, it is NaN, and `error` holds the reason.
    pub fn at_time(&mut self, t: S::Scalar, error: &mut Option<MotionError<S::Scalar>>) -> S::Scalar {
        let end = M::end(&self.motion.memory);
        if t == end.t {
            return self.at(end);
        }
        match self.motion.peek(t) {
            Ok(state) => self.at(&state),
            Err(reason) => {
                *error = Some(reason);
                S::Scalar::from_f64(f64::NAN)
            }
        }
    }

    /// The scales of the rounding errors of the guard.
    ///
    /// A state is known up to the rounding errors of its components. Their effect on the guard is measured,
    /// since it cannot be read off a function. Times are rounded numbers as well. A jump of the guard does
    /// not count in either.
    pub fn sizes(&self, states: &[State<S::Scalar, N>; POINTS]) -> Sizes<S::Scalar> {
        let (zero, factor) = (
            S::Scalar::zero(),
            S::Scalar::from_f64(if S::CONSTRAINED || S::SWITCHED { PROJECTED } else { 1.0 }),
        );
        let [from, .., to] = states;
        let near = self.rounded(from);
        let far = magnitudes(&near, &self.rounded(to));
        let at_from = self.sensitivity(from, &far, [&magnitudes(from, from), &near, &far]);
        let [at_to] = self.sensitivity(to, &far, [&far]);
        let [start, near, far] = at_from.each(|size| factor * size);

        let (mut largest, mut change) = (zero, zero);
        let mut last = self.at(from);
        for state in states.iter().skip(1) {
            let value = self.at(state);
            let next = (value - last).abs();
            change = larger(change, smaller(largest, next));
            largest = larger(largest, next);
            last = value;
        }
        let part = (to.t - from.t).abs() * S::Scalar::from_f64(1.0 / (POINTS - 1) as f64);
        let by_time = change * larger(from.t.abs(), to.t.abs()) / part;
        let by_time = if by_time.is_finite() { by_time } else { zero };
        Sizes {
            start,
            near: larger(near, self.at(from).abs()),
            far: larger(far, factor * at_to) + by_time,
            by_time,
        }
    }

    /// The summands of a state in the step.
    fn rounded(&self, state: &State<S::Scalar, N>) -> State<S::Scalar, N> {
        let (start, end) = (M::start(&self.motion.memory), M::end(&self.motion.memory));
        let part = ((state.t - start.t) / (end.t - start.t)).abs();
        let part = if part.is_finite() { part } else { S::Scalar::zero() };
        let of = |start: &[S::Scalar; N], end: &[S::Scalar; N]| {
            array(|i| larger(start[i].abs(), ((end[i] - start[i]) * part).abs()))
        };
        let sum = State { t: state.t, q: of(&start.q, &end.q), v: of(&start.v, &end.v) };
        magnitudes(&sum, state)
    }

    /// Σ |∂g/∂x| · (magnitude of x) over all coordinates and velocities, for several sets of magnitudes, by
    /// differences over parts of `scale`.
    fn sensitivity<const W: usize>(
        &self,
        state: &State<S::Scalar, N>,
        scale: &State<S::Scalar, N>,
        magnitudes: [&State<S::Scalar, N>; W],
    ) -> [S::Scalar; W] {
        let zero = S::Scalar::zero();
        let (part, wide) = (S::Scalar::epsilon().sqrt(), S::Scalar::from_f64(WIDE));
        let here = self.at(state);
        let mut sums = [zero; W];
        for i in 0..2 * N {
            let of = |state: &State<S::Scalar, N>| if i < N { state.q[i] } else { state.v[i - N] };
            if of(scale) == zero {
                continue;
            }
            let along = |step: S::Scalar| {
                let [up, down] = [step, -step].each(|step| {
                    let mut moved = *state;
                    let x = if i < N { &mut moved.q[i] } else { &mut moved.v[i - N] };
                    *x += step;
                    ((self.at(&moved) - here) / step).abs()
                });
                let slope = smaller(up, down);
                if slope.is_finite() { slope } else { zero }
            };
            // Beside its extrema a guard shows the summands that it is made of.
            let slope = larger(along(part * of(scale)), along(wide * of(scale)));
            for (sum, magnitudes) in sums.iter_mut().zip(magnitudes) {
                *sum += slope * of(magnitudes);
            }
        }
        sums
    }
}

/// The larger of the components of two states, without signs.
fn magnitudes<R: Ordered, const N: usize>(a: &State<R, N>, b: &State<R, N>) -> State<R, N> {
    let of = |a: &[R; N], b: &[R; N]| array(|i| larger(a[i].abs(), b[i].abs()));
    State { t: b.t, q: of(&a.q, &b.q), v: of(&a.v, &b.v) }
}
