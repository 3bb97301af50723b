//! Narrow functions that a step has passed over.
//!
//! The estimate of the error of a Runge–Kutta step knows the equations at the stages alone. A wall or a pulse
//! that lies between them changes nothing. What such functions depend on shows where they are narrow
//! ([`hidden`](super::super::hidden)), and there the equations are compared with the polynomial of the step.
//! That polynomial costs evaluations, so a first search takes a plainer one.

use super::super::agreement::{Agreement, roundings};
use super::super::dop853::Dop853Memory;
use super::super::hidden::{Hiding, InEquations, Passage, range};
use super::super::slopes::Slope;
use super::super::step_size;
use super::{Driven, Field};
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real, any};
use crate::system::System;
use crate::system::control::Control;
use crate::system::limits::Limits;
use crate::system::state::State;

/// The places inside a step that tell whether anything varies along it. They are not evenly apart, since what
/// turns with the step would look the same there.
const INSIDE: [f64; 2] = [0.29, 0.62];

/// The part of the width of a function up to which a range at a few places shows that it stays as it is.
const STILL: f64 = 0.25;

/// Takes back the last step, for one of half its length.
#[cold]
pub(super) fn halve<R: Ordered, const N: usize>(memory: &mut Dop853Memory<R, N>) {
    let length = R::from_f64(0.5) * (memory.end.state.t - memory.start.state.t).abs();
    memory.counts.accepted -= 1;
    memory.counts.rejected += 1;
    memory.retry(length);
}

impl<S, C, const N: usize, const K: usize> Driven<'_, S, C, N, K>
where
    S: System<N, K>,
    S::Scalar: Ordered,
    C: Control<S::Scalar, N, K>,
{
    /// Whether the last step does not agree with the equations where functions may be narrow. A step of the
    /// system's own method has been compared with them.
    #[inline(never)]
    pub(super) fn misses(&self, memory: &mut Dop853Memory<S::Scalar, N>, limits: &Limits<S::Scalar>) -> bool {
        let zero: S::Scalar = num_traits::Zero::zero();
        let (start, end) = (memory.start.state, memory.end.state);
        let h = end.t - start.t;
        if memory.passage.is_some() || h == zero {
            return false;
        }
        let slope = match memory.slope {
            Some(slope) => slope,
            // The next step tells why the equations have no solution there.
            None => match memory.slope_at_end(self) {
                Ok(slope) => slope,
                Err(_) => return false,
            },
        };
        let curve = Quintic::new([&start, &end], [&memory.slopes[0], &slope], h);
        let [first, second] = INSIDE.map(|part| curve.at(S::Scalar::from_f64(part)));
        if !self.varies(&[start, first, second, end]) {
            return false;
        }
        let (mut is_near, mut strongest) = (false, memory.slopes[0].v);
        let mut none = |_: S::Scalar| {
            is_near = true;
            zero
        };
        self.search(&|part| curve.at(part), &mut none);
        if !is_near {
            return false;
        }
        let Ok(polynomial) = memory.polynomial(self) else { return true };
        let absolute = limits.absolute.unwrap_or(zero) + step_size::smallest();
        let agreement = Agreement { start: &start, span: h, tolerances: [limits.relative, absolute] };
        let state_at = |part| polynomial.at(&start, h, part);
        let accelerations = |state: &State<S::Scalar, N>| self.accelerations(state.t, &state.q, &state.v);
        let has_faults = |strongest: &mut [S::Scalar; N]| {
            let mut faults = |part: S::Scalar| {
                let state = state_at(part);
                let slopes = polynomial.slopes(part).each(|slope| slope / h);
                agreement.faults(&state, [&accelerations(&state), &slopes], strongest)
            };
            self.search(&state_at, &mut faults).is_positive()
        };
        if !has_faults(&mut strongest) {
            return false;
        }
        let here = memory.slopes[0].v;
        roundings(&start, [&here, &here], accelerations, &mut strongest);
        has_faults(&mut strongest)
    }

    /// Whether what some function depends on varies enough along a step.
    fn varies(&self, states: &[State<S::Scalar, N>; 4]) -> bool {
        let mut varies = false;
        self.hiding().along(states, |kind, values| {
            let [range, unit] = range(kind, &values.each(|value| value.part(0)));
            varies |= any(range - S::Scalar::from_f64(STILL) * unit);
        });
        varies
    }

    /// Functions that can be narrow. The error of a step shows kinks of roots.
    fn hiding(&self) -> InEquations<'_, S, C, K> {
        InEquations { system: self.system, control: self.control, roots: false }
    }

    /// Looks where functions may be narrow.
    fn search<P: Fn(S::Scalar) -> State<S::Scalar, N>>(
        &self,
        state_at: &P,
        look: &mut impl FnMut(S::Scalar) -> S::Scalar,
    ) -> S::Scalar {
        Passage { hiding: &self.hiding(), state_at, theta: num_traits::One::one() }.search(look)
    }
}

/// The polynomial of degree five through coordinates, velocities and accelerations at both ends of a step
/// (Hermite).
struct Quintic<R, const N: usize> {
    start: State<R, N>,
    h: R,
    /// Divided differences of the coordinates, from the first order on.
    coefficients: [[R; 5]; N],
}

impl<R: Real, const N: usize> Quintic<R, N> {
    fn new([start, end]: [&State<R, N>; 2], [first, last]: [&Slope<R, N>; 2], h: R) -> Self {
        let half = R::from_f64(0.5);
        let coefficients = array(|n| {
            let change = end.q[n] - start.q[n];
            let [begins, ends] = [h * start.v[n], h * end.v[n]];
            let [bend, last_bend] = [first, last].map(|slope| half * h * h * slope.v[n]);
            // Between the ends, then with one end twice, and so on.
            let [a, b] = [change - begins, ends - change];
            let [third, fourth] = [a - bend, (b - a) - (a - bend)];
            let fifth = ((last_bend - b) - (b - a)) - fourth;
            [begins, bend, third, fourth, fifth]
        });
        Self { start: *start, h, coefficients }
    }

    fn at(&self, part: R) -> State<R, N> {
        let from_end = part - R::one();
        let mut state = self.start.at_time(self.start.t + part * self.h);
        for n in 0..N {
            let [first, second, third, fourth, fifth] = self.coefficients[n];
            let (mut value, mut slope) = (fifth, R::zero());
            for (coefficient, x) in
                [(fourth, from_end), (third, from_end), (second, part), (first, part), (R::zero(), part)]
            {
                (value, slope) = (coefficient + x * value, x * slope + value);
            }
            state.q[n] += value;
            state.v[n] = slope / self.h;
        }
        state
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_of_degree_five_is_its_own_interpolation() {
        let position = |t: f64| 1.0 - 2.0 * t + 0.5 * t.powi(2) - 0.7 * t.powi(3) + 0.3 * t.powi(5);
        let velocity = |t: f64| -2.0 + t - 2.1 * t.powi(2) + 1.5 * t.powi(4);
        let acceleration = |t: f64| 1.0 - 4.2 * t + 6.0 * t.powi(3);
        let [start, end] = [0.4, 2.9].map(|t| State { t, q: [position(t)], v: [velocity(t)] });
        let [first, last] = [start, end].map(|state| Slope { q: state.v, v: [acceleration(state.t)] });
        let curve = Quintic::new([&start, &end], [&first, &last], end.t - start.t);
        for part in [0.0, 0.1, 0.45, 0.8, 1.0] {
            let State { t, q, v } = curve.at(part);
            assert!((q[0] - position(t)).abs() < 1e-12 * position(t).abs().max(1.0));
            assert!((v[0] - velocity(t)).abs() < 1e-12 * velocity(t).abs().max(1.0));
        }
    }
}
