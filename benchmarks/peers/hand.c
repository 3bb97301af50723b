// The systems' right-hand sides by hand, with the signature that numbalsoda asks for: y = (q, v), d = (v, a) unless
// said otherwise.
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

// Car axis: y = (height, lean) in the frame of the axle and their rates; see ../src/systems/car_axis.rs.
FIELD(caraxis) {
    const double mass = 5e-4, free_length = 0.5;
    double wave, slope, s, c;
    sincos(10 * t, &wave, &slope);
    sincos(y[1], &s, &c);
    const double sine = 0.1 * wave, cosine = sqrt(1 - sine * sine), rate = slope / cosine, square = rate * rate;
    const double acceleration = (square - 100) * sine / cosine;
    const double along = c - 1, across = y[0] + s, turn = y[3] + rate;
    const double spring = (free_length / sqrt(along * along + across * across) - 1) / mass;
    const double upward = s * turn * turn + 2 * y[0] * square - (y[0] - free_length) / mass + spring * across - 2 * cosine;
    const double around = c * y[0] * square - s * (2 * y[2] * rate + y[0] * acceleration) + spring * (s + y[0] * c) +
                          s * sine - c * cosine;
    const double inverse = 1 / (1 + s * s);
    d[0] = y[2];
    d[1] = y[3];
    d[2] = (upward - c * around) * inverse;
    d[3] = (2 * around - c * upward) * inverse - acceleration;
}

// Andrews' mechanism: two links that follow a third; see ../src/systems/andrews.rs.
typedef struct {
    double sine, inverse, along, across, first, second;
} pair;

// From lengths of the driver and the links, and sine and cosine of the links' angle and of the driver's with the second.
static inline pair follow(double l0, double l1, double l2, double s, double c, double behind_s, double behind_c) {
    const double inverse = 1 / c, first_s = behind_s * c - behind_c * s, first_c = behind_c * c + behind_s * s;
    return (pair){s, inverse, behind_s, first_c, l0 / l1 * behind_c * inverse, l0 / l2 * first_s * inverse};
}

// Accelerations of both links when the driver has none, from lengths times squares of rates.
static inline void rest(const pair *p, double l1, double l2, double g, double a, double b, double *first, double *second) {
    *first = (a * p->sine + b - g * p->along) * p->inverse / l1;
    *second = (g * p->across - a - b * p->sine) * p->inverse / l2;
}

// y = (β, Θ, γ, Φ, δ, Ω, ε, β'): the loops give the other velocities.
FIELD(andrews) {
    const double D = .028, DA = .0115, E = .02, EA = .01421, RR = .007, RA = .00092, SS = .035, SA = .01874;
    const double SB = .01043, SC = .018, SD = .02, TA = .02308, TB = .00916, U = .04, UA = .01228, UB = .00449;
    const double ZF = .02, ZT = .04, FA = .01421, BX = -.03635 - .014, BY = .03273 - .072;
    const double j1 = .04325 * RA * RA + .00365 * RR * RR + 2.194e-6, j2 = .00365 * DA * DA + 4.410e-7;
    const double j3 = .02373 * (SA * SA + SB * SB) + 5.255e-6, j4 = .00706 * (E - EA) * (E - EA) + 5.667e-7;
    const double j5 = .00706 * ZT * ZT + .07050 * (TA * TA + TB * TB) + 1.169e-5;
    const double j6 = .00706 * (ZF - FA) * (ZF - FA) + 5.667e-7;
    const double j7 = .00706 * U * U + .05498 * (UA * UA + UB * UB) + 1.912e-5;
    const double k12 = .00365 * RR * DA, k45 = .00706 * ZT * (E - EA), k67 = .00706 * U * (ZF - FA);
    const double along = 2 * (BX * SD - BY * SC), across = 2 * (BX * SC + BY * SD);
    double sth, cth, sw, cw, sph, cph, sde, cde, som, com, sep, cep, sga, cga;
    sincos(y[1], &sth, &cth);
    sincos(y[0] + y[1] - y[2], &sw, &cw);
    sincos(y[3], &sph, &cph);
    sincos(y[2] - y[4], &sde, &cde);
    sincos(y[5], &som, &com);
    sincos(y[2] - y[6], &sep, &cep);
    sincos(y[2], &sga, &cga);
    const pair bar = follow(RR, SS, D, -sw, cw, cth, sth), left = follow(SS, E, ZT, sph, cph, sde, cde);
    const pair right = follow(SS, ZF, U, -som, -com, cep, -sep);
    const double vb = y[7], vg = bar.first * vb, vs = bar.second * vb, vx = left.first * vg, vd = left.second * vg;
    const double vo = right.first * vg, ve = right.second * vg;
    const double b = vb * vb, g = vg * vg, s = vs * vs, x = vx * vx, dd = vd * vd, o = vo * vo, e = ve * ve;
    double rg, rs, rx, rd, ro, re;
    rest(&bar, SS, D, RR * b, SS * g, D * s, &rg, &rs);
    rest(&left, E, ZT, SS * g, E * x, ZT * dd, &rx, &rd);
    rest(&right, ZF, U, SS * g, ZF * o, U * e, &ro, &re);
    const double m45 = k45 * sph, h45 = k45 * cph, m67 = -k67 * som, h67 = -k67 * com;
    const double inertia = j3 + left.first * (j4 * left.first + 2 * m45 * left.second) + j5 * left.second * left.second +
                           right.first * (j6 * right.first + 2 * m67 * right.second) + j7 * right.second * right.second;
    const double length = sqrt(BX * BX + BY * BY + SC * SC + SD * SD + along * cga + across * sga);
    const double torque = 4530.0 / 2 * (.07785 / length - 1) * (across * cga - along * sga) +
                          left.first * (h45 * dd - j4 * rx - m45 * rd) - left.second * (h45 * x + j5 * rd + m45 * rx) +
                          right.first * (h67 * e - j6 * ro - m67 * re) - right.second * (h67 * o + j7 * re + m67 * ro);
    const double whole = j1 + bar.second * (j2 * bar.second - 2 * k12 * cth) + bar.first * bar.first * inertia;
    d[0] = vb;
    d[1] = vs - vb;
    d[2] = vg;
    d[3] = vx - vd;
    d[4] = vd;
    d[5] = vo - ve;
    d[6] = ve;
    d[7] = (.033 + k12 * (cth * rs - sth * s) + bar.second * (k12 * sth * b - j2 * rs) +
            bar.first * (torque - inertia * rg)) / whole;
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
