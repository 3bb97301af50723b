//! Classical Runge–Kutta, order 4: four evaluations a step, error O(h⁴).
//!
//! Written for q″ = a(t, q, v): the slope of q at a stage is the velocity of that stage, so nothing of length
//! 2N is formed. No error estimate; unstable for stiff systems when h times the fastest rate exceeds about
//! 2.8.

use core::array;

use super::FixedStep;
use super::tableau::rk4::{B, C, REST};
use crate::number::elements::Each;
use crate::number::real::Real;
use crate::system::System;
use crate::system::error::Cause;
use crate::system::state::State;

/// The classical Runge–Kutta method of order 4.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rk4;

impl<S: System<N, K>, const N: usize, const K: usize> FixedStep<S, N, K> for Rk4 {
    type Memory = ();

    #[inline]
    fn begin(_: &S) {}

    #[inline]
    fn step(
        (): &mut (),
        system: &S,
        constants: &S::Constants,
        from: &State<S::Scalar, N>,
        h: S::Scalar,
        u: &[S::Scalar; K],
    ) -> Result<State<S::Scalar, N>, Cause> {
        let mut slope_q = from.v;
        let mut slope_v = system.accelerations_at(constants, from.t, &from.q, &from.v, u);
        // The conversion is outside of the loop, so that the compiler makes it once.
        let [first, weights @ ..]: [_; 4] = array::from_fn(|i| S::Scalar::from_parts(B[i], REST[i]));
        let [_, nodes @ ..] = C.each(S::Scalar::from_f64);
        let mut sum_q = slope_q.each(|x| first * x);
        let mut sum_v = slope_v.each(|x| first * x);
        for (node, weight) in nodes.into_iter().zip(weights) {
            let reach = node * h;
            let mut q = from.q;
            let mut v = from.v;
            for n in 0..N {
                q[n] += reach * slope_q[n];
                v[n] += reach * slope_v[n];
            }
            slope_v = system.accelerations_at(constants, from.t + reach, &q, &v, u);
            slope_q = v;
            for n in 0..N {
                sum_q[n] += weight * slope_q[n];
                sum_v[n] += weight * slope_v[n];
            }
        }
        let mut next = from.at_time(from.t + h);
        for n in 0..N {
            next.q[n] += h * sum_q[n];
            next.v[n] += h * sum_v[n];
        }
        Ok(next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrator::samples::{Driven, distance, driven};

    fn error(steps: u32) -> f64 {
        let mut motion = Driven.stepper::<Rk4>(driven(0.3));
        let h = 2.0 / f64::from(steps);
        for _ in 0..steps {
            motion.step(h, &[]).unwrap();
        }
        distance(motion.state(), &driven(2.3))
    }

    #[test]
    fn rk4_is_of_fourth_order() {
        let order = (error(100) / error(200)).log2();
        assert!((3.8..4.2).contains(&order), "measured order {order}");
    }
}
