//! Derivatives where several contacts or loads have a part in one switch: right, or a named error.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{close, close_on};
use crate::support::difference::derivative;

/// Three balls on a line, the last two of which may touch.
struct Cradle;

#[lagrangian(coordinates = [a, b, c], jacobians)]
impl Cradle {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.a * v.a + v.b * v.b + v.c * v.c)
    }

    #[unilateral(restitution = 1.0)]
    fn gaps(&self, q: &Coordinates) -> [f64; 2] {
        [q.b - q.a - 1.0, q.c - q.b - 1.0]
    }
}

/// Balls with the smallest gap hit one after the other, and the last one takes all the momentum. Without a
/// gap there are no derivatives, since another law holds for balls that are struck together.
#[test]
fn a_row_of_balls_that_touch_has_no_derivatives_in_an_impact() {
    let start = |gap: f64| State::new([-1.0, 1.0, 2.0 + gap], [1.0, 0.0, 0.0]);
    let apart = Cradle.variational().motion(start(1e-3)).unwrap().advance_to(3.0).unwrap();
    close(apart.state.v[2], 1.0, 1e-13);
    close(apart.v_by_v[(2, 0)], 1.0, 1e-13);
    let error = Cradle.variational().motion(start(0.0)).map(|_| ()).unwrap_err();
    assert!(matches!(error.cause, Cause::Grazes { switch: 1, .. }), "{error}");
    assert!(error.to_string().contains("`gaps[1]`"), "{error}");
}

/// A plank that falls flat on both of its ends.
struct Plank;

#[lagrangian(coordinates = [y, theta], jacobians)]
impl Plank {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.5 * v.y * v.y + 0.125 * v.theta * v.theta
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral(restitution = 0.5)]
    fn ends(&self, q: &Coordinates) -> [f64; 2] {
        [q.y - q.theta.sin(), q.y + q.theta.sin()]
    }
}

#[test]
fn a_plank_that_falls_flat_has_no_derivatives() {
    let varied = Plank.variational();
    let mut motion = varied.motion(State::at_rest([1.0, 0.0])).unwrap();
    let error = motion.advance_to(1.0).unwrap_err();
    assert!(error.to_string().contains("`ends[0]` and `ends[1]` switch at once"), "{error}");
    let mut motion = varied.motion(State::at_rest([1.0, 1e-4])).unwrap();
    motion.advance_to(0.46).unwrap();
}

/// ∫ |cos| between two times, both of which may be negative.
fn worked(from: f64, to: f64) -> f64 {
    let until = |t: f64| {
        let turns = ((t + 0.5 * std::f64::consts::PI) / std::f64::consts::PI).floor();
        2.0 * turns + if (turns as i64).rem_euclid(2) == 0 { t.sin() } else { -t.sin() }
    };
    until(to) - until(from)
}

/// Two wheels on hubs that are shaken, each with friction by the size of what its hub bears.
struct Rotors {
    strength: f64,
    phase: f64,
}

#[lagrangian(coordinates = [x: [2], y: [2], phi: [2]], sensitivities = [self.strength, self.phase])]
impl Rotors {
    #[point(mass = 1.0)]
    fn hubs(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        [0, 1].map(|i| Vector2::new(q.x[i], q.y[i]))
    }

    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        0.5 * (v.phi[0].powi(2) + v.phi[1].powi(2))
    }

    #[force(at = hubs)]
    fn shake(&self, t: f64) -> [Vector2<f64>; 2] {
        let direction = Vector2::new(0.6, 0.8);
        [self.strength * t.cos() * direction, 2.0 * (t - self.phase).cos() * direction]
    }

    #[holonomic]
    fn first(&self, q: &Coordinates) -> [f64; 2] {
        [q.x[0], q.y[0]]
    }

    #[holonomic]
    fn second(&self, q: &Coordinates) -> [f64; 2] {
        [q.x[1], q.y[1]]
    }

    #[friction(coefficient = 0.5, normal = [first])]
    fn slip(&self, v: &Velocities) -> f64 {
        0.1 * v.phi[0]
    }

    #[friction(coefficient = 0.5, normal = [second])]
    fn drag(&self, v: &Velocities) -> f64 {
        0.1 * v.phi[1]
    }
}

/// Without a phase between them both loads vanish at once.
#[test]
fn derivatives_go_up_to_where_a_load_is_zero_and_the_friction_is_named() {
    let start = State::new([0.0; 6], [0.0, 0.0, 0.0, 0.0, 5.0, 5.0]);
    for (phase, first) in [(0.3, "slip"), (-0.4, "drag"), (0.0, "slip")] {
        let rotors = Rotors { strength: 3.0, phase };
        let varied = rotors.variational();
        let mut motion = varied.motion(start).unwrap().with_tolerance(TIGHT);
        let t = 1.0;
        let found = motion.advance_to(t).unwrap();
        close(found.state.v[4], 5.0 - 0.05 * 3.0 * worked(0.0, t), 1e-11);
        close(found.state.v[5], 5.0 - 0.05 * 2.0 * worked(-phase, t - phase), 1e-11);
        close_on(1.0, found.v_by_p[(4, 0)], -0.05 * worked(0.0, t), 1e-11);
        close_on(1.0, found.v_by_p[(5, 1)], 0.1 * ((t - phase).cos() - phase.cos()), 1e-11);
        close_on(1.0, found.v_by_p[(4, 1)].hypot(found.v_by_p[(5, 0)]), 0.0, 1e-12);
        let error = motion.advance_to(2.5).unwrap_err();
        match error.cause {
            Cause::Grazes { name, .. } => assert_eq!(name.as_str(), first),
            Cause::SwitchesCoincide { .. } if phase == 0.0 => {}
            _ => panic!("{error}"),
        }
        close_on(1.0, error.t, phase.min(0.0) + 0.5 * std::f64::consts::PI, 1e-12);
    }
}

/// A pendulum on a journal bearing that strikes a stop: friction by the size of the impulse on the pin.
struct Journal {
    friction: f64,
    restitution: f64,
}

#[lagrangian(coordinates = [x, y, phi], sensitivities = [self.friction, self.restitution])]
impl Journal {
    #[point(mass = 2.0)]
    fn centre(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        0.5 * 0.1 * v.phi.powi(2)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * q.y
    }

    #[holonomic]
    fn pin(&self, q: &Coordinates) -> [f64; 2] {
        [q.x - 0.5 * q.phi.sin(), q.y + 0.5 * q.phi.cos()]
    }

    #[unilateral(restitution = self.restitution)]
    fn stop(&self, q: &Coordinates) -> f64 {
        q.phi + 1.0
    }

    #[friction(coefficient = self.friction, normal = [pin])]
    fn slip(&self, v: &Velocities) -> f64 {
        0.1 * v.phi
    }
}

#[test]
fn an_impact_with_friction_by_a_load_has_derivatives() {
    let ends = |friction: f64, restitution: f64, phi: f64| {
        let start = State::at_rest([0.5 * phi.sin(), -0.5 * phi.cos(), phi]);
        let journal = Journal { friction, restitution };
        let mut motion = journal.simulate(start).with_tolerance(TIGHT);
        let end = *motion.advance_to(1.3).unwrap();
        [end.q[2], end.v[2]]
    };
    let journal = Journal { friction: 0.3, restitution: 0.4 };
    let start = State::at_rest([0.5 * 2.0_f64.sin(), -0.5 * 2.0_f64.cos(), 2.0]);
    let varied = journal.variational();
    let found = varied.motion(start).unwrap().with_tolerance(TIGHT).advance_to(1.3).unwrap();
    let by_friction = derivative(1e-3, |by| ends(0.3 + by, 0.4, 2.0));
    let by_restitution = derivative(1e-3, |by| ends(0.3, 0.4 + by, 2.0));
    let by_angle = derivative(1e-3, |by| ends(0.3, 0.4, 2.0 + by));
    // The variation of the start goes along the constraints.
    let along = [0.5 * 2.0_f64.cos(), 0.5 * 2.0_f64.sin(), 1.0];
    for (row, (by_q, by_p)) in
        [(found.q_by_q, found.q_by_p), (found.v_by_q, found.v_by_p)].into_iter().enumerate()
    {
        let turned: f64 = (0..3).map(|i| by_q[(2, i)] * along[i]).sum();
        close_on(1.0, turned, by_angle[row], 1e-7);
        close_on(1.0, by_p[(2, 0)], by_friction[row], 1e-7);
        close_on(1.0, by_p[(2, 1)], by_restitution[row], 1e-7);
    }
}

/// A sledge on two rough runners that is pushed harder and harder. No law tells what each of them holds.
struct Sledge {
    push: f64,
    holds: f64,
}

#[lagrangian(coordinates = [x, y, phi], sensitivities = [self.push])]
impl Sledge {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.5 * (v.x * v.x + v.y * v.y) + 0.1 * v.phi * v.phi
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[force]
    fn pushed(&self, t: f64) -> [f64; 3] {
        [self.push * t, 0.0, 0.0]
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> [f64; 2] {
        [q.y - 0.4 * q.phi.sin(), q.y + 0.3 * q.phi.sin()]
    }

    #[friction(coefficient = 0.3, static_coefficient = self.holds, normal = floor)]
    fn slips(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        [v.x + 0.4 * q.phi.sin() * v.phi, v.x - 0.3 * q.phi.sin() * v.phi]
    }
}

impl Sledge {
    fn way(&self, t: f64) -> f64 {
        let begins = self.holds * 9.81 / self.push;
        let passed = t - begins;
        let pushed = (t.powi(3) - begins.powi(3)) / 6.0 - 0.5 * begins * begins * passed;
        self.push * pushed - 0.5 * 0.3 * 9.81 * passed * passed
    }
}

#[test]
fn runners_that_share_a_load_let_go_together() {
    for holds in [0.3, 0.4] {
        let sledge = Sledge { push: 2.0, holds };
        let mut motion = sledge.simulate(State::at_rest([0.0; 3])).with_tolerance(TIGHT);
        close(motion.advance_to(2.5).unwrap().q[0], sledge.way(2.5), 1e-12);
    }
}

#[test]
fn they_have_derivatives_if_nothing_jumps_then() {
    let sledge = Sledge { push: 2.0, holds: 0.3 };
    let varied = sledge.variational();
    let mut motion = varied.motion(State::at_rest([0.0; 3])).unwrap().with_tolerance(TIGHT);
    let found = motion.advance_to(2.5).unwrap();
    let exact = derivative(1e-3, |by| [Sledge { push: 2.0 + by, holds: 0.3 }.way(2.5)])[0];
    close(found.q_by_p[(0, 0)], exact, 1e-9);
    let jumps = Sledge { push: 2.0, holds: 0.4 };
    let varied = jumps.variational();
    let error = varied.motion(State::at_rest([0.0; 3])).unwrap().advance_to(2.5).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains("switch at once"), "{error}");
}
