//! Chains by hand: dense, with cost N³, and as an expert writes them, with cost N.
//!
//! Links are described by absolute angles. Each has unit length and carries a unit mass at the far end; the
//! first one hangs from the origin.

#![allow(clippy::needless_range_loop, reason = "formulas with indices")]

use super::hand::{ByHand, G};
use super::number::Number;

/// Links with absolute angles: dense mass matrix, LDLᵀ by rows.
#[derive(Clone, Copy)]
pub struct Dense;

impl<const N: usize> ByHand<N> for Dense {
    #[inline]
    fn accelerations<R: Number>(_t: f64, q: &[R; N], v: &[R; N], a: &mut [R; N]) {
        let zero = R::default();
        let (mut s, mut c, mut b, mut w2) = ([zero; N], [zero; N], [zero; N], [zero; N]);
        let mut m = [[zero; N]; N];
        for i in 0..N {
            (s[i], c[i]) = q[i].sin_cos();
            b[i] = -(s[i] * (G * (N - i) as f64));
            w2[i] = v[i] * v[i];
        }
        for i in 0..N {
            let weight = (N - i) as f64;
            m[i][i] = R::from(weight);
            for j in 0..i {
                m[i][j] = (c[i] * c[j] + s[i] * s[j]) * weight;
                let sine = (s[i] * c[j] - c[i] * s[j]) * weight;
                b[i] -= sine * w2[j];
                b[j] += sine * w2[i];
            }
        }
        solve(&mut m, &mut b);
        *a = b;
    }
}

/// Solves m x = b by LDLᵀ; `m` has the lower triangle and becomes the factors, `b` becomes x.
#[inline]
pub fn solve<R: Number, const N: usize>(m: &mut [[R; N]; N], b: &mut [R; N]) {
    let mut inverse = [R::default(); N];
    for i in 0..N {
        let mut pivot = m[i][i];
        for j in 0..i {
            let mut entry = m[i][j];
            for k in 0..j {
                entry -= m[i][k] * m[j][k];
            }
            m[i][j] = entry;
        }
        for j in 0..i {
            let scaled = m[i][j];
            let factor = scaled * inverse[j];
            pivot -= scaled * factor;
            m[i][j] = factor;
        }
        // Row i keeps the unit factors; the inner products above pair them with scaled rows.
        inverse[i] = pivot.inverse();
        for j in 0..i {
            m[j][i] = m[i][j] / inverse[j];
        }
    }
    for i in 0..N {
        for k in 0..i {
            let known = b[k];
            b[i] -= m[i][k] * known;
        }
    }
    for i in 0..N {
        b[i] *= inverse[i];
    }
    for i in (0..N).rev() {
        let known = b[i];
        for k in 0..i {
            b[k] -= m[i][k] * known;
        }
    }
}

/// Links with absolute angles: tridiagonal equations for the rod tensions.
#[derive(Clone, Copy)]
pub struct Tensions;

impl<const N: usize> ByHand<N> for Tensions {
    #[inline]
    fn accelerations<R: Number>(_t: f64, q: &[R; N], v: &[R; N], a: &mut [R; N]) {
        let zero = R::default();
        let (mut s, mut c, mut tension) = ([zero; N], [zero; N], [zero; N]);
        let (mut cd, mut sd, mut inverse) = ([zero; N], [zero; N], [zero; N]);
        for i in 0..N {
            (s[i], c[i]) = q[i].sin_cos();
        }
        for i in 0..N - 1 {
            cd[i] = c[i] * c[i + 1] + s[i] * s[i + 1];
            sd[i] = s[i + 1] * c[i] - c[i + 1] * s[i];
        }
        inverse[0] = R::from(1.0);
        tension[0] = v[0] * v[0] + c[0] * G;
        for i in 1..N {
            let factor = cd[i - 1] * inverse[i - 1];
            inverse[i] = (-(cd[i - 1] * factor) + 2.0).inverse();
            tension[i] = v[i] * v[i] + factor * tension[i - 1];
        }
        tension[N - 1] *= inverse[N - 1];
        for i in (0..N - 1).rev() {
            tension[i] = (tension[i] + cd[i] * tension[i + 1]) * inverse[i];
        }
        for i in 0..N {
            let above = if i == 0 { -(s[0] * G) } else { -(sd[i - 1] * tension[i - 1]) };
            a[i] = if i + 1 < N { above + sd[i] * tension[i + 1] } else { above };
        }
    }
}

/// Links with absolute angles: articulated bodies, from the tip to the base and back.
///
/// Rod i pulls its upper end along itself, with the force γᵢ − αᵢ eᵢ·a, where e is the direction of the rod
/// and a the acceleration of that end relative to free fall. α is the articulated inertia, a number because
/// a massless rod with a hinge resists along itself alone.
#[derive(Clone, Copy)]
pub struct Recursive;

impl<const N: usize> ByHand<N> for Recursive {
    #[inline]
    fn accelerations<R: Number>(_t: f64, q: &[R; N], v: &[R; N], a: &mut [R; N]) {
        let zero = R::default();
        let (mut s, mut c) = ([zero; N], [zero; N]);
        // Cosine and sine of rod i + 1 seen from rod i, and one over 1 + α s².
        let (mut cosine, mut sine, mut inverse) = ([zero; N], [zero; N], [zero; N]);
        let (mut alpha, mut gamma, mut tension) = ([zero; N], [zero; N], [zero; N]);
        for i in 0..N {
            (s[i], c[i]) = q[i].sin_cos();
        }
        for i in 0..N - 1 {
            cosine[i] = c[i] * c[i + 1] + s[i] * s[i + 1];
            sine[i] = s[i + 1] * c[i] - c[i + 1] * s[i];
        }
        alpha[N - 1] = R::from(1.0);
        gamma[N - 1] = v[N - 1] * v[N - 1];
        for i in (0..N - 1).rev() {
            let carried = alpha[i + 1] + 1.0;
            inverse[i] = (alpha[i + 1] * (sine[i] * sine[i]) + 1.0).inverse();
            alpha[i] = carried * inverse[i];
            gamma[i] = (v[i] * v[i] * carried + cosine[i] * gamma[i + 1]) * inverse[i];
        }
        // Along rod i: acceleration of its lower end relative to free fall.
        let mut along = -(c[0] * G) - v[0] * v[0];
        tension[0] = gamma[0] + alpha[0] * (c[0] * G);
        for i in 0..N - 1 {
            let next = (gamma[i + 1] - alpha[i + 1] * (cosine[i] * along)) * inverse[i];
            along = cosine[i] * along + sine[i] * sine[i] * next - v[i + 1] * v[i + 1];
            tension[i + 1] = next;
        }
        for i in 0..N {
            let above = if i == 0 { -(s[0] * G) } else { -(sine[i - 1] * tension[i - 1]) };
            a[i] = if i + 1 < N { above + sine[i] * tension[i + 1] } else { above };
        }
    }
}
