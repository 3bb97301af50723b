//! [`Smooth`]: systems whose motion has a Taylor series, and the series.

use crate::real::Real;
use crate::system::System;

/// A system whose motion is analytic, with the recurrences of its Taylor coefficients.
///
/// The macro proves it: no function with a kink or a jump (absolute value, sign, the root of a speed) stands in the
/// equations of motion. Where one does, use [`Dop853`](crate::Dop853) or a fixed-step method.
#[diagnostic::on_unimplemented(
    message = "the motion of `{Self}` has no Taylor series: a function in its equations has a kink or a jump",
    label = "this system is not smooth",
    note = "`stepper::<Rk4>(…)`, `simulate(…)` and `simulate_with::<Dop853>(…)` work for every system"
)]
pub trait Smooth<const N: usize, const K: usize = 0>: System<N, K> {
    /// What depends on parameters alone, computed once per run.
    type JetConstants: Copy + core::fmt::Debug;

    /// The coefficients of all factors of products, for expansions to order `P`.
    type Tables<const P: usize>: Copy + Default + core::fmt::Debug;

    /// Evaluates [`Smooth::JetConstants`].
    fn jet_constants(&self) -> Self::JetConstants;

    /// Taylor coefficients of the motion through a state, of the orders 1 to `orders` ≤ `P`, in time scaled by `h` \[s]:
    /// coefficient k is x⁽ᵏ⁾ hᵏ / k!. The inputs are held. False where the mass matrix has no inverse; coefficients
    /// are not finite where the equations are not.
    #[allow(clippy::too_many_arguments)]
    fn jet_at<const P: usize>(
        &self,
        constants: &Self::JetConstants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
        h: Self::Scalar,
        orders: usize,
        tables: &mut Self::Tables<P>,
        series: &mut Series<Self::Scalar, N, P>,
    ) -> bool;
}

/// Taylor coefficients of coordinates and velocities, of the orders 1 to `P`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Series<R, const N: usize, const P: usize> {
    /// Of the coordinates; coefficient k stands at k − 1.
    pub q: [[R; N]; P],
    /// Of the velocities.
    pub v: [[R; N]; P],
}

impl<R: Real, const N: usize, const P: usize> Default for Series<R, N, P> {
    #[inline]
    fn default() -> Self {
        Self { q: [[R::zero(); N]; P], v: [[R::zero(); N]; P] }
    }
}

impl<R: Real, const N: usize, const P: usize> Series<R, N, P> {
    /// Sets the coefficients of an order from 1 to `P`.
    #[inline(always)]
    pub fn set(&mut self, order: usize, q: [R; N], v: [R; N]) {
        if let (Some(to_q), Some(to_v)) = (self.q.get_mut(order - 1), self.v.get_mut(order - 1)) {
            (*to_q, *to_v) = (q, v);
        }
    }

    /// What coordinates and velocities gain in `theta` units of the scaled time: the terms of the orders 1 to
    /// `orders`, smallest first (Horner).
    #[inline]
    pub fn gain(&self, theta: R, orders: usize) -> ([R; N], [R; N]) {
        let (mut q, mut v) = ([R::zero(); N], [R::zero(); N]);
        for (row_q, row_v) in self.q.iter().zip(&self.v).take(orders).rev() {
            for i in 0..N {
                q[i] = (q[i] + row_q[i]) * theta;
                v[i] = (v[i] + row_v[i]) * theta;
            }
        }
        (q, v)
    }

    /// What coordinates and velocities gain in one unit of the scaled time, all orders, smallest terms first.
    #[inline(always)]
    pub fn sum(&self) -> ([R; N], [R; N]) {
        let (mut q, mut v) = ([R::zero(); N], [R::zero(); N]);
        for (row_q, row_v) in self.q.iter().zip(&self.v).rev() {
            for i in 0..N {
                q[i] += row_q[i];
                v[i] += row_v[i];
            }
        }
        (q, v)
    }
}
