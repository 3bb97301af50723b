//! S15: a particle on a smooth parabola without gravity.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, MEDIUM};
use crate::support::close::close;
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, state_at};
use crate::support::reference::seed;

struct Parabola {
    m: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Parabola {
    #[point(mass = self.m)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[holonomic]
    fn wire(&self, q: &Coordinates) -> f64 {
        q.x - q.y.powi(2) + 4.0
    }
}

const PARABOLA: Parabola = Parabola { m: 1.0 };

/// On the wire with speed 2 towards positive y.
fn moving(y: f64) -> State<f64, 2> {
    let rate = 2.0 / (2.0 * y).hypot(1.0);
    State::new([y * y - 4.0, y], [2.0 * y * rate, rate])
}

#[test]
fn the_place_and_the_reaction_agree() {
    let reference = seed("S15");
    let (y, lambda) =
        (reference.number("smooth: y(1)"), reference.number("smooth: lambda(1)=2 m v^2/(1+4y^2)^2"));
    let mut motion = PARABOLA.simulate(moving(-1.0)).with_tolerance(TIGHT);
    let mut dop853 = PARABOLA.simulate_with::<Dop853>(moving(-1.0)).with_tolerance(TIGHT);
    for state in [*motion.advance_to(1.0).unwrap(), *dop853.advance_to(1.0).unwrap()] {
        close(state.q[1], y, MEDIUM);
        close(state.q[0], y * y - 4.0, MEDIUM);
        close(PARABOLA.reactions(&state).unwrap().wire, lambda, MEDIUM);
    }
    close(motion.reactions().wire, lambda, MEDIUM);
}

#[test]
fn the_speed_stays() {
    let mut motion = PARABOLA.simulate(moving(-1.0)).with_tolerance(TIGHT);
    for state in motion.every(0.25).take(40) {
        let [vx, vy] = state.unwrap().v;
        close(vx.hypot(vy), 2.0, CLOSED_FORM);
    }
}

#[test]
fn the_reaction_is_a_closed_form_of_the_place() {
    for y in [-1.0, 0.0, 0.4, 3.0_f64] {
        let expected = 2.0 * 4.0 / (1.0 + 4.0 * y * y).powi(2);
        close(PARABOLA.reactions(&moving(y)).unwrap().wire, expected, CLOSED_FORM);
    }
}

#[test]
fn the_identities_hold() {
    bound!(PARABOLA, [true]).holds([moving(-1.0), state_at(&PARABOLA, moving(-1.0), 1.0)]);
}
