// The systems' right-hand sides by hand, with the signature that numbalsoda asks for: y = (q, v), d = (v, a).
#define _GNU_SOURCE
#include <math.h>

static const double g = 9.81;

#define FIELD(name) void name(double t, const double *y, double *d, const double *parameters)

FIELD(dpend) {
    double s1, c1, s2, c2;
    sincos(y[0], &s1, &c1);
    sincos(y[1], &s2, &c2);
    const double c = c1 * c2 + s1 * s2, s = s1 * c2 - c1 * s2;
    const double f1 = -s * y[3] * y[3] - 2 * g * s1, f2 = s * y[2] * y[2] - g * s2;
    const double inverse = 1 / (2 - c * c);
    d[0] = y[2];
    d[1] = y[3];
    d[2] = (f1 - c * f2) * inverse;
    d[3] = (2 * f2 - c * f1) * inverse;
}

FIELD(spring) {
    double s, c;
    sincos(y[1], &s, &c);
    d[0] = y[2];
    d[1] = y[3];
    d[2] = y[0] * y[3] * y[3] + g * c - 40 * (y[0] - 1);
    d[3] = -(g * s + 2 * y[2] * y[3]) / y[0];
}

FIELD(hh) {
    d[0] = y[2];
    d[1] = y[3];
    d[2] = -y[0] - 2 * y[0] * y[1];
    d[3] = y[1] * y[1] - y[0] * y[0] - y[1];
}

FIELD(kepler) {
    const double square = y[0] * y[0] + y[1] * y[1], factor = -1 / (square * sqrt(square));
    d[0] = y[2];
    d[1] = y[3];
    d[2] = factor * y[0];
    d[3] = factor * y[1];
}

FIELD(pleiades) {
    for (int i = 0; i < 14; i++) {
        d[i] = y[14 + i];
        d[14 + i] = 0;
    }
    for (int i = 0; i < 7; i++)
        for (int j = i + 1; j < 7; j++) {
            const double dx = y[j] - y[i], dy = y[7 + j] - y[7 + i];
            const double square = dx * dx + dy * dy, factor = 1 / (square * sqrt(square));
            d[14 + i] += (j + 1) * (factor * dx);
            d[21 + i] += (j + 1) * (factor * dy);
            d[14 + j] -= (i + 1) * (factor * dx);
            d[21 + j] -= (i + 1) * (factor * dy);
        }
}

FIELD(top) {
    double s, c;
    sincos(y[1], &s, &c);
    const double p = y[3], n = y[4], spin = y[5] + p * c;
    d[0] = p;
    d[1] = n;
    d[2] = y[5];
    d[3] = n * (0.6 * spin - 2 * p * c) / s;
    d[4] = s * (p * p * c - 0.6 * spin * p + 2);
    d[5] = p * n * s - d[3] * c;
}

FIELD(sph) {
    double s, c;
    sincos(y[0], &s, &c);
    d[0] = y[2];
    d[1] = y[3];
    d[2] = s * (y[3] * y[3] * c - g);
    d[3] = -(2 * y[2] * y[3] * c) / s;
}

FIELD(cart) {
    const double m = 0.2, l = 0.5;
    double s, c;
    sincos(y[1], &s, &c);
    const double f1 = m * l * s * y[3] * y[3] - 0.1 * y[2] + 2 * cos(1.5 * t), f2 = m * g * l * s - 0.02 * y[3];
    const double whole = 1 + m, coupling = m * l * c, inertia = m * l * l;
    const double inverse = 1 / (whole * inertia - coupling * coupling);
    d[0] = y[2];
    d[1] = y[3];
    d[2] = (inertia * f1 - coupling * f2) * inverse;
    d[3] = (whole * f2 - coupling * f1) * inverse;
}

// The multiplier eliminated.
FIELD(pendc) {
    const double multiplier = -(y[2] * y[2] + y[3] * y[3] - g * y[1]) / (y[0] * y[0] + y[1] * y[1]);
    d[0] = y[2];
    d[1] = y[3];
    d[2] = multiplier * y[0];
    d[3] = multiplier * y[1] - g;
}

// The multiplier eliminated: the constraint gives the second acceleration as ratio * first + rest.
FIELD(slider) {
    double s1, c1, s2, c2;
    sincos(y[0], &s1, &c1);
    sincos(y[1], &s2, &c2);
    const double square1 = y[2] * y[2], square2 = y[3] * y[3];
    const double c = c1 * c2 + s1 * s2, s = s1 * c2 - c1 * s2;
    const double m11 = 1.0 / 12 + 0.25 + 0.25 * s1 * s1, m12 = 0.25 * c + 0.5 * s1 * s2, m22 = 1.0 / 3 + s2 * s2;
    const double piston = 0.5 * c1 * square1 + c2 * square2;
    const double bias1 = 0.25 * s * square2 + 0.5 * s1 * piston + 0.75 * g * c1;
    const double bias2 = -0.25 * s * square1 + s2 * piston + 0.5 * g * c2;
    const double inverse = 1 / c2, ratio = -0.5 * c1 * inverse;
    const double rest = (0.5 * s1 * square1 + s2 * square2) * inverse;
    const double first =
        -(bias1 + m12 * rest + ratio * (bias2 + m22 * rest)) / (m11 + ratio * (2 * m12 + ratio * m22));
    d[0] = y[2];
    d[1] = y[3];
    d[2] = first;
    d[3] = ratio * first + rest;
}

// Tensions of the rods: eliminate downwards, substitute upwards.
static inline __attribute__((always_inline)) void chain(const int n, const double *y, double *d) {
    double s[n], c[n], tension[n], cd[n], sd[n], inverse[n];
    for (int i = 0; i < n; i++) {
        sincos(y[i], &s[i], &c[i]);
        d[i] = y[n + i];
    }
    for (int i = 0; i + 1 < n; i++) {
        cd[i] = c[i] * c[i + 1] + s[i] * s[i + 1];
        sd[i] = s[i + 1] * c[i] - c[i + 1] * s[i];
    }
    inverse[0] = 1;
    tension[0] = y[n] * y[n] + g * c[0];
    for (int i = 1; i < n; i++) {
        const double factor = cd[i - 1] * inverse[i - 1];
        inverse[i] = 1 / (2 - cd[i - 1] * factor);
        tension[i] = y[n + i] * y[n + i] + factor * tension[i - 1];
    }
    tension[n - 1] *= inverse[n - 1];
    for (int i = n - 2; i >= 0; i--)
        tension[i] = (tension[i] + cd[i] * tension[i + 1]) * inverse[i];
    d[n] = sd[0] * tension[1] - g * s[0];
    for (int i = 1; i + 1 < n; i++)
        d[n + i] = sd[i] * tension[i + 1] - sd[i - 1] * tension[i - 1];
    d[2 * n - 1] = -sd[n - 2] * tension[n - 2];
}

FIELD(nlink3) { chain(3, y, d); }
FIELD(nlink5) { chain(5, y, d); }
FIELD(nlink10) { chain(10, y, d); }
FIELD(nlink20) { chain(20, y, d); }
