//! Dormand–Prince 8(5,3) for q″ = a(t, q, v): 12 evaluations a step, error O(h⁸), step size control.
//!
//! Stage i: vᵢ = v + h Σ aᵢⱼ kⱼ, qᵢ = q + h Σ aᵢⱼ vⱼ, kᵢ = a(t + cᵢh, qᵢ, vᵢ), so qᵢ does not wait for kᵢ₋₁.
//! The last evaluation of a step is the first of the next. Time, q and v are summed with compensation; a
//! drift linear in time remains at the finest tolerance (relative energy: 1e-15 a Kepler period at e = 0.1).
//! A stage that fails, or a result that is not finite, is a rejection: the step shrinks until it succeeds or
//! falls below the resolution of time. Hairer, Nørsett, Wanner, "Solving ODEs I", 2nd ed., II.5, II.10.
//! The method is explicit: on stiff systems the steps stay short whatever the tolerance.

use core::cmp::Ordering;

use num_traits::Zero;

use super::Field;
use super::dense::Dense;
use super::landing::Determined;
use super::slopes::{Slope, combine, reach};
use super::step_size;
use super::tableau::dop853::{A, B, B3, C, E5, STAGES};
use crate::linear::Independence;
use crate::number::compensated::add;
use crate::number::real::{Ordered, Real, larger, smaller};
use crate::system::error::{Cause, MotionError};
use crate::system::limits::Limits;
use crate::system::method::Steps;
use crate::system::state::{State, difference};

mod first;
mod tolerance;
mod unavoidable;

use tolerance::{Tried, relative};
use unavoidable::Attempts;

/// The longest step, in parts of the time that a motion has been under way and is asked for. Where no error
/// bounds a step its end would be so far away that roundings there hide what lies on the way.
const BEYOND: f64 = 32.0;

/// A state and its residue of rounding: the exact sum is `state + residue`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point<R, const N: usize> {
    pub state: State<R, N>,
    residue: State<R, N>,
}

/// How well the constraints determine a motion at its present state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ground<R> {
    /// How independent they are there.
    pub here: Independence<R>,
    /// How well they have determined it so far.
    pub determined: Determined<R>,
}

/// The step from `start` to `end`, and the numbers that the next one needs.
#[derive(Clone, Copy, Debug)]
pub struct Dop853Memory<R: Real, const N: usize> {
    pub(crate) start: Point<R, N>,
    pub(crate) end: Point<R, N>,
    /// Slopes of the stages of the step; the first is that at `start`.
    pub(crate) slopes: [Slope<R, N>; STAGES],
    /// Slope at `end`, if known.
    pub(crate) slope: Option<Slope<R, N>>,
    /// Length of the next step; zero if not known.
    length: R,
    /// The time since which nothing has changed the motion from outside.
    begun: R,
    /// Whether the last step met the tolerance only without its [`unavoidable`] errors.
    is_noisy: bool,
    /// Polynomial through the step, once a sample has asked for it.
    pub(crate) dense: Option<Dense<R, N>>,
    pub(crate) counts: Steps,
    /// How well constraints determine the end; `None` without any, and before a first step from a new start.
    pub(crate) ground: Option<Ground<R>>,
    /// The target of a step that series have taken.
    pub(crate) passage: Option<R>,
}

impl<R: Ordered, const N: usize> Dop853Memory<R, N> {
    pub(crate) fn new(state: State<R, N>) -> Self {
        let zero = [R::zero(); N];
        let point = Point { state, residue: State { t: R::zero(), q: zero, v: zero } };
        Self {
            start: point,
            end: point,
            slopes: [Slope { q: zero, v: zero }; STAGES],
            slope: None,
            length: R::zero(),
            begun: state.t,
            is_noisy: false,
            dense: None,
            counts: Steps::default(),
            ground: None,
            passage: None,
        }
    }

    /// Goes on from `state`, as after a change of the accelerations. The length of the next step is kept.
    pub(crate) fn restart(&mut self, state: State<R, N>) {
        *self =
            Self { length: self.length, is_noisy: self.is_noisy, counts: self.counts, ..Self::new(state) };
    }

    /// Replaces the end of the step by a state beside it.
    pub(crate) fn correct(&mut self, state: State<R, N>) {
        let Point { state: end, residue } = &mut self.end;
        for n in 0..N {
            // A residue belongs to the number that was rounded.
            if state.q[n] != end.q[n] {
                (end.q[n], residue.q[n], self.slope) = (state.q[n], R::zero(), None);
            }
            if state.v[n] != end.v[n] {
                (end.v[n], residue.v[n], self.slope) = (state.v[n], R::zero(), None);
            }
        }
    }

    /// Returns to the start of the step.
    pub(crate) fn rewind(&mut self) {
        if self.start.state.t != self.end.state.t {
            self.end = self.start;
            self.slope = if self.passage.is_none() { Some(self.slopes[0]) } else { None };
            self.dense = None;
        }
    }

    /// Records a step from the end of the last one to `end` that series have taken towards a `target`.
    pub(crate) fn pass(&mut self, end: State<R, N>, target: R) {
        let Self { end: start, length, begun, is_noisy, counts, .. } = *self;
        *self = Self { start, length, begun, is_noisy, counts, passage: Some(target), ..Self::new(end) };
        self.counts.accepted += 1;
    }

    /// Returns to the start of the step, to take another of this `length` \[s].
    pub(crate) fn retry(&mut self, length: R) {
        self.rewind();
        self.length = length;
    }

    /// The length of the next step \[s]; zero if not known.
    pub(crate) fn length(&self) -> R {
        self.length
    }

    /// Whether `t` lies in the step, ends included.
    pub(crate) fn covers(&self, t: R) -> bool {
        let (a, b) = (self.start.state.t, self.end.state.t);
        (a <= t && t <= b) || (b <= t && t <= a)
    }

    /// Whether `t` lies at or beyond the end of the step in its direction; true for a step of no length.
    pub(crate) fn ahead(&self, t: R) -> bool {
        let (a, b) = (self.start.state.t, self.end.state.t);
        if a <= b { t >= b || a == b } else { t <= b }
    }

    /// The shortest step that can be told from none at time `t` \[s].
    pub(crate) fn resolution(t: R) -> R {
        R::from_f64(4.0) * R::epsilon() * t.abs() + step_size::smallest::<R>()
    }

    /// One step from `end` towards `target`, which differs from it; with `land`, never beyond `target` and,
    /// in the last step, exactly on it. `attempts` counts down.
    #[inline]
    pub(crate) fn step<F>(
        &mut self,
        f: &F,
        limits: &Limits<R>,
        target: R,
        land: bool,
        attempts: &mut u64,
    ) -> Result<(), MotionError<R>>
    where
        F: Field<R, N>,
    {
        let t = self.end.state.t;
        // The next attempt from here, perhaps with other inputs, starts without the lengths that failed.
        let fail = |motion: &mut Self, cause| {
            motion.length = R::zero();
            Err(MotionError { cause, t })
        };
        let slope = match self.slope {
            Some(slope) => slope,
            None => match self.slope_at_end(f) {
                Ok(slope) => slope,
                Err(cause) => return fail(self, cause),
            },
        };
        self.start = self.end;
        self.slopes[0] = slope;
        (self.dense, self.passage) = (None, None);
        let left = (target - t) - self.end.residue.t;
        let direction = left.signum();
        if self.length == R::zero() {
            self.length = self.first_length(f, limits, &slope, direction);
        }
        // Two steps of half the rest are better than a full one and a crumb.
        let half = R::from_f64(0.5) * left.abs();
        let known = left.abs() + (t - self.begun).abs();
        let natural = smaller(limits.clip(self.length), R::from_f64(BEYOND) * known);
        let mut length = natural;
        if land && length < left.abs() && length > half {
            length = half;
        }
        let mut cause = Cause::StepTooSmall;
        let mut repeated = false;
        let resolution = Self::resolution(t);
        // A step this short hardly changes a number. Errors that do not fall with it are those of jumps.
        let mut attempts_here = Attempts::new((R::from_f64(3.0) * resolution).largest(), relative(limits));
        loop {
            let last = land && R::from_f64(1.01) * length >= left.abs();
            let h = if last { left } else { direction * length };
            if !last && length.partial_cmp(&resolution) != Some(Ordering::Greater) {
                return fail(self, cause);
            }
            if *attempts == 0 {
                return fail(self, Cause::TooManySteps);
            }
            *attempts -= 1;
            let factor = match self.attempt(f, limits, h, &mut attempts_here) {
                Ok(error) if error <= R::one() => {
                    if last {
                        self.end.state.t = target;
                        self.end.residue.t = R::zero();
                    }
                    self.counts.accepted += 1;
                    let next = h.abs() * step_size::factor(error);
                    self.length = if repeated {
                        smaller(next, length)
                    } else {
                        // A step that `target` has cut short is no reason for shorter ones.
                        larger(next, if h.abs() < natural { natural } else { next })
                    };
                    return Ok(());
                }
                Ok(error) => {
                    cause = Cause::StepTooSmall;
                    smaller(step_size::factor(error), R::from_f64(0.9))
                }
                Err(refused) => {
                    cause = refused;
                    R::from_f64(0.25)
                }
            };
            (length, repeated) = (h.abs() * factor, true);
            self.length = length;
            self.counts.rejected += 1;
        }
    }

    /// Takes a step of `h` \[s] from `end`. Returns its error in tolerances, if that is at most 1.
    #[cold]
    pub(crate) fn stride<F>(&mut self, f: &F, limits: &Limits<R>, h: R) -> Option<R>
    where
        F: Field<R, N>,
    {
        let slope = match self.slope {
            Some(slope) => slope,
            None => self.slope_at_end(f).ok()?,
        };
        (self.start, self.slopes[0]) = (self.end, slope);
        (self.dense, self.passage) = (None, None);
        let mut attempts = Attempts::new(R::Lane::zero(), relative(limits));
        self.attempt(f, limits, h, &mut attempts).ok().filter(|&error| error <= R::one())
    }

    /// Tries a step of `h` from `start` and moves `end` if its error is within tolerance (at most 1).
    #[inline]
    fn attempt<F>(
        &mut self,
        f: &F,
        limits: &Limits<R>,
        h: R,
        attempts: &mut Attempts<R::Lane, N>,
    ) -> Result<R, Cause>
    where
        F: Field<R, N>,
    {
        let from = &self.start.state;
        let slopes = &mut self.slopes;
        macro_rules! stages {
            ($($i:literal)*) => {$(
                let sum = combine::<R, N, $i, _, _>(&A[$i], slopes);
                let (q, v) = reach(from, h, &sum);
                self.counts.evaluations += 1;
                let a = f.accelerations(from.t + R::from_f64(C[$i]) * h, &q, &v);
                slopes[$i] = Slope { q: v, v: a };
            )*};
        }
        stages!(1 2 3 4 5 6 7 8 9 10 11);

        let mean = combine::<R, N, STAGES, _, _>(&B, slopes);
        let mut fifth = combine::<R, N, STAGES, _, _>(&E5, slopes);
        let embedded = combine::<R, N, STAGES, _, _>(&B3, slopes);
        let mut third = Slope { q: difference(&mean.q, &embedded.q), v: difference(&mean.v, &embedded.v) };
        let mut end = self.start;
        for n in 0..N {
            (end.state.q[n], end.residue.q[n]) = add(from.q[n], end.residue.q[n], h * mean.q[n]);
            (end.state.v[n], end.residue.v[n]) = add(from.v[n], end.residue.v[n], h * mean.v[n]);
        }
        // Beside a configuration in which constraints depend on each other, rounding errors make large
        // accelerations across them.
        if self.ground.is_some_and(|ground| !ground.here.are_far_apart()) {
            for change in [&mut fifth, &mut third] {
                *change = f.along(&end.state, *change);
            }
        }
        let tried = Tried { from, to: &end.state, slope: &slopes[0], h, estimates: [&fifth, &third] };
        let mut error = tried.error(limits, &[[R::Lane::zero(); N]; 2]);
        let mut is_noisy = false;
        // Of a smooth motion a shorter attempt is enough, without a search for another cause.
        if error > R::one() && error.is_finite() && (self.is_noisy || attempts.any_refused()) {
            is_noisy = true;
            error = attempts.avoidable_error(f, limits, &tried, &mut self.counts);
        }
        if !error.is_finite() {
            return Err(self.failed_stage(f, h));
        }
        if error <= R::one() {
            (end.state.t, end.residue.t) = add(from.t, end.residue.t, h);
            let (q, v) = (&end.state.q, &end.state.v);
            self.counts.evaluations += 1;
            let a = f.accelerations(from.t + h, q, v);
            if !(end.state.is_finite() && a.iter().all(|x| x.is_finite())) {
                return Err(f.cause(from.t + h, q, v));
            }
            self.slope = Some(Slope { q: *v, v: a });
            self.end = end;
            self.is_noisy = is_noisy;
        } else {
            attempts.note(&tried);
        }
        Ok(error)
    }

    /// Why a step of `h` was not finite: the cause at its first stage without finite accelerations.
    #[cold]
    fn failed_stage<F: Field<R, N>>(&self, f: &F, h: R) -> Cause {
        let from = &self.start.state;
        for ((weights, node), slope) in A.iter().zip(C).zip(&self.slopes) {
            if slope.v.iter().all(|x| x.is_finite()) {
                continue;
            }
            let (mut q, mut v) = (from.q, from.v);
            for (weight, earlier) in weights.iter().zip(&self.slopes) {
                let weight = h * R::from_f64(*weight);
                // Weights of later stages are zero, but their slopes may be NaN.
                if weight != R::zero() {
                    for n in 0..N {
                        q[n] += weight * earlier.q[n];
                        v[n] += weight * earlier.v[n];
                    }
                }
            }
            return f.cause(from.t + R::from_f64(node) * h, &q, &v);
        }
        Cause::NotFinite
    }

    /// Evaluates the slope at `end`, and keeps it.
    #[cold]
    pub(super) fn slope_at_end<F>(&mut self, f: &F) -> Result<Slope<R, N>, Cause>
    where
        F: Field<R, N>,
    {
        let state = &self.end.state;
        if !state.is_finite() {
            return Err(Cause::NotFinite);
        }
        self.counts.evaluations += 1;
        let a = f.accelerations(state.t, &state.q, &state.v);
        if !a.iter().all(|x| x.is_finite()) {
            return Err(f.cause(state.t, &state.q, &state.v));
        }
        let slope = Slope { q: state.v, v: a };
        self.slope = Some(slope);
        Ok(slope)
    }

    /// Length of the first step, by a probe in the direction of motion.
    #[cold]
    fn first_length<F>(&mut self, f: &F, limits: &Limits<R>, slope: &Slope<R, N>, direction: R) -> R
    where
        F: Field<R, N>,
    {
        let from = &self.end.state;
        // A guess below the resolution of time is wrong, and tells nothing about the motion.
        let least = R::from_f64(2.0) * Self::resolution(from.t);
        let probe = limits.clip(larger(first::probe(from, slope), least));
        let (q, v) = reach(from, direction * probe, slope);
        self.counts.evaluations += 1;
        let a = f.accelerations(from.t + direction * probe, &q, &v);
        let length = first::length(from, slope, &difference(&a, &slope.v), probe, relative(limits));
        // A probe into a singularity gives no number; the control takes it from there.
        if length.is_finite() { limits.clip(larger(length, least)) } else { probe }
    }
}

#[cfg(test)]
mod tests;
