//! Chains of rods in Cartesian coordinates by hand: multipliers are the tensions of the rods.
//!
//! With d the vector along a rod and T its tension over its length, each mass has a = g − Tᵢ dᵢ + Tᵢ₊₁ dᵢ₊₁,
//! and each rod d·d̈ + ḋ·ḋ = 0: tridiagonal equations for the tensions.

#![allow(clippy::needless_range_loop, reason = "formulas with indices")]

use super::chains::solve;
use super::hand::{ByHand, G};
use super::number::Number;

/// The common part of all forms: the rods, and the equations of the tensions.
struct Rods<R, const RODS: usize> {
    x: [R; RODS],
    y: [R; RODS],
    diagonal: [R; RODS],
    /// Minus the entry beside the diagonal; the last one is not used.
    beside: [R; RODS],
    right: [R; RODS],
}

impl<R: Number, const RODS: usize> Rods<R, RODS> {
    #[inline]
    fn at<const N: usize>(q: &[R; N], v: &[R; N]) -> Self {
        const { assert!(N == 2 * RODS, "two coordinates a rod") };
        let zero = R::default();
        let (mut x, mut y, mut right) = ([zero; RODS], [zero; RODS], [zero; RODS]);
        let (mut diagonal, mut beside) = ([zero; RODS], [zero; RODS]);
        for i in 0..RODS {
            let (mut u, mut w) = (v[i], v[RODS + i]);
            (x[i], y[i]) = (q[i], q[RODS + i]);
            if i > 0 {
                x[i] -= q[i - 1];
                y[i] -= q[RODS + i - 1];
                u -= v[i - 1];
                w -= v[RODS + i - 1];
            }
            let square = x[i] * x[i] + y[i] * y[i];
            diagonal[i] = if i == 0 { square } else { square * 2.0 };
            right[i] = u * u + w * w;
        }
        right[0] -= y[0] * G;
        for i in 0..RODS - 1 {
            beside[i] = x[i] * x[i + 1] + y[i] * y[i + 1];
        }
        Self { x, y, diagonal, beside, right }
    }

    /// The accelerations that the tensions give.
    #[inline]
    fn accelerations<const N: usize>(&self, tension: &[R; RODS], a: &mut [R; N]) {
        for i in 0..RODS {
            let (mut x, mut y) = (-(tension[i] * self.x[i]), -(tension[i] * self.y[i]) - G);
            if i + 1 < RODS {
                x += tension[i + 1] * self.x[i + 1];
                y += tension[i + 1] * self.y[i + 1];
            }
            (a[i], a[RODS + i]) = (x, y);
        }
    }
}

/// The tensions from a dense matrix, LDLᵀ.
#[derive(Clone, Copy)]
pub struct DenseRods<const RODS: usize>;

impl<const N: usize, const RODS: usize> ByHand<N> for DenseRods<RODS> {
    #[inline]
    fn accelerations<R: Number>(_t: f64, q: &[R; N], v: &[R; N], a: &mut [R; N]) {
        let rods = Rods::<R, RODS>::at(q, v);
        let mut matrix = [[R::default(); RODS]; RODS];
        for i in 0..RODS {
            matrix[i][i] = rods.diagonal[i];
            if i > 0 {
                matrix[i][i - 1] = -rods.beside[i - 1];
            }
        }
        let mut tension = rods.right;
        solve(&mut matrix, &mut tension);
        rods.accelerations(&tension, a);
    }
}

/// The tensions by elimination along the chain.
#[derive(Clone, Copy)]
pub struct Tridiagonal<const RODS: usize>;

impl<const N: usize, const RODS: usize> ByHand<N> for Tridiagonal<RODS> {
    #[inline]
    fn accelerations<R: Number>(_t: f64, q: &[R; N], v: &[R; N], a: &mut [R; N]) {
        let rods = Rods::<R, RODS>::at(q, v);
        let (mut tension, mut inverse) = (rods.right, [R::default(); RODS]);
        inverse[0] = rods.diagonal[0].inverse();
        for i in 1..RODS {
            let factor = rods.beside[i - 1] * inverse[i - 1];
            inverse[i] = (rods.diagonal[i] - factor * rods.beside[i - 1]).inverse();
            tension[i] += factor * tension[i - 1];
        }
        tension[RODS - 1] *= inverse[RODS - 1];
        for i in (0..RODS - 1).rev() {
            tension[i] = (tension[i] + rods.beside[i] * tension[i + 1]) * inverse[i];
        }
        rods.accelerations(&tension, a);
    }
}
