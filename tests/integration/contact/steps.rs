//! Fixed steps through contacts, friction and kinks.

use lagrangian::prelude::*;
use lagrangian::{Cause, Ordered};

use super::TIGHT;
use crate::support::close::{all_close, close, close_on};

/// A ball above a floor, in any scalar.
struct Ball<R> {
    restitution: R,
}

#[lagrangian(coordinates = [y])]
impl<R: Real> Ball<R> {
    #[point(mass = R::one())]
    fn ball(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(R::zero(), q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates<R>) -> R {
        9.81 * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates<R>) -> R {
        q.y
    }
}

/// Height and velocity of the ball that falls from one metre, by the sum of its flights.
fn bounced(restitution: f64, t: f64) -> [f64; 2] {
    let g = 9.81;
    let (mut since, mut speed) = ((2.0 / g).sqrt(), (2.0 * g).sqrt());
    if t < since {
        return [1.0 - 0.5 * g * t * t, -g * t];
    }
    loop {
        speed *= restitution;
        let flight = 2.0 * speed / g;
        if t < since + flight {
            let dt = t - since;
            return [dt * (speed - 0.5 * g * dt), speed - g * dt];
        }
        since += flight;
    }
}

/// Steps of 1/128 s, whose sums have no rounding.
const H: f64 = 1.0 / 128.0;

#[test]
fn a_ball_bounces_in_fixed_steps_to_the_last_digits() {
    let ball = Ball { restitution: 0.8 };
    let mut motion = ball.stepper::<Jet<3>>(State::at_rest([1.0]));
    // Until 16 bounces are over; all of them lie within steps.
    for _ in 0..400 {
        let state = *motion.step(H, &[]).unwrap();
        let [y, v] = bounced(0.8, state.t);
        close_on(1.0, state.q[0], y, 1e-13);
        close_on(1.0, state.v[0], v, 1e-12);
    }
    // Infinitely many bounces end at 4.1 s.
    for _ in 0..200 {
        motion.step(H, &[]).unwrap();
    }
    assert_eq!(motion.state().v, [0.0]);
    close_on(1.0, motion.state().q[0], 0.0, 1e-15);
}

#[test]
fn short_steps_in_single_precision_are_as_long_as_they_are() {
    // After an hour a time in `f32` is known to a quarter of a millisecond, and a step is one millisecond.
    let ball = Ball { restitution: 1.0_f32 };
    let start = State::at_rest([1.0_f32]).at_time(3600.0);
    let mut motion = ball.stepper::<Jet<3>>(start);
    let h = 1.0 / 1024.0;
    for step in 1..=4096_u16 {
        let state = *motion.step(h, &[]).unwrap();
        let [y, v] = bounced(1.0, f64::from(step) * f64::from(h));
        close_on(1.0, f64::from(state.q[0]), y, 5e-5);
        close_on(5.0, f64::from(state.v[0]), v, 5e-5);
    }
}

/// A block on a moving belt, held by a spring, and pushed.
struct Belt;

#[lagrangian(coordinates = [x], inputs = [push])]
impl Belt {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        4.5 * q.x.powi(2)
    }

    #[force(on = x)]
    fn drive(&self, u: &Inputs) -> f64 {
        u.push
    }

    #[friction(limit = 2.4, static_limit = 4.0)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x - 0.2
    }
}

#[test]
fn a_block_sticks_and_slips_in_fixed_steps() {
    let start = State::new([0.0], [0.2]);
    let mut steps = Belt.stepper::<Jet<10>>(start);
    let mut motion = Belt.simulate(start).with_tolerance(TIGHT);
    let mut sticks = 0;
    for _ in 0..1000 {
        let state = *steps.step(H, &[0.0]).unwrap();
        let expected = *motion.advance_to(state.t).unwrap();
        close_on(1.0, state.q[0], expected.q[0], 1e-11);
        close_on(1.0, state.v[0], expected.v[0], 1e-11);
        sticks += usize::from(state.v[0] == 0.2);
    }
    assert!(sticks > 500 && sticks < 1000, "{sticks}");
}

#[test]
fn inputs_that_change_from_step_to_step_are_seen_at_once() {
    let mut motion = Belt.stepper::<Jet<8>>(State::new([0.0], [0.2]));
    // Forces that friction holds, and forces that it does not hold.
    for step in 0..32_u8 {
        let state = motion.step(H, &[3.0 * f64::from(step % 2)]).unwrap();
        close(state.v[0], 0.2, 1e-15);
    }
    let x = motion.state().q[0];
    close(x, 32.0 * H * 0.2, 1e-14);
    let state = motion.step(H, &[5.0]).unwrap();
    // ẍ = 5 − 2.4 − 9 x from there.
    let (rest, speed): (f64, f64) = (2.6 / 9.0, 0.2);
    let (sin, cos) = (3.0 * H).sin_cos();
    close(state.q[0], rest + (x - rest) * cos + speed / 3.0 * sin, 1e-13);
    close(state.v[0], 3.0 * (rest - x) * sin + speed * cos, 1e-13);
}

/// A pendulum between two stops, in a moving frame: impacts that depend on time.
struct Stopped;

#[lagrangian(coordinates = [theta])]
impl Stopped {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates, t: f64) -> Vector2<f64> {
        Vector2::new(q.theta.sin() + 0.1 * (3.0 * t).sin(), -q.theta.cos())
    }

    #[potential]
    fn weight(&self, q: &Coordinates, t: f64) -> f64 {
        9.81 * self.bob(q, t).y
    }

    #[unilateral(restitution = 0.7)]
    fn stops(&self, q: &Coordinates, t: f64) -> [f64; 2] {
        [0.3 - q.theta + 0.05 * t.sin(), 0.3 + q.theta]
    }
}

#[test]
fn the_order_of_the_method_holds_through_impacts() {
    let start = State::new([0.1], [2.0]).at_time(5.0);
    let expected = *Stopped.simulate(start).with_tolerance(TIGHT).advance_to(6.5).unwrap();
    let error = |count: u16| {
        let mut motion = Stopped.stepper::<Jet<4>>(start);
        for _ in 0..count {
            motion.step(1.5 / f64::from(count), &[]).unwrap();
        }
        (motion.state().q[0] - expected.q[0]).abs()
    };
    let errors = [24, 48, 96, 192].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((3.0..6.0).contains(&order), "{order} of {errors:?}");
    }
    assert!(errors[3] < 1e-6, "{errors:?}");
}

/// A puck on a spring, thrown onto a rough floor, generic over its numbers.
struct Puck;

#[lagrangian(coordinates = [x, y])]
impl Puck {
    #[point(mass = 0.25)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        0.25 * 9.81 * q.y + 4.0 * q.x * q.x
    }

    #[unilateral(restitution = 0.5)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[friction(coefficient = 0.125, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn energy_never_grows_and_nothing_penetrates() {
    let start = State::new([0.0, 0.25], [3.0, 0.0]);
    let mut steps = Puck.stepper::<Jet<8>>(start);
    let mut motion = Puck.simulate(start).with_tolerance(TIGHT);
    let mut energy = Puck.energy(&start);
    for _ in 0..1024 {
        let state = *steps.step(H, &[]).unwrap();
        let next = Puck.energy(&state);
        assert!(next <= energy + 1e-13, "{energy} {next}");
        assert!(state.q[1] >= -1e-15, "{state:?}");
        energy = next;
        let expected = *motion.advance_to(state.t).unwrap();
        all_close(state.q, expected.q, 1e-10);
    }
    // It has come to rest where friction holds the spring: µ m g ≥ k |x|.
    let State { q: [x, y], v, .. } = *steps.state();
    assert_eq!(v, [0.0; 2]);
    assert!(8.0 * x.abs() <= 0.125 * 0.25 * 9.81 && y.abs() < 1e-15);
}

/// A mass between springs, of which one pulls on one side only.
struct Slack;

#[lagrangian(coordinates = [x])]
impl Slack {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        2.0 * q.x.powi(2) + 6.0 * q.x.max(0.0).powi(2)
    }
}

#[test]
fn kinks_cost_fixed_steps_no_digits() {
    let mut motion = Slack.stepper::<Jet<12>>(State::new([0.5], [0.0]));
    for _ in 0..1024 {
        let state = *motion.step(H, &[]).unwrap();
        // Half a swing with 4 rad/s, half a swing with 2 rad/s, whose amplitude is twice that.
        let t = state.t % (0.75 * core::f64::consts::PI);
        let [quarter, later] = [0.125, 0.625].map(|part| part * core::f64::consts::PI);
        let x = match t {
            t if t <= quarter => 0.5 * (4.0 * t).cos(),
            t if t <= later => -(2.0 * (t - quarter)).sin(),
            t => 0.5 * (4.0 * (t - later)).sin(),
        };
        close_on(1.0, state.q[0], x, 1e-12);
    }
    // And back, since nothing has been lost.
    for _ in 0..1024 {
        motion.step(-H, &[]).unwrap();
    }
    close(motion.state().q[0], 0.5, 1e-12);
}

/// Why a step from a start fails.
fn cause<R: Ordered>(ball: &Ball<R>, start: State<R, 1>, h: R) -> Cause {
    ball.stepper::<Jet<4>>(start).step(h, &[]).unwrap_err().cause
}

#[test]
fn what_fixed_steps_cannot_do_is_an_error() {
    let ball = Ball { restitution: 0.999 };
    let low = State::at_rest([1e-4]);
    // Thousands of bounces.
    assert_eq!(cause(&ball, low, 20.0), Cause::StepTooLong);
    assert!(matches!(cause(&ball, State::at_rest([-0.1]), H), Cause::Penetrates { .. }));
    assert_eq!(cause(&ball, low, -H), Cause::Irreversible);
    assert!(matches!(cause(&Ball { restitution: 1.5 }, low, H), Cause::InvalidContact { .. }));
    // A failed step is not taken, and the motion goes on from the state before it.
    let mut motion = ball.stepper::<Jet<4>>(low);
    motion.step(H, &[]).unwrap();
    let before = *motion.state();
    motion.step(20.0, &[]).unwrap_err();
    assert_eq!(*motion.state(), before);
    let mut other = ball.stepper::<Jet<4>>(before);
    assert_eq!(motion.step(H, &[]).unwrap().q, other.step(H, &[]).unwrap().q);
}
