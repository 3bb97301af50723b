//! Splitting methods: fractions of the step for kicks and drifts, alternating, a kick first and last.
//!
//! All are palindromes, so only the first half stands here. A step leaves out a kick of zero. Composition
//! methods by H. Yoshida, Phys. Lett. A 150 (1990) 262, of which that of order 8 by M. Suzuki and K. Umeno in
//! "Computer Simulation Studies in Condensed-Matter Physics VI" (1993) 74, with coefficients from E. Hairer,
//! C. Lubich, G. Wanner, "Geometric Numerical Integration", 2nd ed., V.3.2. Runge–Kutta–Nyström splittings
//! SRKN6b and SRKN14a by S. Blanes and P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313; what follows from
//! consistency is computed to all digits.

/// A splitting of one step.
pub(crate) struct Fractions<const KICKS: usize, const DRIFTS: usize> {
    /// Kicks, before each drift and after the last.
    pub kicks: [f64; KICKS],
    /// Drifts.
    pub drifts: [f64; DRIFTS],
}

/// Kick, drift, kick: order 2.
pub(crate) const LEAPFROG: Fractions<2, 1> = Fractions { kicks: [0.5, 0.5], drifts: [1.0] };

/// Three leapfrogs of order 4; the first and the last of 1/(2 − ∛2).
pub(crate) const YOSHIDA4: Fractions<4, 3> = composed([1.3512071919596578]);

/// Seven leapfrogs of order 6, Yoshida's solution A.
pub(crate) const YOSHIDA6: Fractions<8, 7> =
    composed([0.7845136104775573, 0.23557321335935813, -1.177679984178871]);

/// Fifteen leapfrogs of order 8.
pub(crate) const YOSHIDA8: Fractions<16, 15> = composed([
    0.741670364350613,
    -0.4091008258000316,
    0.1907547102962384,
    -0.5738624711160824,
    0.2990641813036559,
    0.33462491824529816,
    0.3152930923967666,
]);

/// SRKN6b, order 4.
pub(crate) const BLANES_MOAN4: Fractions<7, 6> = {
    const B: [f64; 3] = [0.0829844064174052, 0.396309801498368, -0.0390563049223486];
    const A: [f64; 2] = [0.245298957184271, 0.60487266571108];
    mirrored([B[0], B[1], B[2], 1.0 - 2.0 * (B[0] + B[1] + B[2])], [A[0], A[1], 0.5 - (A[0] + A[1])])
};

/// SRKN14a, order 6.
pub(crate) const BLANES_MOAN6: Fractions<16, 15> = {
    const A: [f64; 7] = [
        0.0378593198406116,
        0.102635633102435,
        -0.0258678882665587,
        0.314241403071447,
        -0.130144459517415,
        0.106417700369543,
        -0.00879424312851058,
    ];
    const B: [f64; 6] = [
        0.09171915262446165,
        0.183983170005006,
        -0.05653436583288827,
        0.004914688774712854,
        0.143761127168358,
        0.328567693746804,
    ];
    let rest = 0.5 - (B[0] + B[1] + B[2] + B[3] + B[4] + B[5]);
    let middle = 1.0 - 2.0 * (A[0] + A[1] + A[2] + A[3] + A[4] + A[5] + A[6]);
    mirrored(
        [0.0, B[0], B[1], B[2], B[3], B[4], B[5], rest],
        [A[0], A[1], A[2], A[3], A[4], A[5], A[6], middle],
    )
};

/// Leapfrogs of the given lengths, one in the middle that makes their sum 1, and the given ones backward; the
/// kicks between two of them are one.
const fn composed<const HALF: usize, const KICKS: usize, const DRIFTS: usize>(
    lengths: [f64; HALF],
) -> Fractions<KICKS, DRIFTS> {
    let mut middle = 1.0;
    let mut i = 0;
    while i < HALF {
        middle -= 2.0 * lengths[i];
        i += 1;
    }
    let mut drifts = [middle; DRIFTS];
    i = 0;
    while i < HALF {
        drifts[i] = lengths[i];
        drifts[DRIFTS - 1 - i] = lengths[i];
        i += 1;
    }
    let mut kicks = [0.5 * drifts[0]; KICKS];
    i = 1;
    while i < DRIFTS {
        kicks[i] = 0.5 * (drifts[i - 1] + drifts[i]);
        i += 1;
    }
    Fractions { kicks, drifts }
}

/// A splitting whose kicks and drifts are palindromes, from the first half of each. Of an odd number the half
/// ends with the middle.
const fn mirrored<const HK: usize, const HD: usize, const KICKS: usize, const DRIFTS: usize>(
    half_kicks: [f64; HK],
    half_drifts: [f64; HD],
) -> Fractions<KICKS, DRIFTS> {
    let mut kicks = [0.0; KICKS];
    let mut i = 0;
    while i < HK {
        kicks[i] = half_kicks[i];
        kicks[KICKS - 1 - i] = half_kicks[i];
        i += 1;
    }
    let mut drifts = [0.0; DRIFTS];
    i = 0;
    while i < HD {
        drifts[i] = half_drifts[i];
        drifts[DRIFTS - 1 - i] = half_drifts[i];
        i += 1;
    }
    Fractions { kicks, drifts }
}
