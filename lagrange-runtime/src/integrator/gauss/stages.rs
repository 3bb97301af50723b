//! The equations of one step: the states that follow from accelerations at the stages, and whether a
//! correction has solved the equations.

use core::cmp::Ordering;

use num_traits::{One, Zero};

use crate::integrator::tableau::gauss::Collocation;
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real, extent, larger};
use crate::system::linearized::Linearized;
use crate::system::state::State;

/// A correction of velocities that no longer shrinks is a rounding error if it is below this many ulps of the
/// largest velocity plus the largest coordinate divided by the step.
const ROUNDINGS: f64 = 1e4;

/// A correction of this many ulps of the largest velocity is not worth making. A larger threshold turns the
/// random walk of the energy into a drift.
const REST: f64 = 1e-4;

/// The equations of one step.
pub(super) struct Stages<'a, S: Linearized<N, K>, const N: usize, const K: usize, const STAGES: usize> {
    pub system: &'a S,
    pub constants: &'a S::Constants,
    pub table: &'a Collocation<STAGES>,
    pub from: &'a Start<S::Scalar, N>,
    pub h: S::Scalar,
    pub u: &'a [S::Scalar; K],
    /// h bᵢ, with the sum h to the last bit.
    pub weights: [S::Scalar; STAGES],
    /// aᵢⱼ / bⱼ.
    pub mu: [[S::Scalar; STAGES]; STAGES],
}

/// The start of a step, with its residue of compensated summation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start<R, const N: usize> {
    pub state: State<R, N>,
    pub lost_q: [R; N],
    pub lost_v: [R; N],
}

/// Coordinates and velocities at the stages.
pub(super) struct Places<R, const N: usize, const STAGES: usize> {
    pub q: [[R; N]; STAGES],
    pub v: [[R; N]; STAGES],
}

/// The verdict from the size of a correction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// Only rounding is left.
    Solved,
    /// Corrections shrink.
    Going,
    /// They shrink slowly or grow.
    Slow,
    /// They are not finite.
    Lost,
}

impl<'a, S, const N: usize, const K: usize, const STAGES: usize> Stages<'a, S, N, K, STAGES>
where
    S: Linearized<N, K>,
    S::Scalar: Ordered,
{
    #[inline]
    pub(super) fn new(
        system: &'a S,
        constants: &'a S::Constants,
        table: &'a Collocation<STAGES>,
        from: &'a Start<S::Scalar, N>,
        h: S::Scalar,
        u: &'a [S::Scalar; K],
    ) -> Self {
        let number = S::Scalar::from_f64;
        let mut weights = table.b.each(|b| number(b) * h);
        // The middle weights make up for the rounding of the others.
        let middle = (STAGES - 1) / 2;
        let rest = weights.iter().take(middle).fold(h, |rest, &weight| rest - (weight + weight));
        weights[middle] = if STAGES.is_multiple_of(2) { rest / number(2.0) } else { rest };
        weights[STAGES - 1 - middle] = weights[middle];
        let mu = |i: usize, j: usize| match i.cmp(&j) {
            Ordering::Less => S::Scalar::one() - number(table.below[j][i]),
            Ordering::Equal => number(0.5),
            Ordering::Greater => number(table.below[i][j]),
        };
        let mu = array(|i| array(|j| mu(i, j)));
        Self { system, constants, table, from, h, u, weights, mu }
    }

    /// Judges a correction that changed velocities by at most `change`, so that they are now those of `a`.
    pub(super) fn verdict(
        &self,
        a: &[[S::Scalar; N]; STAGES],
        change: S::Scalar,
        before: &mut Option<S::Scalar>,
    ) -> Verdict {
        let number = S::Scalar::from_f64;
        if !change.is_finite() {
            return Verdict::Lost;
        }
        let speed = self.speed(a);
        let small = change <= number(ROUNDINGS) * S::Scalar::epsilon() * (speed + self.reach());
        let rate = before.replace(change).map(|before| change / before);
        let nothing = number(REST) * S::Scalar::epsilon() * speed;
        match rate {
            _ if change == S::Scalar::zero() => Verdict::Solved,
            Some(rate) if small && (rate > number(0.5) || change * rate < nothing) => Verdict::Solved,
            Some(rate) if !small && rate > number(0.25) => Verdict::Slow,
            Some(_) | None => Verdict::Going,
        }
    }

    /// The velocity that crosses the largest coordinate in one step.
    fn reach(&self) -> S::Scalar {
        let size = self.from.state.q.iter().fold(S::Scalar::zero(), |most, &q| larger(most, extent(q)));
        (size / self.h).abs()
    }

    /// The scale of velocities by which corrections are judged.
    fn speed(&self, a: &[[S::Scalar; N]; STAGES]) -> S::Scalar {
        let mut speed = S::Scalar::zero();
        for a in a {
            for (&a, &v) in a.iter().zip(&self.from.state.v) {
                speed = larger(speed, extent(v) + extent(self.h * a));
            }
        }
        speed
    }

    /// Time at a stage.
    #[inline]
    pub(super) fn time(&self, i: usize) -> S::Scalar {
        self.from.state.t + S::Scalar::from_f64(self.table.c[i]) * self.h
    }

    /// The states at the stages, velocities first.
    #[inline]
    pub(super) fn places(&self, a: &[[S::Scalar; N]; STAGES]) -> Places<S::Scalar, N, STAGES> {
        let Start { state, lost_q, lost_v } = self.from;
        let v = self.reached(&state.v, lost_v, a);
        Places { q: self.reached(&state.q, lost_q, &v), v }
    }

    /// Numbers that grow at the given rates, at the stages.
    #[inline]
    fn reached(
        &self,
        from: &[S::Scalar; N],
        lost: &[S::Scalar; N],
        rates: &[[S::Scalar; N]; STAGES],
    ) -> [[S::Scalar; N]; STAGES] {
        let mut growth = *rates;
        for (growth, &weight) in growth.iter_mut().zip(&self.weights) {
            growth.iter_mut().for_each(|rate| *rate *= weight);
        }
        let mut reached = [*lost; STAGES];
        for (reached, mu) in reached.iter_mut().zip(&self.mu) {
            for (growth, &mu) in growth.iter().zip(mu) {
                for (sum, &growth) in reached.iter_mut().zip(growth) {
                    *sum += mu * growth;
                }
            }
            for (sum, &from) in reached.iter_mut().zip(from) {
                *sum += from;
            }
        }
        reached
    }

    /// The end of the step.
    pub(super) fn end(&self, a: &[[S::Scalar; N]; STAGES]) -> Start<S::Scalar, N> {
        let mut end = *self.from;
        let rates = self.places(a).v;
        for n in 0..N {
            for i in 0..STAGES {
                end.lost_q[n] += self.weights[i] * rates[i][n];
                end.lost_v[n] += self.weights[i] * a[i][n];
            }
            (end.state.q[n], end.lost_q[n]) = sum(end.state.q[n], end.lost_q[n]);
            (end.state.v[n], end.lost_v[n]) = sum(end.state.v[n], end.lost_v[n]);
        }
        end.state.t += self.h;
        end
    }

    /// The average state over the step, and the average accelerations.
    pub(super) fn middle(&self, a: &[[S::Scalar; N]; STAGES]) -> (State<S::Scalar, N>, [S::Scalar; N]) {
        let Places { q, v } = self.places(a);
        let half = S::Scalar::from_f64(0.5) * self.h;
        let t = self.from.state.t + half;
        (State { t, q: self.average(&q), v: self.average(&v) }, self.average(a))
    }

    /// The average over the step of a function with these values at the stages.
    fn average(&self, values: &[[S::Scalar; N]; STAGES]) -> [S::Scalar; N] {
        let share = |i: usize, n: usize| self.weights[i] / self.h * values[i][n];
        array(|n| (0..STAGES).fold(S::Scalar::zero(), |sum, i| sum + share(i, n)))
    }
}

/// a + b, and its rounding error.
#[inline]
fn sum<R: Real>(a: R, b: R) -> (R, R) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}
