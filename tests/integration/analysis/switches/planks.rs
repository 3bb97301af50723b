//! Strikes while another contact bears: its gap does not vary, and the derivatives go on.

use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::difference::derivative;
use crate::support::sample::Samples;

/// A plank whose left end lies on the floor and whose right end falls onto it.
struct Plank {
    inertia: f64,
}

#[lagrangian(coordinates = [x, y, turn], jacobians)]
impl Plank {
    #[body(mass = 1.0, inertia = self.inertia)]
    fn plank(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, q.y), q.turn)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    fn end(&self, q: &Coordinates, side: f64) -> Vector2<f64> {
        Vector2::new(q.x, q.y) + side * Vector2::new(q.turn.cos(), q.turn.sin())
    }

    #[unilateral(restitution = 0.0)]
    fn left(&self, q: &Coordinates) -> f64 {
        self.end(q, -1.0).y
    }

    #[unilateral(restitution = 0.0)]
    fn right(&self, q: &Coordinates) -> f64 {
        self.end(q, 1.0).y
    }
}

#[test]
fn a_plank_falls_flat_with_derivatives() {
    let mut samples = Samples::new(1);
    let mut flat = 0;
    for _ in 0..40 {
        // A slimmer plank would rock from end to end.
        let plank = Plank { inertia: samples.number(0.2, 0.95) };
        let (turn, speed) = (samples.number(0.1, 0.6), samples.number(-1.0, 1.0));
        let start = |by: f64| {
            let turn = turn + by;
            State { t: 0.0, q: [0.0, turn.sin(), turn], v: [speed, 0.0, 0.0] }
        };
        let until = samples.number(0.3, 0.9);
        let strike = plank.simulate(start(0.0)).advance_to_switch(2.0).unwrap().unwrap().state.t;
        // Differences lead across the strike if they begin beside it.
        if (strike - until).abs() < 0.05 {
            continue;
        }
        let varied = plank.variational();
        let mut motion = varied.motion(start(0.0)).unwrap().with_tolerance(1e-12);
        let found = motion.advance_to(until).unwrap_or_else(|error| panic!("{turn} {speed}: {error}"));
        let at = |by| *plank.simulate(start(by)).with_tolerance(1e-13).advance_to(until).unwrap();
        let by_turn = derivative(1e-3, |by| at(by).q);
        for row in 0..3 {
            let along = found.q_by_q[(row, 1)] * turn.cos() + found.q_by_q[(row, 2)];
            close_on(1.0, along, by_turn[row], 1e-8);
        }
        flat += usize::from(at(0.0).q[2] == 0.0);
    }
    assert!(flat > 10, "{flat}");
}
