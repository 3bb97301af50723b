//! Turning points, thrusts and bounces, constraints and other scalars.

use std::f64::consts::PI;

use lagrangian::prelude::*;

use crate::support::close::close;
use crate::support::motion::TIGHT;

/// A pendulum, by its angle.
struct Pendulum<R: Real> {
    length: R,
    g: R,
}

#[lagrangian(coordinates = [theta])]
impl<R: Real> Pendulum<R> {
    #[point(mass = R::one())]
    fn bob(&self, q: &Coordinates) -> Vector2<R> {
        Vector2::new(q.theta.sin(), -q.theta.cos()) * self.length
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> R {
        self.g * self.bob(q).y
    }
}

/// The same pendulum by a rod.
struct Rod;

#[lagrangian(coordinates = [x, y])]
impl Rod {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - 1.0
    }

    #[event]
    fn lowest(&self, q: &Coordinates) -> f64 {
        q.x
    }

    #[event]
    fn turning(&self, v: &Velocities) -> f64 {
        v.x
    }
}

/// A period by the arithmetic–geometric mean (Gauss).
fn period(amplitude: f64, rate: f64) -> f64 {
    let (mut a, mut b) = (1.0, (amplitude / 2.0).cos());
    for _ in 0..6 {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    2.0 * PI / (rate * a)
}

#[test]
fn a_pendulum_turns_every_half_period() {
    let pendulum = Pendulum { length: 1.0, g: 9.81 };
    let half = period(2.0, 9.81_f64.sqrt()) / 2.0;
    let mut motion = pendulum.simulate(State::at_rest([2.0])).with_tolerance(TIGHT);
    let turning = |state: &State<f64, 1>| state.v[0];
    let events: Vec<_> = motion.events(turning, 20.5 * half).map(Result::unwrap).collect();
    assert_eq!(events.len(), 20);
    for (event, k) in events.iter().zip(1..) {
        close(event.state.t, f64::from(k) * half, 1e-12);
        close(event.state.q[0], if k % 2 == 0 { 2.0 } else { -2.0 }, 1e-12);
    }
}

#[test]
fn a_pendulum_on_a_rod_does_the_same() {
    let quarter = period(1.0, 9.81_f64.sqrt()) / 4.0;
    let start = State::at_rest([1.0_f64.sin(), -1.0_f64.cos()]);
    let mut motion = Rod.simulate(start).with_tolerance(TIGHT);
    let guards = [RodEvent::Lowest, RodEvent::Turning];
    let events: Vec<_> = motion.events_of(guards, 12.5 * quarter).map(Result::unwrap).collect();
    assert_eq!(events.len(), 12);
    for (event, k) in events.iter().zip(1..) {
        close(event.state.t, f64::from(k) * quarter, 1e-12);
        assert_eq!(event.index, if k % 2 == 1 { 0 } else { 1 });
        assert!((event.state.q[0].hypot(event.state.q[1]) - 1.0).abs() < 4e-15);
    }
}

#[test]
fn single_precision() {
    let pendulum = Pendulum { length: 1.0_f32, g: 9.81 };
    let half = period(1.0, 9.81_f64.sqrt()) / 2.0;
    let mut motion = pendulum.simulate(State::at_rest([1.0_f32]));
    let turning = |state: &State<f32, 1>| state.v[0];
    let mut k = 0;
    while let Some(event) = motion.advance_to_event(turning, 10.5 * half as f32).unwrap() {
        k += 1;
        close(f64::from(event.state.t), f64::from(k) * half, 1e-4);
    }
    assert_eq!(k, 10);
}

/// A point above the ground.
struct Ball;

#[lagrangian(coordinates = [y])]
impl Ball {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[event]
    fn ground(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

#[test]
fn a_ball_bounces_by_hand() {
    let restitution: f64 = 0.8;
    let mut motion = Ball.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    let fall = (2.0 / 9.81_f64).sqrt();
    let mut flights = 0.0;
    for bounce in 0..60 {
        let event = motion.advance_to_event(BallEvent::Ground, 1e6).unwrap().expect("gravity");
        assert_eq!(event.crossing, Crossing::Falling, "bounce {bounce}");
        close(event.state.t, fall * (1.0 + 2.0 * flights), 1e-12);
        motion.set_state(State { v: [-restitution * event.state.v[0]], ..event.state });
        flights += restitution.powi(bounce + 1);
    }
}

#[test]
fn thrusts_at_apsides_raise_a_pendulum() {
    // A push at every passage through the lowest point, while it swings to the right.
    let mut motion = Rod.simulate(State::new([0.0, -1.0], [1.0, 0.0])).with_tolerance(1e-13);
    let mut speed = 1.0;
    for _ in 0..5 {
        let event = motion.events(RodEvent::Lowest, 1e3).rising().next().expect("it swings").unwrap();
        close(event.state.v[0], speed, 1e-10);
        speed += 0.5;
        motion.set_state(State { v: [event.state.v[0] + 0.5, event.state.v[1]], ..event.state });
    }
    // A state that violates the rod is refused as at the start of a motion.
    motion.set_state(State { q: [0.0, -1.1], ..*motion.state() });
    assert!(matches!(motion.advance_by(1.0).unwrap_err().cause, Cause::PositionViolated { .. }));
}
