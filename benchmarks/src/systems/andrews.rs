//! Andrews' squeezing mechanism: seven bodies, three loops, one degree of freedom.
//!
//! Coordinates are those of the Test Set for IVP Solvers, (β, Θ, γ, Φ, δ, Ω, ε). Both forms here think in the
//! angles of the bodies instead, in which the energies are simplest: β, σ = β + Θ, γ, χ = Φ + δ, δ, ω = Ω +
//! ε, ε.

use super::first_order::FirstOrder;
use super::number::Number;

/// Masses [kg] and moments of inertia [kg m²] of the bodies.
const MASS: [f64; 7] = [0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498];
const INERTIA: [f64; 7] = [2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5];

/// Lengths [m]; those in lower case in the Test Set.
const D: f64 = 0.028;
const DA: f64 = 0.0115;
const E: f64 = 0.02;
const EA: f64 = 0.01421;
const RR: f64 = 0.007;
const RA: f64 = 0.00092;
const SS: f64 = 0.035;
const SA: f64 = 0.01874;
const SB: f64 = 0.01043;
const SC: f64 = 0.018;
const SD: f64 = 0.02;
const TA: f64 = 0.02308;
const TB: f64 = 0.00916;
const U: f64 = 0.04;
const UA: f64 = 0.01228;
const UB: f64 = 0.00449;
const ZF: f64 = 0.02;
const ZT: f64 = 0.04;
const FA: f64 = 0.01421;

/// From the far end of the spring, C, to its own bearing, B [m].
const BEARING: [f64; 2] = [-0.03635 - 0.014, 0.03273 - 0.072];
/// Stiffness [N/m] and free length [m] of the spring, and the torque of the motor [N m].
const STIFFNESS: f64 = 4530.0;
const FREE_LENGTH: f64 = 0.07785;
const TORQUE: f64 = 0.033;

/// Diagonal of the mass matrix for the angles of the bodies …
const DIAGONAL: [f64; 7] = [
    MASS[0] * RA * RA + MASS[1] * RR * RR + INERTIA[0],
    MASS[1] * DA * DA + INERTIA[1],
    MASS[2] * (SA * SA + SB * SB) + INERTIA[2],
    MASS[3] * (E - EA) * (E - EA) + INERTIA[3],
    MASS[3] * ZT * ZT + MASS[4] * (TA * TA + TB * TB) + INERTIA[4],
    MASS[5] * (ZF - FA) * (ZF - FA) + INERTIA[5],
    MASS[5] * U * U + MASS[6] * (UA * UA + UB * UB) + INERTIA[6],
];
/// … and beside it: β with σ has this times −cos Θ, χ with δ sin Φ, ω with ε −sin Ω.
const COUPLING: [f64; 3] = [MASS[1] * RR * DA, MASS[3] * ZT * (E - EA), MASS[5] * U * (ZF - FA)];

/// Torque of the spring on γ.
#[inline]
fn spring<R: Number>((sin, cos): (R, R)) -> R {
    const ALONG: f64 = 2.0 * (BEARING[0] * SD - BEARING[1] * SC);
    const ACROSS: f64 = 2.0 * (BEARING[0] * SC + BEARING[1] * SD);
    const REST: f64 = BEARING[0] * BEARING[0] + BEARING[1] * BEARING[1] + SC * SC + SD * SD;
    let length = (cos * ALONG + sin * ACROSS + REST).sqrt();
    (length.inverse() * FREE_LENGTH - 1.0) * (cos * ACROSS - sin * ALONG) * (STIFFNESS / 2.0)
}

/// Sine and cosine of the difference of two angles.
#[inline]
fn difference<R: Number>(a: (R, R), b: (R, R)) -> (R, R) {
    (a.0 * b.1 - a.1 * b.0, a.1 * b.1 + a.0 * b.0)
}

/// Two links that follow a third: l₁ (sin a, −cos a) + l₂ (cos b, sin b) moves as l (sin g, −cos g) does.
struct Pair<R> {
    lengths: [f64; 3],
    /// Sines and cosines of a − b, g − b and g − a.
    apart: (R, R),
    behind: [(R, R); 2],
    /// One over the cosine of a − b.
    inverse: R,
    /// Rates of a and b for that of g.
    ratio: [R; 2],
}

impl<R: Number> Pair<R> {
    /// Lengths l, l₁, l₂; sines and cosines of a − b and g − b.
    #[inline]
    fn new(lengths: [f64; 3], apart: (R, R), second: (R, R)) -> Self {
        let first = difference(second, apart);
        let inverse = apart.1.inverse();
        let ratio =
            [second.1 * inverse * (lengths[0] / lengths[1]), first.0 * inverse * (lengths[0] / lengths[2])];
        Self { lengths, apart, behind: [second, first], inverse, ratio }
    }

    /// Accelerations of a and b when g has none, at rates whose squares are given for g, a and b.
    #[inline]
    fn rest(&self, squares: [R; 3]) -> [R; 2] {
        let [driver, first, second] = std::array::from_fn(|i| squares[i] * self.lengths[i]);
        let [behind_second, behind_first] = self.behind;
        let along = first * self.apart.0 + second - driver * behind_second.0;
        let across = driver * behind_first.1 - first - second * self.apart.0;
        [along * self.inverse * self.lengths[1].recip(), across * self.inverse * self.lengths[2].recip()]
    }

    /// The inertia and the torque that a pair adds to the driving link. The pair has the inertias `own`,
    /// coupled by `coupling` sin(a − b).
    #[inline]
    fn felt(&self, own: [f64; 2], coupling: f64, squares: [R; 3]) -> (R, R) {
        let ([a, b], [c, d]) = (self.ratio, self.rest(squares));
        let (mixed, bias) = (self.apart.0 * coupling, self.apart.1 * coupling);
        let inertia = a * (a * own[0] + mixed * b * 2.0) + b * b * own[1];
        let on_first = bias * squares[2] - c * own[0] - mixed * d;
        let on_second = -(bias * squares[1]) - d * own[1] - mixed * c;
        (inertia, a * on_first + b * on_second)
    }
}

/// β turns γ and σ, and γ turns (χ, δ) and (ω, ε).
struct Tree<R> {
    theta: (R, R),
    four_bar: Pair<R>,
    chi_delta: Pair<R>,
    omega_epsilon: Pair<R>,
}

impl<R: Number> Tree<R> {
    #[inline]
    fn new(&[beta, theta, gamma, phi, delta, omega, epsilon]: &[R; 7]) -> Self {
        let (sin_theta, cos_theta) = theta.sin_cos();
        let (sin_swing, cos_swing) = (beta + theta - gamma).sin_cos();
        let (sin_omega, cos_omega) = omega.sin_cos();
        let (sin_epsilon, cos_epsilon) = (gamma - epsilon).sin_cos();
        Self {
            theta: (sin_theta, cos_theta),
            // Quarter turns bring what moves at right angles into the form of a pair.
            four_bar: Pair::new([RR, SS, D], (-sin_swing, cos_swing), (cos_theta, sin_theta)),
            chi_delta: Pair::new([SS, E, ZT], phi.sin_cos(), (gamma - delta).sin_cos()),
            omega_epsilon: Pair::new([SS, ZF, U], (-sin_omega, -cos_omega), (cos_epsilon, -sin_epsilon)),
        }
    }

    /// Rates of the bodies.
    #[inline]
    fn rates(&self, beta: R) -> [R; 7] {
        let [gamma, sigma] = self.four_bar.ratio.map(|ratio| ratio * beta);
        let [chi, delta] = self.chi_delta.ratio.map(|ratio| ratio * gamma);
        let [omega, epsilon] = self.omega_epsilon.ratio.map(|ratio| ratio * gamma);
        [beta, sigma, gamma, chi, delta, omega, epsilon]
    }

    /// The acceleration of β: γ carries both outer pairs, then β carries everything.
    #[inline]
    fn acceleration(&self, gamma: R, rates: [R; 7]) -> R {
        let [j1, j2, j3, j4, j5, j6, j7] = DIAGONAL;
        let [b, s, g, x, d, o, e] = rates.map(|rate| rate * rate);
        let (more, torque) = self.chi_delta.felt([j4, j5], COUPLING[1], [g, x, d]);
        let (still_more, second_torque) = self.omega_epsilon.felt([j6, j7], COUPLING[2], [g, o, e]);
        let outer = more + still_more + j3;
        let torque = spring(gamma.sin_cos()) + torque + second_torque;

        let ([of_gamma, of_sigma], [gamma, sigma]) = (self.four_bar.ratio, self.four_bar.rest([b, g, s]));
        let (sin, cos) = (self.theta.0 * COUPLING[0], self.theta.1 * COUPLING[0]);
        let inertia = of_sigma * (of_sigma * j2 - cos * 2.0) + of_gamma * of_gamma * outer + j1;
        let on_beta = cos * sigma - sin * s + TORQUE;
        let on_sigma = sin * b - sigma * j2;
        (on_beta + of_sigma * on_sigma + of_gamma * (torque - outer * gamma)) / inertia
    }
}

/// Velocities of the coordinates when the bodies have these rates.
#[inline]
fn velocities<R: Number>([beta, sigma, gamma, chi, delta, omega, epsilon]: [R; 7]) -> [R; 7] {
    [beta, sigma - beta, gamma, chi - delta, delta, omega - epsilon, epsilon]
}

/// The coordinates and β': the loops give the other velocities.
#[derive(Clone, Copy)]
pub struct AndrewsReduced;

impl FirstOrder<8> for AndrewsReduced {
    #[inline]
    fn slope<R: Number>(_t: f64, y: &[R; 8], slope: &mut [R; 8]) {
        let [q @ .., beta] = y;
        let tree = Tree::new(q);
        let rates = tree.rates(*beta);
        let [v @ .., acceleration] = slope;
        *v = velocities(rates);
        *acceleration = tree.acceleration(q[2], rates);
    }

    fn motion(_t: f64, y: &[f64; 8]) -> Vec<f64> {
        let [q @ .., beta] = y;
        [*q, velocities(Tree::new(q).rates(*beta))].concat()
    }
}

/// Coordinates, velocities and the six multipliers, the accelerations eliminated: index 1.
#[derive(Clone, Copy)]
pub struct AndrewsMultipliers;

impl FirstOrder<20> for AndrewsMultipliers {
    const ALGEBRAIC: usize = 6;

    #[inline]
    fn slope<R: Number>(_t: f64, y: &[R; 20], slope: &mut [R; 20]) {
        let [q0, q1, q2, q3, q4, q5, q6, v0, v1, v2, v3, v4, v5, v6, forces @ ..] = *y;
        let angles = [q0, q0 + q1, q2, q3 + q4, q4, q5 + q6, q6];
        let rates = [v0, v0 + v1, v2, v3 + v4, v4, v5 + v6, v6];
        let turns = angles.map(R::sin_cos);
        let squares = rates.map(|rate| rate * rate);
        let accelerations = accelerations(&turns, &squares, &forces);
        slope[..7].copy_from_slice(&y[7..14]);
        slope[7..14].copy_from_slice(&velocities(accelerations));
        slope[14..].copy_from_slice(&openings(&turns, &squares, &accelerations));
    }
}

/// Accelerations of the bodies under the multipliers `forces`: four small blocks of the mass matrix.
#[inline]
fn accelerations<R: Number>(turns: &[(R, R); 7], squares: &[R; 7], forces: &[R; 6]) -> [R; 7] {
    let [beta, sigma, gamma, chi, delta, omega, epsilon] = *turns;
    let [j1, j2, j3, j4, j5, j6, j7] = DIAGONAL;
    let [b, s, _, x, d, o, e] = *squares;
    let [l0, l1, l2, l3, l4, l5] = *forces;
    // Along a link and across it.
    let along = |(sin, cos): (R, R), x: R, y: R| cos * x + sin * y;
    let across = |(sin, cos): (R, R), x: R, y: R| cos * y - sin * x;
    let (all_x, all_y) = (l0 + l2 + l4, l1 + l3 + l5);

    let (sin, cos) = difference(sigma, beta);
    let [first, second] = block(
        [j1, j2],
        -(cos * COUPLING[0]),
        [
            across(beta, all_x, all_y) * RR - sin * s * COUPLING[0] + TORQUE,
            sin * b * COUPLING[0] - across(sigma, all_x, all_y) * D,
        ],
    );
    let third = (spring(gamma) - along(gamma, l0, l1) * SS) * j3.recip();
    let (sin, cos) = difference(chi, delta);
    let [fourth, fifth] = block(
        [j4, j5],
        sin * COUPLING[1],
        [
            cos * d * COUPLING[1] - along(chi, l2, l3) * E,
            -(cos * x * COUPLING[1]) - across(delta, l2, l3) * ZT,
        ],
    );
    let (sin, cos) = difference(omega, epsilon);
    let [sixth, seventh] = block(
        [j6, j7],
        -(sin * COUPLING[2]),
        [
            -(cos * e * COUPLING[2]) - across(omega, l4, l5) * ZF,
            cos * o * COUPLING[2] - along(epsilon, l4, l5) * U,
        ],
    );
    [first, second, third, fourth, fifth, sixth, seventh]
}

/// Solves two equations with the matrix [[d₀, c], [c, d₁]].
#[inline]
fn block<R: Number>(diagonal: [f64; 2], coupling: R, [f, g]: [R; 2]) -> [R; 2] {
    let inverse = (-(coupling * coupling) + diagonal[0] * diagonal[1]).inverse();
    [(f * diagonal[1] - coupling * g) * inverse, (g * diagonal[0] - coupling * f) * inverse]
}

/// Accelerations at which the three loops open.
#[inline]
fn openings<R: Number>(turns: &[(R, R); 7], squares: &[R; 7], accelerations: &[R; 7]) -> [R; 6] {
    // Second derivatives of (cos, sin) of an angle, and of (sin, −cos).
    let [beta, sigma, _, _, delta, omega, _] = std::array::from_fn(|i| {
        let ((sin, cos), a, s) = (turns[i], accelerations[i], squares[i]);
        [-(sin * a) - cos * s, cos * a - sin * s]
    });
    let [_, _, gamma, chi, _, _, epsilon] = std::array::from_fn(|i| {
        let ((sin, cos), a, s) = (turns[i], accelerations[i], squares[i]);
        [cos * a - sin * s, sin * a + cos * s]
    });
    let pin: [R; 2] = std::array::from_fn(|i| beta[i] * RR - sigma[i] * D);
    let loops: [[R; 2]; 3] = [
        std::array::from_fn(|i| pin[i] - gamma[i] * SS),
        std::array::from_fn(|i| pin[i] - chi[i] * E - delta[i] * ZT),
        std::array::from_fn(|i| pin[i] - omega[i] * ZF - epsilon[i] * U),
    ];
    std::array::from_fn(|i| loops[i / 2][i % 2])
}
