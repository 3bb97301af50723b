//! S17: a particle on an incline that moves up and down: the balance of energy with a moving constraint.

use lagrangian::prelude::*;

use crate::cases::{CLOSED_FORM, EASY, G};
use crate::support::close::{all_close, close};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, both_follow, state_at};
use crate::support::reference::seed;

struct MovingIncline {
    m: f64,
}

#[lagrangian(coordinates = [x, y])]
impl MovingIncline {
    #[point(mass = self.m)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * q.y
    }

    #[holonomic]
    fn plane(&self, q: &Coordinates, t: f64) -> f64 {
        q.y - q.x / 2.0 - (3.0 * t).sin() / 10.0
    }
}

const INCLINE: MovingIncline = MovingIncline { m: 2.0 };

fn start() -> State<f64, 2> {
    State::new([0.0, 0.0], [0.0, 0.3])
}

/// λ = m (g + y″) with y″ = x″/2 − 0.9 sin 3t and x″ = −λ/(2m).
fn reaction(t: f64) -> f64 {
    INCLINE.m * (G - 0.9 * (3.0 * t).sin()) / 1.25
}

#[test]
fn the_particle_slides_as_the_closed_form_says() {
    let reference = seed("S17");
    let expected = [reference.number("x(2)"), reference.number("y(2)")];
    // x″ = −(2/5)(g − 0.9 sin 3t), integrated once.
    let vx = -0.4 * (G * 2.0 - 0.3 * (1.0 - 6.0_f64.cos()));
    let row = [expected[0], expected[1], vx, vx / 2.0 + 0.3 * 6.0_f64.cos()];
    both_follow(&INCLINE, start(), [(2.0, row)], EASY);
}

#[test]
fn the_moving_constraint_does_work() {
    let reference = seed("S17");
    let mut motion = INCLINE.simulate(start()).with_tolerance(TIGHT);
    let state = *motion.advance_to(2.0).unwrap();
    close(motion.reactions().plane, reference.number("lambda(2)_m=2"), EASY);
    close(INCLINE.energy_rate(&state).unwrap(), reference.number("dE/dt(2)"), EASY);
    close(INCLINE.reaction_power(&state).unwrap(), reference.number("dE/dt(2)"), EASY);
    for t in [0.0, 0.3, 1.1, 5.0] {
        let state = state_at(&INCLINE, start(), t);
        let reactions = INCLINE.reactions(&state).unwrap();
        close(reactions.plane, reaction(t), CLOSED_FORM);
        close(INCLINE.energy_rate(&state).unwrap(), reaction(t) * 0.3 * (3.0 * t).cos(), CLOSED_FORM);
        let force = INCLINE.reaction_forces(&state).unwrap().plane;
        all_close(force, [-reactions.plane / 2.0, reactions.plane], CLOSED_FORM);
    }
}

#[test]
fn the_identities_hold() {
    bound!(INCLINE, [true]).holds([0.0, 0.4, 2.0].map(|t| state_at(&INCLINE, start(), t)));
}
