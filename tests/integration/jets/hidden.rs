//! Things that a series cannot know where it starts: walls far away, switches thrown later, steep friction.
//! References by Dormand–Prince, whose stages look into a step, or closed forms.

use std::f64::consts::PI;

use lagrangian::prelude::*;
use lagrangian::{Batch, Smooth};

use super::line::line;
use crate::support::close::{between, close_on};

line!(Barrier { width }, |self, q, _v, _t| (-(q.x / self.width).powi(2)).exp(), 0.0);
line!(Friction { width }, |self, q, v, _t| 50.0 * q.x * q.x, -(v.x / self.width).tanh());
line!(Switch { width }, |self, q, _v, t| 0.5 * q.x * q.x, 0.5 * (1.0 + ((t - 5.0) / self.width).tanh()));
line!(Pulse { width }, |self, q, _v, t| 0.0 * q.x, (-((t - 50.0) / self.width).powi(2)).exp());
line!(SwitchAtRest { width }, |self, q, _v, t| 0.0 * q.x, 0.5 * (1.0 + ((t - 5.0) / self.width).tanh()));
line!(
    Floor { width },
    |self, q, _v, _t| 9.81 * q.x + 5e4 * (self.width * (-q.x / self.width).exp().ln_1p()).powi(2),
    0.0
);
line!(Sech { width }, |self, q, _v, _t| (q.x / self.width).cosh().powi(-2), 0.0);
line!(Morse { width }, |self, q, _v, _t| (1.0 - (-q.x / self.width).exp()).powi(2), 0.0);
line!(
    LennardJones { width },
    |self, q, _v, _t| (self.width / q.x).powi(12) - (self.width / q.x).powi(6),
    0.0
);
line!(WoodsSaxon { width }, |self, q, _v, _t| 1.0 / (1.0 + (-q.x / self.width).exp()), 0.0);
line!(
    Smoothed { width },
    |self, q, v, _t| 50.0 * q.x * q.x,
    -v.x / (v.x * v.x + self.width * self.width).sqrt()
);

/// The same motion by both methods at several tolerances.
fn same<S>(name: &str, system: &S, start: State<f64, 1>, t: f64)
where
    S: Smooth<1, Scalar = f64, Method = Jets>,
{
    let mut reference = system.simulate_with::<Dop853>(start).with_tolerance(1e-13);
    let exact = reference.advance_to(t).unwrap().q[0];
    ends_at(name, system, start, t, exact);
}

/// The place at a time, at several tolerances.
fn ends_at<S>(name: &str, system: &S, start: State<f64, 1>, t: f64, exact: f64)
where
    S: Smooth<1, Scalar = f64, Method = Jets>,
{
    let size = exact.abs().max(start.q[0].abs());
    for (tolerance, bound) in [(1e-6, 2e-3), (1e-10, 1e-6), (1e-13, 1e-8)] {
        let mut motion = system.simulate(start).with_tolerance(tolerance);
        let end = *motion.advance_to(t).unwrap();
        println!(
            "{name} at {tolerance:e}: {} against {}, {} steps",
            end.q[0],
            exact,
            motion.steps().accepted
        );
        close_on(size, end.q[0], exact, bound);
        let mut batch = Batch::new(system, start).with_tolerance(tolerance);
        close_on(size, batch.advance_to(t).unwrap().q[0], exact, bound);
        between(0.0, motion.steps().accepted as f64, 3e3);
    }
}

#[test]
fn walls_far_away_are_hit() {
    for x in [-10.0, -30.0] {
        same("barrier", &Barrier { width: 1.0 }, State::new([x], [1.0]), 3.0 * -x - 10.0);
    }
    same("sech²", &Sech { width: 1.0 }, State::new([-25.0], [1.0]), 40.0);
    same("Morse", &Morse { width: 1.0 }, State::new([45.0], [-1.0]), 60.0);
    same("Lennard-Jones", &LennardJones { width: 1.0 }, State::new([50.0], [-1.0]), 90.0);
    same("Woods-Saxon", &WoodsSaxon { width: 0.5 }, State::new([-20.0], [1.0]), 30.0);
    same("floor", &Floor { width: 0.01 }, State::new([1.0], [0.0]), 1.0);
}

#[test]
fn switches_are_thrown_in_time() {
    for width in [0.1, 0.01] {
        same("switch", &Switch { width }, State::new([1.0], [0.0]), 10.0);
        // The force before the switch and what it lacks after it make a moment of w² π² / 24.
        let exact = 12.5 + (width * PI).powi(2) / 24.0;
        ends_at("switch at rest", &SwitchAtRest { width }, State::at_rest([0.0]), 10.0, exact);
    }
    // The speed by the pulse, √π, for the second half of the time.
    let way = 50.0 * PI.sqrt();
    ends_at("pulse", &Pulse { width: 1.0 }, State::at_rest([0.0]), 100.0, way);
    ends_at("pulse", &Pulse { width: 1.0 }, State::new([3.0], [-0.1]), 100.0, way - 7.0);
}

#[test]
fn steep_friction_brakes() {
    same("friction", &Friction { width: 1e-2 }, State::at_rest([0.1]), 1.0);
    same("smoothed friction", &Smoothed { width: 1e-2 }, State::at_rest([0.1]), 1.0);
    same("smoothed friction", &Smoothed { width: 1e-4 }, State::at_rest([0.1]), 1.0);
    let system = Friction { width: 1e-4 };
    let mut motion = system.simulate(State::at_rest([0.1]));
    motion.advance_to(10.0).unwrap();
    between(0.0, motion.state().v[0].abs(), 1e-4);
}
