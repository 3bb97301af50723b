//! The accelerations as an expert writes them: closed forms for small systems. `chains.rs` and `rods.rs` have
//! those of chains.

#![cfg_attr(not(feature = "peers"), allow(dead_code, reason = "systems with constraints are for the peers"))]

use super::number::Number;

/// Gravitational acceleration [m/s²].
pub const G: f64 = 9.81;

/// Accelerations by hand of a system of `N` coordinates.
pub trait ByHand<const N: usize>: Copy + 'static {
    /// Writes the accelerations at (t, q, v).
    fn accelerations<R: Number>(t: f64, q: &[R; N], v: &[R; N], a: &mut [R; N]);
}

/// The structure and its formulas.
macro_rules! by_hand {
    ($(#[$doc:meta])* $name:ident<$count:literal>, |$t:pat_param, $q:ident, $v:pat_param| $body:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        pub struct $name;

        impl ByHand<$count> for $name {
            #[inline]
            fn accelerations<R: Number>($t: f64, $q: &[R; $count], $v: &[R; $count], a: &mut [R; $count]) {
                *a = $body;
            }
        }
    };
}

by_hand!(
    /// Double pendulum.
    DoublePendulum<2>, |_, q, v| {
        let (s1, c1) = q[0].sin_cos();
        let (s2, c2) = q[1].sin_cos();
        let c = c1 * c2 + s1 * s2;
        let s = s1 * c2 - c1 * s2;
        let f1 = -(s * v[1] * v[1]) - s1 * (2.0 * G);
        let f2 = s * v[0] * v[0] - s2 * G;
        let det = (-(c * c) + 2.0).inverse();
        [(f1 - c * f2) * det, (f2 * 2.0 - c * f1) * det]
    }
);

by_hand!(
    /// Spring pendulum.
    SpringPendulum<2>, |_, q, v| {
        let (s, c) = q[1].sin_cos();
        [q[0] * v[1] * v[1] + c * G - (q[0] - 1.0) * 40.0, -(s * G + v[0] * v[1] * 2.0) / q[0]]
    }
);

by_hand!(
    /// Hénon–Heiles.
    HenonHeiles<2>, |_, q, _| {
        let [x, y] = *q;
        [-x - x * y * 2.0, y * y - x * x - y]
    }
);

by_hand!(
    /// Kepler.
    Kepler<2>, |_, q, _| {
        let r2 = q[0] * q[0] + q[1] * q[1];
        let w = -(r2 * r2.sqrt()).inverse();
        [w * q[0], w * q[1]]
    }
);

by_hand!(
    /// Pleiades: every pair once.
    Pleiades<14>, |_, q, _| {
        let mut a = [R::default(); 14];
        for i in 0..7 {
            for j in i + 1..7 {
                let (dx, dy) = (q[j] - q[i], q[7 + j] - q[7 + i]);
                let r2 = dx * dx + dy * dy;
                let w = (r2 * r2.sqrt()).inverse();
                let (wx, wy) = (w * dx, w * dy);
                let (mi, mj) = ((i + 1) as f64, (j + 1) as f64);
                a[i] += wx * mj;
                a[7 + i] += wy * mj;
                a[j] -= wx * mi;
                a[7 + j] -= wy * mi;
            }
        }
        a
    }
);

by_hand!(
    /// Heavy top.
    Top<3>, |_, q, v| {
        let (s, c) = q[1].sin_cos();
        let [p, n, r] = *v;
        let spin = r + p * c;
        let nutation = s * (p * p * c - spin * p * 0.6 + 2.0);
        let precession = n * (spin * 0.6 - p * c * 2.0) / s;
        [precession, nutation, p * n * s - precession * c]
    }
);

by_hand!(
    /// Spherical pendulum.
    SphericalPendulum<2>, |_, q, v| {
        let (s, c) = q[0].sin_cos();
        [s * (v[1] * v[1] * c - G), -(v[0] * v[1] * c * 2.0) / s]
    }
);

by_hand!(
    /// Cart and pole.
    CartPole<2>, |t, q, v| {
        let (m, l) = (0.2, 0.5);
        let (s, c) = q[1].sin_cos();
        let f1 = s * (m * l) * v[1] * v[1] - v[0] * 0.1 + 2.0 * (1.5 * t).cos();
        let f2 = s * (m * G * l) - v[1] * 0.02;
        let (whole, e, h) = (1.0 + m, c * (m * l), m * l * l);
        let det = (-(e * e) + whole * h).inverse();
        [(f1 * h - e * f2) * det, (f2 * whole - e * f1) * det]
    }
);

by_hand!(
    /// Cartesian pendulum, the multiplier eliminated.
    Pendulum<2>, |_, q, v| {
        let squares = v[0] * v[0] + v[1] * v[1] - q[1] * G;
        let multiplier = -squares / (q[0] * q[0] + q[1] * q[1]);
        [multiplier * q[0], multiplier * q[1] - G]
    }
);

/// Slider and crank, uniform links of lengths ½ and 1, unit masses, the multiplier eliminated.
#[derive(Clone, Copy)]
pub struct SliderCrank;

/// The terms of the equations of the slider and crank.
pub struct SliderCrankTerms<R> {
    /// Upper triangle of the mass matrix, by rows.
    pub mass: [R; 3],
    /// Torques that the rates and gravity need.
    pub bias: [R; 2],
    /// Derivatives of the constraint ½ sin θ₁ + sin θ₂ = 0.
    pub gradient: [R; 2],
    /// Its second derivative in time is gradient · accelerations − turning.
    pub turning: R,
}

impl SliderCrank {
    /// The terms at a state.
    #[inline]
    pub fn terms<R: Number>(q: &[R; 2], v: &[R; 2]) -> SliderCrankTerms<R> {
        let (s1, c1) = q[0].sin_cos();
        let (s2, c2) = q[1].sin_cos();
        let (square1, square2) = (v[0] * v[0], v[1] * v[1]);
        let (c, s) = (c1 * c2 + s1 * s2, s1 * c2 - c1 * s2);
        let piston = c1 * square1 * 0.5 + c2 * square2;
        SliderCrankTerms {
            mass: [s1 * s1 * 0.25 + (1.0 / 12.0 + 0.25), c * 0.25 + s1 * s2 * 0.5, s2 * s2 + 1.0 / 3.0],
            bias: [
                s * square2 * 0.25 + s1 * piston * 0.5 + c1 * (0.75 * G),
                s2 * piston - s * square1 * 0.25 + c2 * (0.5 * G),
            ],
            gradient: [c1 * 0.5, c2],
            turning: s1 * square1 * 0.5 + s2 * square2,
        }
    }
}

impl ByHand<2> for SliderCrank {
    #[inline]
    fn accelerations<R: Number>(_t: f64, q: &[R; 2], v: &[R; 2], a: &mut [R; 2]) {
        let SliderCrankTerms { mass: [m11, m12, m22], bias, gradient, turning } = Self::terms(q, v);
        // The constraint gives the second acceleration as ratio · first + rest.
        let inverse = gradient[1].inverse();
        let (ratio, rest) = (-(gradient[0] * inverse), turning * inverse);
        let force = bias[0] + m12 * rest + ratio * (bias[1] + m22 * rest);
        let first = -force / (m11 + ratio * (m12 * 2.0 + ratio * m22));
        *a = [first, ratio * first + rest];
    }
}
