//! C11: a skate on an incline, which does not slide down.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, close, close_on};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, both_follow, state_at};
use crate::support::reference::classical;

/// x points down the incline.
struct Skate {
    angle: f64,
}

#[lagrangian(coordinates = [x, y, f])]
impl Skate {
    #[point(mass = 1.0)]
    fn place(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[kinetic]
    fn rotation(&self, v: &Velocities) -> f64 {
        0.1 * v.f.powi(2) / 2.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -G * self.angle.sin() * q.x
    }

    #[nonholonomic]
    fn blade(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.x * q.f.sin() - v.y * q.f.cos()
    }
}

const SKATE: Skate = Skate { angle: 0.4 };
const OMEGA: f64 = 1.5;

fn start() -> State<f64, 3> {
    State::new([0.0; 3], [0.0, 0.0, OMEGA])
}

/// The cycloid of the closed form.
fn cycloid(t: f64) -> [f64; 6] {
    let size = G * SKATE.angle.sin() / (2.0 * OMEGA * OMEGA);
    let (sin, cos) = (OMEGA * t).sin_cos();
    let along = 2.0 * size * OMEGA * sin;
    [size * sin * sin, size * (OMEGA * t - sin * cos), OMEGA * t, along * cos, along * sin, OMEGA]
}

#[test]
fn the_skate_follows_a_cycloid() {
    let reference = classical("C11_skate_on_incline");
    both_follow(&SKATE, start(), [0.5, 2.0, 9.0].map(|t| (t, cycloid(t))), EASY);
    let state = state_at(&SKATE, start(), 2.0);
    close(state.q[0], reference.number("x(2)_downslope"), EASY);
    close(state.q[1], reference.number("y(2)"), EASY);
    // After each half turn it is back on its level, drifted across.
    let turn = std::f64::consts::PI / OMEGA;
    let state = state_at(&SKATE, start(), 4.0 * turn);
    close_on(1.0, state.q[0], 0.0, 1e-12);
    close(state.q[1], 4.0 * turn * reference.number("mean_cross_drift"), EASY);
}

#[test]
fn the_blade_reacts() {
    let mut motion = SKATE.simulate(start()).with_tolerance(TIGHT);
    motion.advance_to(2.0).unwrap();
    close(motion.reactions().blade, classical("C11_skate_on_incline").number("lambda(2)"), EASY);
    for state in motion.every(0.3).take(10) {
        let state = state.unwrap();
        // Across the blade: centripetal force and weight, each g sin α sin ωt.
        let expected = -2.0 * G * SKATE.angle.sin() * state.q[2].sin();
        let reactions = SKATE.reactions(&state).unwrap();
        close_on(G, reactions.blade, expected, CLOSED_FORM);
        let (sin, cos) = state.q[2].sin_cos();
        let force = SKATE.reaction_forces(&state).unwrap().blade;
        all_close(force, [reactions.blade * sin, -reactions.blade * cos, 0.0], CLOSED_FORM);
        assert_eq!(SKATE.reaction_power(&state).unwrap(), 0.0);
    }
}

#[test]
fn the_identities_hold() {
    bound!(SKATE, [false]).holds([0.3, 1.9].map(|t| state_at(&SKATE, start(), t)));
}
