//! A ball that rolls over the edge of a table, slips and leaves it: contacts and friction with a kink in the
//! gap, and friction whose coefficient has no Taylor series.

use lagrangian::prelude::*;

use crate::support::close::close;

const RADIUS: f64 = 0.1;
/// The speed with which the ball comes to the edge \[m/s].
const SPEED: f64 = 0.05;
const MU: f64 = 0.6;
/// When the ball begins to slip, and when it leaves the edge, after it has come there \[s]: by quadrature of
/// the rolling motion and Taylor's method of the sliding one, in 25 digits (mpmath).
const SLIPS: f64 = 0.388_311_921_615_576_9;
const LEAVES: f64 = 0.411_768_761_146_941_8;
/// The spin with which it leaves \[rad/s].
const SPIN: f64 = -6.854_146_236_222_562;

struct Edge {
    mu: f64,
}

#[lagrangian(coordinates = [x, y, phi])]
impl Edge {
    #[body(mass = 0.5, inertia = 0.4 * 0.5 * RADIUS * RADIUS)]
    fn ball(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.phi)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        0.5 * 9.81 * q.y
    }

    #[unilateral]
    fn table(&self, q: &Coordinates) -> f64 {
        q.x.max(0.0).hypot(q.y) - RADIUS
    }

    #[friction(coefficient = self.mu, normal = table)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let across = q.x.max(0.0);
        (v.x * q.y - v.y * across) / across.hypot(q.y) + RADIUS * v.phi
    }
}

/// The edge alone, with a coefficient that has a kink somewhere else, which nothing else has.
struct Rough {
    mu: f64,
}

#[lagrangian(coordinates = [x, y, phi])]
impl Rough {
    #[body(mass = 0.5, inertia = 0.4 * 0.5 * RADIUS * RADIUS)]
    fn ball(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.phi)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        0.5 * 9.81 * q.y
    }

    #[unilateral]
    fn edge(&self, q: &Coordinates) -> f64 {
        q.x.hypot(q.y) - RADIUS
    }

    fn coefficient(&self, q: &Coordinates) -> f64 {
        self.mu * (q.x - 1.0).abs() / (1.0 - q.x)
    }

    #[friction(coefficient = coefficient, normal = edge)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        (v.x * q.y - v.y * q.x) / q.x.hypot(q.y) + RADIUS * v.phi
    }
}

/// The rest of the way of a ball that comes to the edge at a time: a hundred steps may each have an error of
/// the tolerance.
macro_rules! leaves {
    ($motion:expr, $arrives:expr, $tolerance:expr) => {{
        let (motion, share) = (&mut $motion, 100.0 * $tolerance);
        let slips = motion.advance_to_switch(9.0).unwrap().unwrap();
        close(slips.state.t - $arrives, SLIPS, share);
        let leaves = motion.advance_to_switch(9.0).unwrap().unwrap();
        close(leaves.state.t - $arrives, LEAVES, share);
        close(leaves.state.v[2], SPIN, share);
    }};
}

#[test]
fn a_gap_with_a_kink_limits_friction_on_both_sides_of_it() {
    for tolerance in [1e-8, 1e-10, 1e-13] {
        let start = State::new([-0.05, RADIUS, 0.0], [SPEED, 0.0, -SPEED / RADIUS]);
        let ball = Edge { mu: MU };
        let mut motion = ball.simulate(start).with_tolerance(tolerance);
        let arrives = motion.advance_to_switch(9.0).unwrap().unwrap();
        close(arrives.state.t, 1.0, 1e-14);
        leaves!(motion, 1.0, tolerance);
    }
}

#[test]
fn a_coefficient_without_a_series_leaves_the_motion_as_accurate_as_it_is_asked_for() {
    for tolerance in [1e-8, 1e-10, 1e-13] {
        let start = State::new([0.0, RADIUS, 0.0], [SPEED, 0.0, -SPEED / RADIUS]);
        let ball = Rough { mu: MU };
        leaves!(ball.simulate(start).with_tolerance(tolerance), 0.0, tolerance);
    }
}
