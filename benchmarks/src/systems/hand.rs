//! The accelerations as an expert writes them: closed forms for small systems; for chains a
//! dense mass matrix with LDLᵀ, and the tridiagonal equations for the rod tensions.

#![allow(clippy::needless_range_loop, reason = "formulas with indices")]

/// Gravitational acceleration [m/s²].
const G: f64 = 9.81;

/// Double pendulum.
#[inline(never)]
pub fn dpend(_t: f64, q: &[f64; 2], v: &[f64; 2], a: &mut [f64; 2]) {
    let (s1, c1) = q[0].sin_cos();
    let (s2, c2) = q[1].sin_cos();
    let c = c1 * c2 + s1 * s2;
    let s = s1 * c2 - c1 * s2;
    let f1 = -(s * v[1] * v[1]) - 2.0 * G * s1;
    let f2 = s * v[0] * v[0] - G * s2;
    let det = 1.0 / (2.0 - c * c);
    *a = [(f1 - c * f2) * det, (2.0 * f2 - c * f1) * det];
}

/// Spring pendulum.
#[inline(never)]
pub fn spring(_t: f64, q: &[f64; 2], v: &[f64; 2], a: &mut [f64; 2]) {
    let (s, c) = q[1].sin_cos();
    *a = [q[0] * v[1] * v[1] + G * c - 40.0 * (q[0] - 1.0), -(G * s + 2.0 * v[0] * v[1]) / q[0]];
}

/// Hénon–Heiles.
#[inline(never)]
pub fn hh(_t: f64, q: &[f64; 2], _v: &[f64; 2], a: &mut [f64; 2]) {
    let [x, y] = *q;
    *a = [-x - 2.0 * x * y, y * y - x * x - y];
}

/// Kepler.
#[inline(never)]
pub fn kepler(_t: f64, q: &[f64; 2], _v: &[f64; 2], a: &mut [f64; 2]) {
    let r2 = q[0] * q[0] + q[1] * q[1];
    let w = -1.0 / (r2 * r2.sqrt());
    *a = [w * q[0], w * q[1]];
}

/// Pleiades: every pair once.
#[inline(never)]
pub fn pleiades(_t: f64, q: &[f64; 14], _v: &[f64; 14], a: &mut [f64; 14]) {
    *a = [0.0; 14];
    for i in 0..7 {
        for j in i + 1..7 {
            let (dx, dy) = (q[j] - q[i], q[7 + j] - q[7 + i]);
            let r2 = dx * dx + dy * dy;
            let w = 1.0 / (r2 * r2.sqrt());
            let (wx, wy) = (w * dx, w * dy);
            let (mi, mj) = ((i + 1) as f64, (j + 1) as f64);
            a[i] += mj * wx;
            a[7 + i] += mj * wy;
            a[j] -= mi * wx;
            a[7 + j] -= mi * wy;
        }
    }
}

/// Heavy top.
#[inline(never)]
pub fn top(_t: f64, q: &[f64; 3], v: &[f64; 3], a: &mut [f64; 3]) {
    let (s, c) = q[1].sin_cos();
    let [p, n, r] = *v;
    let spin = r + p * c;
    let nutation = s * (p * p * c - 0.6 * spin * p + 2.0);
    let precession = n * (0.6 * spin - 2.0 * p * c) / s;
    *a = [precession, nutation, p * n * s - precession * c];
}

/// Spherical pendulum.
#[inline(never)]
pub fn sph(_t: f64, q: &[f64; 2], v: &[f64; 2], a: &mut [f64; 2]) {
    let (s, c) = q[0].sin_cos();
    *a = [s * (v[1] * v[1] * c - G), -(2.0 * v[0] * v[1] * c) / s];
}

/// Cart and pole.
#[inline(never)]
pub fn cart(t: f64, q: &[f64; 2], v: &[f64; 2], a: &mut [f64; 2]) {
    let (m, l) = (0.2, 0.5);
    let (s, c) = q[1].sin_cos();
    let f1 = m * l * s * v[1] * v[1] - 0.1 * v[0] + 2.0 * (1.5 * t).cos();
    let f2 = m * G * l * s - 0.02 * v[1];
    let (whole, e, h) = (1.0 + m, m * l * c, m * l * l);
    let det = 1.0 / (whole * h - e * e);
    *a = [(h * f1 - e * f2) * det, (whole * f2 - e * f1) * det];
}

/// Chain: dense mass matrix, LDLᵀ by rows.
#[inline(never)]
pub fn dense<const N: usize>(_t: f64, q: &[f64; N], v: &[f64; N], a: &mut [f64; N]) {
    let (mut s, mut c, mut b, mut w2) = ([0.0; N], [0.0; N], [0.0; N], [0.0; N]);
    let mut m = [[0.0; N]; N];
    for i in 0..N {
        (s[i], c[i]) = q[i].sin_cos();
        b[i] = -(G * (N - i) as f64) * s[i];
        w2[i] = v[i] * v[i];
    }
    for i in 0..N {
        let weight = (N - i) as f64;
        m[i][i] = weight;
        for j in 0..i {
            m[i][j] = weight * (c[i] * c[j] + s[i] * s[j]);
            let sine = weight * (s[i] * c[j] - c[i] * s[j]);
            b[i] -= sine * w2[j];
            b[j] += sine * w2[i];
        }
    }
    let mut inverse = [0.0; N];
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
        inverse[i] = 1.0 / pivot;
        for j in 0..i {
            m[j][i] = m[i][j] / inverse[j];
        }
    }
    for i in 0..N {
        for k in 0..i {
            b[i] -= m[i][k] * b[k];
        }
    }
    for i in 0..N {
        b[i] *= inverse[i];
    }
    for i in (0..N).rev() {
        for k in 0..i {
            b[k] -= m[i][k] * b[i];
        }
    }
    *a = b;
}

/// Chain: tridiagonal equations for the rod tensions.
#[inline(never)]
pub fn linear<const N: usize>(_t: f64, q: &[f64; N], v: &[f64; N], a: &mut [f64; N]) {
    let (mut s, mut c, mut tension) = ([0.0; N], [0.0; N], [0.0; N]);
    let (mut cd, mut sd, mut inverse) = ([0.0; N], [0.0; N], [0.0; N]);
    for i in 0..N {
        (s[i], c[i]) = q[i].sin_cos();
    }
    for i in 0..N - 1 {
        cd[i] = c[i] * c[i + 1] + s[i] * s[i + 1];
        sd[i] = s[i + 1] * c[i] - c[i + 1] * s[i];
    }
    inverse[0] = 1.0;
    tension[0] = v[0] * v[0] + G * c[0];
    for i in 1..N {
        let factor = cd[i - 1] * inverse[i - 1];
        inverse[i] = 1.0 / (2.0 - cd[i - 1] * factor);
        tension[i] = v[i] * v[i] + factor * tension[i - 1];
    }
    tension[N - 1] *= inverse[N - 1];
    for i in (0..N - 1).rev() {
        tension[i] = (tension[i] + cd[i] * tension[i + 1]) * inverse[i];
    }
    for i in 0..N {
        let above = if i == 0 { -G * s[0] } else { -(sd[i - 1] * tension[i - 1]) };
        a[i] = if i + 1 < N { above + sd[i] * tension[i + 1] } else { above };
    }
}
