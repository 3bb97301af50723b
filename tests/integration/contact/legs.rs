//! Two contacts of one body that meet at the origin, where no coordinate has a size of its own.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{close, close_on};

struct Legs {
    /// Height of the floor \[m].
    floor: f64,
}

#[lagrangian(coordinates = [y, theta])]
impl Legs {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        1.5 * v.y * v.y + 0.5 * v.theta * v.theta
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        3.0 * 9.81 * q.y
    }

    #[unilateral]
    fn legs(&self, q: &Coordinates) -> [f64; 2] {
        [q.y - self.floor - 0.6 * q.theta, q.y - self.floor + 0.3 * q.theta]
    }
}

#[test]
fn both_legs_bear_the_body_after_any_fall() {
    for floor in [0.0, 1.0, 1e-3] {
        let legs = Legs { floor };
        for drop in 0..40 {
            let height = 0.1 + 0.05 * f64::from(drop);
            let mut motion = legs.simulate(State::at_rest([floor + height, 0.0]));
            close_on(1.0, motion.advance_to(2.0).unwrap().q[0], floor, 1e-15);
            let reactions = motion.reactions().legs;
            // N₁ + N₂ = 3 g and 0.6 N₁ = 0.3 N₂.
            close(reactions[0], 9.81, 1e-12);
            close(reactions[1], 19.62, 1e-12);
        }
    }
}

/// A block on a table that swings up and down.
struct Table;

const SWING: f64 = 0.02;
const RATE: f64 = 30.0;

#[lagrangian(coordinates = [y])]
impl Table {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.5 * v.y * v.y
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral]
    fn table(&self, q: &Coordinates, t: f64) -> f64 {
        q.y - SWING * (RATE * t).sin()
    }
}

#[test]
fn a_block_leaves_a_table_at_whatever_time() {
    // At late times rounding places some of the events before and some behind their exact times.
    for start in 0..120 {
        let t = 1.37 * f64::from(start);
        let (sin, cos) = (RATE * t).sin_cos();
        let on_table = State::new([SWING * sin], [SWING * RATE * cos]).at_time(t);
        let mut motion = Table.simulate(on_table).with_tolerance(if start % 2 == 0 { TIGHT } else { 1e-10 });
        let mut left = 0;
        while let Some(switch) = motion.advance_to_switch(t + 1.0).unwrap() {
            let opens = (switch.before.v[0] - switch.state.v[0]).abs() < 1e-9;
            if opens {
                // Where the table falls as fast as the block: g / (a ω²) is the sine.
                close((RATE * switch.state.t).sin(), 9.81 / (SWING * RATE * RATE), 1e-10);
                left += 1;
            }
        }
        assert!((4..=6).contains(&left), "{left} times in 4.8 periods from {t}");
    }
}
