//! Dense output of Dormand–Prince 8(5,3): a polynomial of order 7 through a step.
//!
//! Degree 7 in θ = (t − t₀)/h, in nested form around both ends of the step, so that values and slopes join
//! from step to step. Costs three further evaluations, four where the end was corrected after the step, made
//! only if a sample inside the step is asked for. Error O(h⁸) in each step, of the order of the tolerance.
//! Hairer, Nørsett, Wanner, "Solving ODEs I", 2nd ed., II.6 and II.10.

use super::Field;
use super::dop853::Dop853Memory;
use super::slopes::{Slope, combine, reach};
use super::tableau::dop853::{A, C, D, STAGES, STAGES_DENSE};
use crate::number::elements::{Each, array};
use crate::number::real::Ordered;
use crate::system::error::Cause;
use crate::system::state::State;

/// Coefficients of the polynomials of q and v.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dense<R, const N: usize> {
    coefficients: [Slope<R, N>; 7],
}

impl<R: Ordered, const N: usize> Dense<R, N> {
    /// The state at a part of a step of `h` \[s] from `start`.
    #[inline]
    pub(crate) fn at(&self, start: &State<R, N>, h: R, part: R) -> State<R, N> {
        let (from_start, from_end) = (part, R::one() - part);
        let mut state = start.at_time(start.t + part * h);
        let c = &self.coefficients;
        for n in 0..N {
            let (mut q, mut v) = (c[6].q[n], c[6].v[n]);
            for (i, c) in c.iter().enumerate().take(6).rev() {
                let x = if i % 2 == 1 { from_start } else { from_end };
                q = c.q[n] + x * q;
                v = c.v[n] + x * v;
            }
            state.q[n] += from_start * q;
            state.v[n] += from_start * v;
        }
        state
    }

    /// Derivatives of the velocities by the part of the step.
    #[cold]
    pub(crate) fn slopes(&self, part: R) -> [R; N] {
        let (from_start, from_end) = (part, R::one() - part);
        let c = &self.coefficients;
        array(|n| {
            let (mut v, mut slope) = (c[6].v[n], R::zero());
            for (i, c) in c.iter().enumerate().take(6).rev() {
                let (x, direction) = if i % 2 == 1 { (from_start, v) } else { (from_end, -v) };
                (v, slope) = (c.v[n] + x * v, x * slope + direction);
            }
            v + from_start * slope
        })
    }
}

impl<R: Ordered, const N: usize> Dop853Memory<R, N> {
    /// The state at a part of the step, from 0 to 1.
    #[inline]
    pub(crate) fn sample<F>(&mut self, f: &F, part: R) -> Result<State<R, N>, Cause>
    where
        F: Field<R, N>,
    {
        let (start, end) = (&self.start.state, &self.end.state);
        if part == R::one() {
            return Ok(*end);
        }
        if part == R::zero() {
            return Ok(*start);
        }
        let (start, h) = (*start, end.t - start.t);
        Ok(self.polynomial(f)?.at(&start, h, part))
    }

    /// The polynomial of the step.
    #[inline]
    pub(crate) fn polynomial<F>(&mut self, f: &F) -> Result<Dense<R, N>, Cause>
    where
        F: Field<R, N>,
    {
        match self.dense {
            Some(dense) => Ok(dense),
            None => self.interpolate(f),
        }
    }

    /// Forms and keeps the polynomial.
    #[inline]
    fn interpolate<F>(&mut self, f: &F) -> Result<Dense<R, N>, Cause>
    where
        F: Field<R, N>,
    {
        let last = match self.slope {
            Some(slope) => slope,
            // The end has been corrected after the step.
            None => self.slope_at_end(f)?,
        };
        let from = &self.start.state;
        let end = &self.end.state;
        let h = end.t - from.t;
        let zero = Slope { q: [R::zero(); N], v: [R::zero(); N] };
        let mut slopes = [zero; STAGES_DENSE];
        slopes[..STAGES].copy_from_slice(&self.slopes);
        slopes[STAGES] = last;
        macro_rules! stages {
            ($($i:literal)*) => {$(
                let (q, v) = reach(from, h, &combine::<R, N, $i, _, _>(&A[$i], &slopes));
                self.counts.evaluations += 1;
                let a = f.accelerations(from.t + R::from_f64(C[$i]) * h, &q, &v);
                if !a.iter().all(|x| x.is_finite()) {
                    return Err(f.cause(from.t + R::from_f64(C[$i]) * h, &q, &v));
                }
                slopes[$i] = Slope { q: v, v: a };
            )*};
        }
        stages!(13 14 15);
        let mut coefficients = [zero; 7];
        macro_rules! moments {
            ($($i:literal)*) => {$(
                let sum = combine::<R, N, STAGES_DENSE, _, _>(&D[$i], &slopes);
                coefficients[$i + 3] = Slope { q: sum.q.each(|x| h * x), v: sum.v.each(|x| h * x) };
            )*};
        }
        moments!(0 1 2 3);
        let hermite = |a: R, b: R, slope_a: R, slope_b: R| {
            let change = b - a;
            let curve = h * slope_a - change;
            [change, curve, change - h * slope_b - curve]
        };
        let first = &slopes[0];
        for n in 0..N {
            let q = hermite(from.q[n], end.q[n], first.q[n], last.q[n]);
            let v = hermite(from.v[n], end.v[n], first.v[n], last.v[n]);
            for (coefficient, (q, v)) in coefficients.iter_mut().zip(q.into_iter().zip(v)) {
                coefficient.q[n] = q;
                coefficient.v[n] = v;
            }
        }
        let dense = Dense { coefficients };
        self.dense = Some(dense);
        Ok(dense)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_the_derivatives_of_the_velocities() {
        let coefficients = array(|i| Slope { q: [0.0], v: [[0.7, -1.3, 2.1, 0.4, -0.9, 1.7, -0.6][i]] });
        let dense = Dense { coefficients };
        let v = |part: f64| dense.at(&State::new([0.0], [0.3]), 1.0, part).v[0];
        for part in [0.0, 0.2, 0.5, 0.9, 1.0] {
            // Of a polynomial of degree seven, exact up to rounding.
            let h = 0.125;
            let difference = |k: f64| (v(part + k * h) - v(part - k * h)) / (2.0 * k * h);
            let expected = 1.6 * difference(1.0) - 0.8 * difference(2.0) + 8.0 / 35.0 * difference(3.0)
                - difference(4.0) / 35.0;
            let [found] = dense.slopes(part);
            assert!((found - expected).abs() < 1e-11, "{part}: {found} {expected}");
        }
    }
}
