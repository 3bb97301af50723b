//! P01: Andrews' squeezing mechanism, seven bodies in three loops: the Test Set for IVP Solvers, index 3.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, EASY};
use crate::support::close::{all_close, close, close_on};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, state_at};
use crate::support::reference::published;

/// The torque on the crank.
struct Mechanism {
    torque: f64,
}

const M: [f64; 7] = [0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498];
const I: [f64; 7] = [2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5];

#[lagrangian(coordinates = [be, th, ga, ph, de, om, ep])]
impl Mechanism {
    const D: f64 = 0.028;
    const E: f64 = 0.02;
    const RR: f64 = 0.007;
    const SS: f64 = 0.035;
    const U: f64 = 0.04;
    const ZF: f64 = 0.02;
    const ZT: f64 = 0.04;

    fn a() -> Vector2<f64> {
        Vector2::new(-0.06934, -0.00227)
    }

    fn b() -> Vector2<f64> {
        Vector2::new(-0.03635, 0.03273)
    }

    /// Forward at an angle, and to its left.
    fn along(angle: f64) -> Vector2<f64> {
        Vector2::new(angle.cos(), angle.sin())
    }

    fn left(angle: f64) -> Vector2<f64> {
        Vector2::new(-angle.sin(), angle.cos())
    }

    #[body(mass = M[0], inertia = I[0])]
    fn crank(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (0.00092 * Self::along(q.be), q.be)
    }

    #[body(mass = M[1], inertia = I[1])]
    fn coupler(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Self::RR * Self::along(q.be) - 0.0115 * Self::along(q.be + q.th), q.be + q.th)
    }

    #[body(mass = M[2], inertia = I[2])]
    fn triangle(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Self::b() - 0.01874 * Self::left(q.ga) + 0.01043 * Self::along(q.ga), q.ga)
    }

    #[body(mass = M[3], inertia = I[3])]
    fn upper_link(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        let arm = (Self::E - 0.01421) * Self::left(q.ph + q.de);
        (Self::a() + Self::ZT * Self::along(q.de) - arm, q.ph + q.de)
    }

    #[body(mass = M[4], inertia = I[4])]
    fn upper_plate(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Self::a() + 0.02308 * Self::along(q.de) + 0.00916 * Self::left(q.de), q.de)
    }

    #[body(mass = M[5], inertia = I[5])]
    fn lower_link(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        let arm = (Self::ZF - 0.01421) * Self::along(q.om + q.ep);
        (Self::a() - Self::U * Self::left(q.ep) + arm, q.om + q.ep)
    }

    #[body(mass = M[6], inertia = I[6])]
    fn lower_plate(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Self::a() - 0.01228 * Self::left(q.ep) - 0.00449 * Self::along(q.ep), q.ep)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        let end = Self::b() + 0.02 * Self::along(q.ga) - 0.018 * Self::left(q.ga);
        4530.0 * ((end - Vector2::new(0.014, 0.072)).norm() - 0.07785).powi(2) / 2.0
    }

    #[force(on = be)]
    fn drive(&self) -> f64 {
        self.torque
    }

    #[holonomic]
    fn loops(&self, q: &Coordinates) -> [f64; 6] {
        let end = Self::RR * Self::along(q.be) - Self::D * Self::along(q.be + q.th);
        let triangle = end + Self::SS * Self::left(q.ga) - Self::b();
        let upper = end + Self::E * Self::left(q.ph + q.de) - Self::ZT * Self::along(q.de) - Self::a();
        let lower = end - Self::ZF * Self::along(q.om + q.ep) + Self::U * Self::left(q.ep) - Self::a();
        [triangle.x, triangle.y, upper.x, upper.y, lower.x, lower.y]
    }
}

const MECHANISM: Mechanism = Mechanism { torque: 0.033 };

fn start() -> State<f64, 7> {
    State::at_rest([
        -0.061_713_890_014_276_45,
        0.0,
        0.455_279_819_163_070_4,
        0.222_668_390_165_885_9,
        0.487_364_979_543_842_55,
        -0.222_668_390_165_885_9,
        1.230_547_444_549_821_2,
    ])
}

#[test]
fn accelerations_and_reactions_at_the_start_agree() {
    let [be, th, rest @ ..] = MECHANISM.accelerations(&start()).unwrap();
    all_close([be, th], [14_222.443_919_954_114, -10_666.832_939_965_585], CLOSED_FORM);
    for a in rest {
        close_on(14222.0, a, 0.0, CLOSED_FORM);
    }
    let [x, y, rest @ ..] = MECHANISM.reactions(&start()).unwrap().loops;
    all_close([x, y], [-98.566_870_396_241_09, 6.122_688_344_255_662], CLOSED_FORM);
    for lambda in rest {
        close_on(98.0, lambda, 0.0, CLOSED_FORM);
    }
}

fn agrees<M>()
where
    M: lagrangian::Adaptive<Mechanism, lagrangian::Held<f64, 0>, 7, 0>,
{
    let mut motion = MECHANISM.simulate_with::<M>(start()).with_tolerance(TIGHT);
    let energy = motion.energy();
    for (t, row) in published("andrews").timed_rows::<14>("states") {
        let state = *motion.advance_to(t).unwrap();
        all_close([state.q, state.v].concat(), row, EASY);
        let work = MECHANISM.torque * (state.q[0] - start().q[0]);
        close(motion.energy() - energy, work, EASY);
        // The lengths are centimetres.
        for residual in MECHANISM.constraint_residuals(&state) {
            close_on(0.04, residual, 0.0, 1e-14);
        }
    }
}

#[test]
fn the_states_agree_and_the_energy_balances() {
    agrees::<Jets>();
}

#[test]
fn the_states_agree_by_dop853() {
    agrees::<Dop853>();
}

#[test]
fn reactions_and_accelerations_at_speed_agree() {
    let reference = published("andrews");
    let mut motion = MECHANISM.simulate(start()).with_tolerance(TIGHT);
    let state = *motion.advance_to(0.03).unwrap();
    all_close(motion.reactions().loops, reference.numbers::<6>("lam_0.03_(M a = f + J^T lam)"), EASY);
    all_close(MECHANISM.accelerations(&state).unwrap(), reference.numbers::<7>("acc_0.03"), EASY);
    close(MECHANISM.energy_rate(&state).unwrap(), MECHANISM.torque * state.v[0], CLOSED_FORM);
    assert_eq!(MECHANISM.reaction_power(&state).unwrap(), 0.0);
}

#[test]
fn the_identities_hold() {
    // The states are slowed down, because differences want rates of order one.
    let states = [0.004, 0.017].map(|t| {
        let state = state_at(&MECHANISM, start(), t);
        State { v: state.v.map(|v| v / 500.0), ..state }
    });
    bound!(MECHANISM, [true; 6], forces).holds(states);
}
