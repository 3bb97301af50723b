//! Small systems with a constraint, the multiplier kept beside coordinates and velocities and the
//! accelerations eliminated: index 1.

use super::first_order::FirstOrder;
use super::hand::{G, SliderCrank, SliderCrankTerms};
use super::number::Number;

/// Cartesian pendulum.
#[derive(Clone, Copy)]
pub struct PendulumMultiplier;

impl FirstOrder<5> for PendulumMultiplier {
    const ALGEBRAIC: usize = 1;

    #[inline]
    fn slope<R: Number>(_t: f64, &[x, y, u, v, rod]: &[R; 5], slope: &mut [R; 5]) {
        let (a, b) = (rod * x, rod * y - G);
        *slope = [u, v, a, b, x * a + y * b + u * u + v * v];
    }
}

/// Slider and crank.
#[derive(Clone, Copy)]
pub struct SliderCrankMultiplier;

impl FirstOrder<5> for SliderCrankMultiplier {
    const ALGEBRAIC: usize = 1;

    #[inline]
    fn slope<R: Number>(_t: f64, &[q0, q1, v0, v1, guide]: &[R; 5], slope: &mut [R; 5]) {
        let SliderCrankTerms { mass: [m11, m12, m22], bias, gradient, turning } =
            SliderCrank::terms(&[q0, q1], &[v0, v1]);
        let (f0, f1) = (gradient[0] * guide - bias[0], gradient[1] * guide - bias[1]);
        let inverse = (m11 * m22 - m12 * m12).inverse();
        let (a0, a1) = ((m22 * f0 - m12 * f1) * inverse, (m11 * f1 - m12 * f0) * inverse);
        *slope = [v0, v1, a0, a1, gradient[0] * a0 + gradient[1] * a1 - turning];
    }
}
