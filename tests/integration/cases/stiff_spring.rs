//! C06: a pendulum on a very stiff spring, whose length oscillates 100 or 1000 times faster than it swings.

use lagrangian::prelude::*;

use super::HARD;
use crate::support::close::{between, close};
use crate::support::motion::{TIGHT, drift, follows};
use crate::support::reference::classical;

struct SpringPendulum {
    /// The period of the spring is 2π times this.
    eps: f64,
}

#[lagrangian(coordinates = [x, y])]
impl SpringPendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.bob(q).y
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        (self.bob(q).norm() - 1.0).powi(2) / (2.0 * self.eps.powi(2))
    }
}

fn reference(eps: &str) -> [(f64, [f64; 4]); 2] {
    let case = classical(&format!("C06_stiff_spring_pendulum_eps_{eps}"));
    [1, 5].map(|t| (f64::from(t), case.numbers(&format!("state({t})"))))
}

#[test]
fn the_states_agree_at_both_stiffnesses() {
    let start = State::at_rest([1.0, 0.0]);
    follows(&SpringPendulum { eps: 0.01 }, start, reference("0.01"), HARD);
    follows(&SpringPendulum { eps: 0.001 }, start, reference("0.001"), HARD);
}

#[test]
fn the_energy_stays_where_it_was() {
    let pendulum = SpringPendulum { eps: 0.01 };
    let start = State::at_rest([1.0, 0.0]);
    close(pendulum.energy(&start), 0.0, 1e-12);
    let mut motion = pendulum.simulate(start).with_tolerance(TIGHT);
    between(-1.0, drift(&mut motion, 0.05, 100, |s| pendulum.energy(s)), 1e-10);
}
