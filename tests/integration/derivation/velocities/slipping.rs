//! Velocities in dampers, forces, friction and events.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};
use crate::support::sample::Samples;

/// Two pendulums, one hung from a wall that shakes, with a damper between them.
struct Damped {
    lengths: [f64; 2],
    shake: f64,
    damping: f64,
}

#[lagrangian(coordinates = [first, second])]
impl Damped {
    fn wall(&self, t: f64) -> Vector2<f64> {
        Vector2::new(self.shake * (3.0 * t).sin(), 0.0)
    }

    #[point(mass = 1.0)]
    fn left(&self, q: &Coordinates, t: f64) -> Vector2<f64> {
        self.wall(t) + self.lengths[0] * Vector2::new(q.first.sin(), -q.first.cos())
    }

    #[point(mass = 2.0)]
    fn right(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(1.0, 0.0) + self.lengths[1] * Vector2::new(q.second.sin(), -q.second.cos())
    }

    /// Half way down its rod.
    fn grip(&self, q: &Coordinates) -> Vector2<f64> {
        0.5 * (Vector2::new(1.0, 0.0) + self.right(q))
    }

    fn span(&self, q: &Coordinates, t: f64) -> f64 {
        (self.grip(q) - self.left(q, t)).norm()
    }

    #[dissipation]
    fn damper(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        0.5 * self.damping * self.span_velocity(q, v, t).powi(2)
    }

    #[force(at = right)]
    fn air(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let velocity = self.right_velocity(q, v);
        -0.1 * velocity.norm() * velocity
    }

    #[force(at = grip)]
    fn brake(&self, q: &Coordinates, v: &Velocities, t: f64) -> Vector2<f64> {
        0.2 * (self.wall_velocity(t) - self.grip_velocity(q, v))
    }

    #[event]
    fn highest(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.right_velocity(q, v).y
    }
}

#[test]
fn dampers_and_drag_take_the_velocities_of_their_points() {
    let system = Damped { lengths: [0.8, 1.1], shake: 0.05, damping: 0.7 };
    let mut samples = Samples::new(11);
    for _ in 0..5 {
        let state = samples.state::<2>(-1.0, 1.0);
        let ([a, b], [u, w], t) = (state.q, state.v, state.t);
        let wall = Vector2::new(0.15 * (3.0 * t).cos(), 0.0);
        let left = Vector2::new(0.05 * (3.0 * t).sin(), 0.0) + 0.8 * Vector2::new(a.sin(), -a.cos());
        let left_by = 0.8 * Vector2::new(a.cos(), a.sin());
        let right_by = 1.1 * Vector2::new(b.cos(), b.sin());
        let grip = Vector2::new(1.0, 0.0) + 0.55 * Vector2::new(b.sin(), -b.cos());
        let (left_moves, right_moves) = (wall + u * left_by, w * right_by);
        let along = (grip - left).normalize();
        let pull = 0.7 * along.dot(&(0.5 * right_moves - left_moves));
        let drag = -0.1 * right_moves.norm() * right_moves;
        let brake = 0.2 * (wall - 0.5 * right_moves);
        let expected = [
            pull * along.dot(&left_by),
            (-pull * along + brake).dot(&(0.5 * right_by)) + drag.dot(&right_by),
        ];
        all_close(system.applied_forces(&state), expected, 1e-12);
        close(system.highest(&state.q.into(), &state.v.into()), right_moves.y, 1e-13);
    }
}

#[test]
fn an_event_is_where_a_velocity_vanishes() {
    let system = Damped { lengths: [0.8, 1.1], shake: 0.0, damping: 0.0 };
    let mut motion = system.simulate(State::new([0.0, 0.4], [0.0, 0.9]));
    let event = motion.events(DampedEvent::Highest, 5.0).next().expect("it turns").expect("it moves");
    let rate = 1.1 * event.state.q[1].sin() * event.state.v[1];
    assert!(rate.abs() < 1e-13, "{rate}");
}

/// A ball of radius r is bowled: it slips, and then rolls.
struct Bowl {
    radius: f64,
}

#[lagrangian(coordinates = [x, y, angle])]
impl Bowl {
    #[body(mass = 2.0, inertia = 0.4 * 2.0 * self.radius * self.radius)]
    fn ball(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, q.y), q.angle)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * q.y
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y - self.radius
    }

    #[friction(coefficient = 0.3, normal = floor)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.ball_velocity(q, v).at(Vector2::new(q.x, q.y - self.radius)).x
    }
}

#[test]
fn a_bowled_ball_slips_until_it_rolls() {
    let bowl = Bowl { radius: 0.11 };
    let start = State::new([0.0, 0.11, 0.0], [7.0, 0.0, 0.0]);
    close(bowl.slip(&start.q.into(), &start.v.into()), 7.0, 1e-13);
    let mut motion = bowl.simulate(start);
    // v falls at μ g until it is 5/7 of the start: at 2 v₀/(7 μ g).
    let rolls_at = 2.0 * 7.0 / (7.0 * 0.3 * 9.81);
    let end = *motion.advance_to(2.0).expect("it rolls");
    close(end.v[0], 5.0, 1e-12);
    close(end.v[2], -5.0 / 0.11, 1e-12);
    let slipped = 7.0 * rolls_at - 0.5 * 0.3 * 9.81 * rolls_at * rolls_at;
    close(end.q[0], slipped + 5.0 * (2.0 - rolls_at), 1e-11);
    assert!(motion.reactions().slip.abs() < 1e-12);
}
