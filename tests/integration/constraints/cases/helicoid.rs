//! S12b, S12c: a particle on a helicoid under an affine nonholonomic constraint, constant and periodic in
//! time.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, G, MEDIUM};
use crate::support::close::close;
use crate::support::constrained::bound;
use crate::support::motion::{both_follow, state_at};
use crate::support::reference::seed;

/// z = α θ; the circumferential speed is −h cos ωt.
struct Helicoid {
    m: f64,
    alpha: f64,
    h: f64,
    omega: f64,
}

#[lagrangian(coordinates = [theta, r])]
impl Helicoid {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.m * (v.r.powi(2) + (q.r.powi(2) + self.alpha.powi(2)) * v.theta.powi(2)) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * self.alpha * q.theta
    }

    #[nonholonomic]
    fn speed(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        q.r * v.theta + self.h * (self.omega * t).cos()
    }
}

const CONSTANT: Helicoid = Helicoid { m: 2.0, alpha: 0.4, h: 0.6, omega: 0.0 };
const PERIODIC: Helicoid = Helicoid { omega: 3.0, ..CONSTANT };

fn start() -> State<f64, 2> {
    State::new([0.0, 0.5], [-1.2, 0.0])
}

#[test]
fn a_constant_speed_drives_the_particle_outward() {
    let reference = seed("S12b_nonintegrable");
    let (theta, r) = (reference.number("theta(1)"), reference.number("r(1)"));
    let row = [theta, r, -0.6 / r, reference.number("rd(1)")];
    both_follow(&CONSTANT, start(), [(1.0, row)], MEDIUM);
    let state = state_at(&CONSTANT, start(), 1.0);
    close(CONSTANT.reactions(&state).unwrap().speed, reference.number("constraint_force_lambda(1)"), MEDIUM);
    for t in [0.0, 0.4, 1.0] {
        let state = state_at(&CONSTANT, start(), t);
        close(CONSTANT.accelerations(&state).unwrap()[1], 0.36 / state.q[1], CLOSED_FORM);
    }
}

#[test]
fn a_periodic_speed_agrees() {
    let reference = seed("S12c_h(t)=0.6cos3t");
    both_follow(&PERIODIC, start(), reference.timed_rows::<4>("th_r_thd_rd"), MEDIUM);
    let state = state_at(&PERIODIC, start(), 3.0);
    close(PERIODIC.reactions(&state).unwrap().speed, reference.number("lambda(3)"), MEDIUM);
}

#[test]
fn the_constraint_does_work() {
    // v·Aᵀλ = λ r θ′ = −λ h cos ωt.
    for t in [0.2, 1.7] {
        let state = state_at(&PERIODIC, start(), t);
        let expected = -PERIODIC.reactions(&state).unwrap().speed * 0.6 * (3.0 * t).cos();
        close(PERIODIC.reaction_power(&state).unwrap(), expected, CLOSED_FORM);
        close(PERIODIC.energy_rate(&state).unwrap(), expected, CLOSED_FORM);
    }
}

#[test]
fn the_identities_hold() {
    bound!(CONSTANT, [false]).holds([0.0, 0.7].map(|t| state_at(&CONSTANT, start(), t)));
    bound!(PERIODIC, [false]).holds([0.0, 0.7, 2.0].map(|t| state_at(&PERIODIC, start(), t)));
}
