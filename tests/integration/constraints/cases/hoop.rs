//! S14 in its second form: a bead in space, held by a sphere and by a plane that whirls at a given rate.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, between, close, close_on};
use crate::support::constrained::bound;
use crate::support::difference::{STEP, slope};
use crate::support::motion::{TIGHT, both_follow, drift, state_at};
use crate::support::reference::seed;

#[derive(Clone, Copy)]
struct Hoop {
    m: f64,
    radius: f64,
    rate: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl Hoop {
    #[point(mass = self.m)]
    fn bead(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * q.z
    }

    #[holonomic]
    fn wire(&self, q: &Coordinates) -> f64 {
        self.bead(q).norm() - self.radius
    }

    #[holonomic]
    fn plane(&self, q: &Coordinates, t: f64) -> f64 {
        q.y * (self.rate * t).cos() - q.x * (self.rate * t).sin()
    }
}

const HOOP: Hoop = Hoop { m: 1.0, radius: 0.5, rate: 6.0 };

/// The bead at an angle from the upward vertical, with its rate, at a time.
fn bead(hoop: Hoop, phi: f64, dphi: f64, t: f64) -> State<f64, 3> {
    let ((up, out), (sin, cos)) = (phi.sin_cos(), (hoop.rate * t).sin_cos());
    let (r, rate) = (hoop.radius, hoop.rate);
    State::new(
        [r * up * cos, r * up * sin, r * out],
        [r * (out * dphi * cos - up * rate * sin), r * (out * dphi * sin + up * rate * cos), -r * up * dphi],
    )
    .at_time(t)
}

/// The acceleration of the angle for a bead at rest on the hoop.
fn turning(hoop: Hoop, phi: f64) -> f64 {
    let a = hoop.accelerations(&bead(hoop, phi, 0.0, 0.0)).unwrap();
    // Along the wire a bead at rest on it has R φ″ − R Ω² sin φ cos φ.
    let (up, out) = phi.sin_cos();
    let along = a[0] * out - a[2] * up;
    along / hoop.radius + hoop.rate.powi(2) * up * out
}

/// E − Ω L about the axis.
fn jacobi(state: &State<f64, 3>) -> f64 {
    let ([x, y, _], [vx, vy, _]) = (state.q, state.v);
    HOOP.energy(state) - HOOP.rate * HOOP.m * (x * vy - y * vx)
}

#[test]
fn the_states_agree() {
    let rows = seed("S14").timed_rows::<2>("ph_phd");
    let rows = rows.into_iter().map(|(t, [phi, dphi])| {
        let state = bead(HOOP, phi, dphi, t);
        (t, [state.q[0], state.q[1], state.q[2], state.v[0], state.v[1], state.v[2]])
    });
    both_follow(&HOOP, bead(HOOP, 2.0, 0.3, 0.0), rows, EASY);
}

#[test]
fn the_plane_pushes_and_does_work() {
    let reference = seed("S14");
    let mut motion = HOOP.simulate(bead(HOOP, 2.0, 0.3, 0.0)).with_tolerance(TIGHT);
    motion.advance_to(1.0).unwrap();
    close(motion.reactions().plane, reference.number("N_theta(1)"), EASY);
    for state in motion.every(0.2).take(10) {
        let state = state.unwrap();
        let [x, y, _] = state.q;
        let expected = HOOP.reactions(&state).unwrap().plane * HOOP.rate * x.hypot(y);
        close(HOOP.energy_rate(&state).unwrap(), expected, CLOSED_FORM);
        close(HOOP.reaction_power(&state).unwrap(), expected, CLOSED_FORM);
    }
}

#[test]
fn the_wire_holds_by_the_textbook() {
    // m R (φ′² + Ω² sin² φ) towards the centre, less the weight along the wire's radius.
    for (phi, dphi) in [(2.0_f64, 0.3_f64), (1.0, -2.0), (2.9, 5.0)] {
        let state = bead(HOOP, phi, dphi, 0.7);
        let (up, out) = phi.sin_cos();
        let centripetal = HOOP.radius * (dphi * dphi + (HOOP.rate * up).powi(2));
        let reactions = HOOP.reactions(&state).unwrap();
        close(reactions.wire, HOOP.m * (G * out - centripetal), CLOSED_FORM);
        close(reactions.plane, 2.0 * HOOP.m * HOOP.rate * HOOP.radius * out * dphi, CLOSED_FORM);
    }
}

#[test]
fn equilibria_and_their_frequencies_agree() {
    let reference = seed("S14");
    let place = reference.number("phi_eq");
    for phi in [0.0, std::f64::consts::PI, place] {
        close_on(G / HOOP.radius, turning(HOOP, phi), 0.0, CLOSED_FORM);
    }
    let omega = (-slope(STEP, |x| turning(HOOP, place + x))).sqrt();
    close(omega, reference.number("omega_about_eq"), CLOSED_FORM);
    let slow = Hoop { rate: 3.0, ..HOOP };
    let omega = (-slope(STEP, |x| turning(slow, std::f64::consts::PI + x))).sqrt();
    close(omega, reference.number("omega_bottom_at_Omega_3"), CLOSED_FORM);
    // The bottom loses its stability at the critical rate.
    let critical = Hoop { rate: reference.number("critical_Omega"), ..HOOP };
    close_on(G / HOOP.radius, slope(STEP, |x| turning(critical, std::f64::consts::PI + x)), 0.0, CLOSED_FORM);
}

#[test]
fn the_jacobi_integral_stays_and_the_energy_does_not() {
    let start = bead(HOOP, 2.0, 0.3, 0.0);
    let expected = seed("S14").number("jacobi");
    close(jacobi(&start), expected, CLOSED_FORM);
    let mut motion = HOOP.simulate(start).with_tolerance(TIGHT);
    between(-1.0, drift(&mut motion, 0.1, 100, jacobi), 1e-11);
    let mut motion = HOOP.simulate(start).with_tolerance(TIGHT);
    between(0.1, drift(&mut motion, 0.1, 100, |s| HOOP.energy(s)), 10.0);
}

#[test]
fn the_identities_hold() {
    let start = bead(HOOP, 2.0, 0.3, 0.0);
    bound!(HOOP, [true; 2]).holds([0.0, 0.4, 1.1].map(|t| state_at(&HOOP, start, t)));
    all_close(HOOP.constraint_rates(&start), [0.0, 0.0], CLOSED_FORM);
}
