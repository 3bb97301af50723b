//! The equations of the stages, solved by Newton's method with a frozen matrix.
//!
//! With g = M⁻¹ f − a at each stage, a correction Δ of the accelerations solves
//! M Δᵢ − h Σ aᵢⱼ ∂r/∂v Δⱼ − h² Σ (A²)ᵢⱼ ∂r/∂q Δⱼ = M gᵢ, with M and the derivatives of r = f − M a at one state for all
//! stages. (With rᵢ on the right instead of M gᵢ, the change of M over a step would slow the iteration down.) In the
//! eigenvectors of A that is one complex system of size N for each pair of eigenvalues λ:
//! (M − hλ ∂r/∂v − (hλ)² ∂r/∂q) w = M g. The matrix is made anew where corrections shrink too slowly.

use core::cmp::Ordering;

use num_traits::{One, Zero};

use crate::integrator::tableau::gauss::Collocation;
use crate::linear::complex::{Complex, ComplexLu};
use crate::linearized::{Linearization, Linearized};
use crate::real::{Ordered, Real, larger};
use crate::state::State;

/// Corrections that one step may take.
const CORRECTIONS: usize = 40;

/// A correction that no longer shrinks is rounding if it is below this many roundings of what it corrects.
const ROUNDINGS: f64 = 1e4;

/// A correction of this many roundings is not worth making. Anything larger turns the random walk of the energy into
/// a drift.
const REST: f64 = 1e-4;

/// Most pairs of eigenvalues that a method has.
const MODES: usize = 2;

/// The equations of one step.
pub(super) struct Stages<'a, S: Linearized<N, K>, const N: usize, const K: usize, const STAGES: usize> {
    system: &'a S,
    constants: &'a S::Constants,
    table: &'a Collocation<STAGES>,
    from: &'a Start<S::Scalar, N>,
    h: S::Scalar,
    u: &'a [S::Scalar; K],
    /// h bᵢ, with the sum h to the last bit.
    weights: [S::Scalar; STAGES],
    /// aᵢⱼ / bⱼ.
    mu: [[S::Scalar; STAGES]; STAGES],
}

/// Where a step starts, and what rounding took from there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start<R, const N: usize> {
    pub state: State<R, N>,
    pub lost_q: [R; N],
    pub lost_v: [R; N],
}

/// Coordinates and velocities at the stages.
struct Places<R, const N: usize, const STAGES: usize> {
    q: [[R; N]; STAGES],
    v: [[R; N]; STAGES],
}

/// The factored matrices, one for each mode.
struct Factors<R, const N: usize> {
    mass: [[R; N]; N],
    modes: [Option<ComplexLu<R, N>>; MODES],
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
        let mut weights = table.b.map(|b| number(b) * h);
        // Those in the middle make up for the rounding of the others.
        let middle = (STAGES - 1) / 2;
        let rest = weights.iter().take(middle).fold(h, |rest, &weight| rest - (weight + weight));
        weights[middle] = if STAGES.is_multiple_of(2) { rest / number(2.0) } else { rest };
        weights[STAGES - 1 - middle] = weights[middle];
        let mu = |i: usize, j: usize| match i.cmp(&j) {
            Ordering::Less => S::Scalar::one() - number(table.below[j][i]),
            Ordering::Equal => number(0.5),
            Ordering::Greater => number(table.below[i][j]),
        };
        let mu = core::array::from_fn(|i| core::array::from_fn(|j| mu(i, j)));
        Self { system, constants, table, from, h, u, weights, mu }
    }

    /// Accelerations at the stages, from a guess of them and of those at the start; `None` where corrections do not
    /// shrink to rounding.
    pub(super) fn solve(
        &self,
        guess: [[S::Scalar; N]; STAGES],
        start: &[S::Scalar; N],
    ) -> Option<[[S::Scalar; N]; STAGES]> {
        let number = S::Scalar::from_f64;
        let mut a = guess;
        let mut factors = self.factored(&self.from.state, start);
        let mut before: Option<S::Scalar> = None;
        let reach = self.from.state.q.iter().fold(S::Scalar::zero(), |most, &q| larger(most, q.abs()));
        let reach = (reach / self.h).abs();
        for _ in 0..CORRECTIONS {
            let change = self.corrected(&mut a, &factors);
            if !change.is_finite() {
                return None;
            }
            let speed = self.speed(&a);
            let small = change <= number(ROUNDINGS) * S::Scalar::epsilon() * (speed + reach);
            let rate = before.map(|before| change / before);
            let nothing = number(REST) * S::Scalar::epsilon() * speed;
            let settled = |rate: S::Scalar| rate > number(0.5) || change * rate < nothing;
            if change == S::Scalar::zero() || (small && rate.is_some_and(settled)) {
                return Some(a);
            }
            before = Some(change);
            if !small && rate.is_some_and(|rate| rate > number(0.25)) {
                let (middle, accelerations) = self.middle(&a);
                factors = self.factored(&middle, &accelerations);
                before = None;
            }
        }
        None
    }

    /// One correction; returns the largest change of a velocity by it.
    fn corrected(&self, a: &mut [[S::Scalar; N]; STAGES], factors: &Factors<S::Scalar, N>) -> S::Scalar {
        let mut residuals = [[S::Scalar::zero(); N]; STAGES];
        let Places { q, v } = self.places(a);
        for (i, residual) in residuals.iter_mut().enumerate() {
            let found = self.system.accelerations_at(self.constants, self.time(i), &q[i], &v[i], self.u);
            let defect: [_; N] = core::array::from_fn(|n| found[n] - a[i][n]);
            for (residual, mass) in residual.iter_mut().zip(&factors.mass) {
                for (&mass, &defect) in mass.iter().zip(&defect) {
                    *residual += mass * defect;
                }
            }
        }
        let mut change = S::Scalar::zero();
        let mut finite = true;
        let mut total = [[S::Scalar::zero(); N]; STAGES];
        for (mode, factors) in self.table.modes.iter().zip(&factors.modes) {
            let Some(factors) = factors else { continue };
            let mut right = [Complex { re: S::Scalar::zero(), im: S::Scalar::zero() }; N];
            for (weight, residual) in mode.row.iter().zip(&residuals) {
                let weight = Complex::<S::Scalar>::from_f64(*weight);
                for (right, &r) in right.iter_mut().zip(residual) {
                    *right = *right + weight.scaled(r);
                }
            }
            let solution = factors.solve(&right);
            for (weight, total) in mode.column.iter().zip(&mut total) {
                let weight = Complex::<S::Scalar>::from_f64(*weight);
                for (total, &w) in total.iter_mut().zip(&solution) {
                    *total += weight.re * w.re - weight.im * w.im;
                }
            }
        }
        for (a, total) in a.iter_mut().flatten().zip(total.iter().flatten()) {
            *a += *total;
            finite &= a.is_finite();
            change = larger(change, (self.h * *total).abs());
        }
        if finite { change } else { S::Scalar::from_f64(f64::NAN) }
    }

    /// The size of what corrections change.
    fn speed(&self, a: &[[S::Scalar; N]; STAGES]) -> S::Scalar {
        let mut speed = S::Scalar::zero();
        for a in a {
            for (&a, &v) in a.iter().zip(&self.from.state.v) {
                speed = larger(speed, v.abs() + (self.h * a).abs());
            }
        }
        speed
    }

    /// Time at a stage.
    #[inline]
    fn time(&self, i: usize) -> S::Scalar {
        self.from.state.t + S::Scalar::from_f64(self.table.c[i]) * self.h
    }

    /// The states at the stages, velocities first.
    #[inline]
    fn places(&self, a: &[[S::Scalar; N]; STAGES]) -> Places<S::Scalar, N, STAGES> {
        let Start { state, lost_q, lost_v } = self.from;
        let v = self.reached(&state.v, lost_v, a);
        Places { q: self.reached(&state.q, lost_q, &v), v }
    }

    /// What grows at the given rates, at the stages.
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
    fn middle(&self, a: &[[S::Scalar; N]; STAGES]) -> (State<S::Scalar, N>, [S::Scalar; N]) {
        let Places { q, v } = self.places(a);
        let half = S::Scalar::from_f64(0.5) * self.h;
        let t = self.from.state.t + half;
        (State { t, q: self.average(&q), v: self.average(&v) }, self.average(a))
    }

    /// The average over the step of what has these values at the stages.
    fn average(&self, values: &[[S::Scalar; N]; STAGES]) -> [S::Scalar; N] {
        let share = |i: usize, n: usize| self.weights[i] / self.h * values[i][n];
        core::array::from_fn(|n| (0..STAGES).fold(S::Scalar::zero(), |sum, i| sum + share(i, n)))
    }

    /// The matrices of all modes, factored.
    fn factored(&self, at: &State<S::Scalar, N>, a: &[S::Scalar; N]) -> Factors<S::Scalar, N> {
        let Linearization { mass, by_q, by_v } =
            self.system.linearization_at(self.constants, at.t, &at.q, &at.v, a, self.u);
        let mut modes = [None; MODES];
        for (factors, mode) in modes.iter_mut().zip(self.table.modes) {
            let once = Complex::from_f64(mode.value).scaled(self.h);
            let twice = once * once;
            *factors = Some(ComplexLu::factor(core::array::from_fn(|i| {
                core::array::from_fn(|j| {
                    let mass = Complex { re: mass[i][j], im: S::Scalar::zero() };
                    mass - (once.scaled(by_v[i][j]) + twice.scaled(by_q[i][j]))
                })
            })));
        }
        Factors { mass, modes }
    }
}

/// a + b, and what rounding takes from it.
#[inline]
fn sum<R: Real>(a: R, b: R) -> (R, R) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}
