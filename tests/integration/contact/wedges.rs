//! Impacts from two sides: a light ball between heavy ones that come nearer, a wheel between floor and step.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};
use crate::support::sample::Samples;

/// Three balls on a line.
#[derive(Clone, Copy)]
struct Pinch {
    masses: [f64; 3],
    restitution: f64,
}

#[lagrangian(coordinates = [x: [3]])]
impl Pinch {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        let mut sum = 0.0;
        for i in 0..3 {
            sum += 0.5 * self.masses[i] * v.x[i] * v.x[i];
        }
        sum
    }

    #[unilateral(restitution = self.restitution)]
    fn gaps(&self, q: &Coordinates) -> [f64; 2] {
        [q.x[1] - q.x[0], q.x[2] - q.x[1]]
    }
}

/// Where the middle ball strikes both in turn, whatever the gaps are, Newton's law gives all velocities.
fn struck_in_turn(pinch: &Pinch, mut v: [f64; 3], first: usize) -> [f64; 3] {
    let mut pair = first;
    for _ in 0..300_000 {
        let closing = v[pair] - v[pair + 1];
        if closing > 1e-15 {
            let [a, b] = [pinch.masses[pair], pinch.masses[pair + 1]];
            let impulse = (1.0 + pinch.restitution) * closing * a * b / (a + b);
            v[pair] -= impulse / a;
            v[pair + 1] += impulse / b;
        } else if v[1 - pair] - v[2 - pair] <= 1e-15 {
            break;
        }
        pair = 1 - pair;
    }
    v
}

#[test]
fn a_ball_between_heavy_ones_strikes_them_in_turn() {
    let mut samples = Samples::new(5);
    for number in 0..200 {
        let heavy = [30.0, 300.0, 3000.0, 30000.0][number % 4];
        let pinch = Pinch {
            masses: [heavy * samples.number(0.5, 2.0), 1.0, heavy * samples.number(0.5, 2.0)],
            restitution: [0.1, 0.3, 0.5, 0.7, 0.9][number / 4 % 5],
        };
        let x = [-samples.number(0.2, 1.0), 0.0, samples.number(0.2, 1.0)];
        let v = [samples.number(0.2, 1.0), samples.number(-0.15, 0.15), -samples.number(0.2, 1.0)];
        let first = usize::from(x[2] / (v[1] - v[2]) < -x[0] / (v[0] - v[1]));
        let expected = struck_in_turn(&pinch, v, first);
        // Where bounces go on for as long as they can be counted, no reference is known.
        let apart = (expected[2] - expected[0]).abs();
        if apart > 1e-9 && apart < 1e-3 {
            continue;
        }
        let mut motion = pinch.simulate(State::new(x, v));
        all_close(motion.advance_to(100.0).unwrap().v, expected, 1e-6);
    }
}

/// A disc of 1 kg and 1 m that rolls against a step.
struct Wheel {
    step: f64,
    friction: f64,
}

#[lagrangian(coordinates = [x, y, phi])]
impl Wheel {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (v.x * v.x + v.y * v.y) + 0.25 * v.phi * v.phi
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y - 1.0
    }

    #[unilateral]
    fn edge(&self, q: &Coordinates) -> f64 {
        q.x.hypot(q.y - self.step) - 1.0
    }

    #[friction(coefficient = self.friction, normal = floor)]
    fn on_floor(&self, v: &Velocities) -> f64 {
        v.x + v.phi
    }

    #[friction(coefficient = self.friction, normal = edge)]
    fn on_edge(&self, q: &Coordinates, v: &Velocities) -> f64 {
        ((q.y - self.step) * v.x - q.x * v.y) / q.x.hypot(q.y - self.step) + v.phi
    }
}

/// Strong friction could wedge the wheel between floor and edge, by impulses that bear each other. It turns
/// about the edge.
#[test]
fn a_wheel_climbs_a_step_whatever_friction_could_hold() {
    let mut samples = Samples::new(7);
    let mut can_wedge = 0;
    for _ in 0..100 {
        let step = samples.number(0.01, 0.3);
        let before = -(2.0 * step - step * step).sqrt();
        // Rolling on means that the impulse at the edge lies within its cone: it turns about the edge.
        let turned = 2.0 * (1.5 - step) / 1.5;
        let (normal, along) = (-2.0 * before, 2.0 * (1.0 - step) - turned);
        let friction = samples.number(1.2 * along.abs() / normal, 10.0);
        can_wedge += usize::from(friction * step > -before);
        let wheel = Wheel { step, friction };
        let mut motion = wheel.simulate(State::new([before - 0.1, 1.0, 0.0], [2.0, 0.0, -2.0]));
        let end = motion.advance_to(0.05 + 1e-9).unwrap();
        close(end.v[2], -turned, 1e-7);
    }
    assert!(can_wedge > 20, "{can_wedge}");
}
