//! Coefficients and limits of friction that jump: at a time, or at a place.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::close;

/// Gravity along and across a slope whose sine is 0.6.
const ALONG: f64 = 0.6 * 9.81;
const ACROSS: f64 = 0.8 * 9.81;

/// A block on a slope that changes its roughness at a time. `late_then` is one if it has changed at
/// that time itself, else zero.
struct Slope {
    when: f64,
    early: f64,
    late: f64,
    late_then: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Slope {
    #[point(mass = 2.0)]
    fn block(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        2.0 * (ACROSS * q.y - ALONG * q.x)
    }

    fn roughness(&self, t: f64) -> f64 {
        let until = if t < self.when { 1.0 } else { 0.0 };
        let through = if t <= self.when { 1.0 } else { 0.0 };
        let share = if self.late_then > 0.5 { until } else { through };
        self.late + (self.early - self.late) * share
    }

    #[unilateral(restitution = 0.0)]
    fn plane(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[friction(coefficient = roughness, normal = plane)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

/// The way down until `end` from rest.
fn way(slope: &Slope, end: f64) -> f64 {
    let [early, late] = [slope.early, slope.late].map(|roughness| ALONG - roughness * ACROSS);
    let [mut x, mut v, mut since] = [0.0, 0.0, slope.when];
    if early > 0.0 {
        (x, v) = (0.5 * early * since * since, early * since);
    }
    since = end - since;
    if late < 0.0 {
        since = since.min(v / -late);
    }
    x += v * since + 0.5 * late * since * since;
    if late < 0.0 && v == 0.0 { 0.0 } else { x }
}

#[test]
fn a_slope_changes_its_roughness_at_any_time() {
    for step in 1..100 {
        let when = 0.01 * f64::from(step) + 1e-3 * f64::from(step).sqrt();
        for [early, late] in [[0.9, 0.2], [0.2, 0.9], [0.9, 0.8], [0.2, 0.1]] {
            for late_then in [0.0, 1.0] {
                let slope = Slope { when, early, late, late_then };
                let expected = way(&slope, 3.0);
                let start = State::at_rest([0.0, 0.0]);
                let mut motion = slope.simulate(start).with_tolerance(TIGHT);
                close(motion.advance_to(3.0).unwrap().q[0], expected, 1e-12);
            }
        }
    }
}

#[test]
fn fixed_steps_meet_a_change_of_roughness() {
    let slope = Slope { when: 0.4567, early: 0.9, late: 0.2, late_then: 1.0 };
    let mut stepper = slope.stepper::<Jet<6>>(State::at_rest([0.0, 0.0]));
    for _ in 0..300 {
        stepper.step(0.01, &[]).unwrap();
    }
    close(stepper.state().q[0], way(&slope, stepper.state().t), 1e-12);
}

/// A shaft under a torque, with a clutch that closes and opens again and again.
struct Clutch {
    rate: f64,
}

#[lagrangian(coordinates = [angle])]
impl Clutch {
    #[kinetic]
    fn rotation(&self, v: &Velocities) -> f64 {
        0.5 * v.angle * v.angle
    }

    #[force(on = angle)]
    fn drive(&self) -> f64 {
        0.9
    }

    fn limit(&self, t: f64) -> f64 {
        if (self.rate * t).sin() > 0.0 { 2.0 } else { 0.0 }
    }

    #[friction(limit = limit)]
    fn plates(&self, v: &Velocities) -> f64 {
        v.angle
    }
}

#[test]
fn a_clutch_lets_go_each_time_it_opens() {
    for step in 1..100 {
        let rate = 1.0 + 0.04 * f64::from(step);
        let half = std::f64::consts::PI / rate;
        // Held in the first half of a turn, free in the second, then slowed by 2 − 0.9 and held again.
        let fast = 0.9 * half;
        let turn = 0.5 * fast * (half + fast / 1.1);
        let start = State::at_rest([0.0]);
        let end = 6.99 * half;
        let clutch = Clutch { rate };
        close(clutch.simulate(start).with_tolerance(TIGHT).advance_to(end).unwrap().q[0], 3.0 * turn, 1e-12);
    }
}

/// A puck on a floor that is smooth as far as an edge, with a slip in two directions.
struct Rink {
    edge: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Rink {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.x * v.x + v.y * v.y)
    }

    fn limit(&self, q: &Coordinates) -> f64 {
        if q.x < self.edge { 0.1 } else { 3.0 }
    }

    #[friction(limit = limit)]
    fn ice(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x, v.y)
    }
}

#[test]
fn a_puck_stops_behind_the_edge_of_the_ice() {
    for step in 1..100 {
        let edge = 0.01 * f64::from(step);
        let (speed, direction) = (1.5_f64, 0.3_f64);
        let start = State::new([0.0; 2], [speed * direction.cos(), speed * direction.sin()]);
        let on_ice = edge / direction.cos();
        let way = on_ice + (speed * speed - 2.0 * 0.1 * on_ice) / (2.0 * 3.0);
        let rink = Rink { edge };
        let mut motion = rink.simulate(start).with_tolerance(TIGHT);
        let end = motion.advance_to(20.0).unwrap();
        close(end.q[0].hypot(end.q[1]), way, 1e-12);
        assert_eq!(end.v, [0.0; 2]);
    }
}

/// A block that is pushed harder from one time on, and pressed harder from another time on.
struct Pushed {
    pushed: f64,
    pressed: f64,
}

#[lagrangian(coordinates = [x])]
impl Pushed {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn push(&self, t: f64) -> f64 {
        if t > self.pushed { 2.0 } else { 1.0 }
    }

    fn kinetic_limit(&self, t: f64) -> f64 {
        if t > self.pressed { 1.75 } else { 1.25 }
    }

    fn static_limit(&self, t: f64) -> f64 {
        if t > self.pressed { 2.5 } else { 1.5 }
    }

    #[friction(limit = kinetic_limit, static_limit = static_limit)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn a_push_and_its_resistance_come_at_one_time() {
    for step in 1..200 {
        let pushed = 0.013 * f64::from(step);
        // Either may be a rounding error later than the other.
        for pressed in [pushed, pushed.next_up(), pushed.next_down()] {
            let both = Pushed { pushed, pressed };
            let end = *both.simulate(State::at_rest([0.0])).with_tolerance(TIGHT).advance_to(4.0).unwrap();
            assert_eq!((end.q, end.v), ([0.0], [0.0]), "{pushed} {pressed}");
        }
        // Pressed a little too late, it has begun to slide.
        let late = Pushed { pushed, pressed: pushed + 1e-3 };
        let end = *late.simulate(State::at_rest([0.0])).with_tolerance(TIGHT).advance_to(4.0).unwrap();
        let (speed, slid) = (0.75 * 1e-3, 4.0 - late.pressed);
        close(end.q[0], 0.5 * 0.75 * 1e-6 + speed * slid + 0.125 * slid * slid, 1e-12);
    }
}

/// A block under a push of 2, which a clamp holds after a time, and at that time does not.
struct Clamped {
    closed: f64,
}

#[lagrangian(coordinates = [x])]
impl Clamped {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn push(&self) -> f64 {
        2.0
    }

    fn kinetic_limit(&self, t: f64) -> f64 {
        if t <= self.closed { 0.5 } else { 1.5 }
    }

    fn static_limit(&self, t: f64) -> f64 {
        if t <= self.closed { 1.0 } else { 2.5 }
    }

    #[friction(limit = kinetic_limit, static_limit = static_limit)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn a_start_at_a_jump_is_a_start_behind_it() {
    for step in 0..100 {
        let closed = 0.013 * f64::from(step);
        let clamped = Clamped { closed };
        let start = State::at_rest([0.0]).at_time(closed);
        let end = closed + 1.0;
        assert_eq!(clamped.simulate(start).advance_to(end).unwrap().q, [0.0]);
        let mut stepper = clamped.stepper::<Jet<4>>(start);
        stepper.step(1.0, &[]).unwrap();
        assert_eq!(stepper.state().q, [0.0]);
        // The same in the course of a motion.
        let mut motion = clamped.simulate(start.at_time(closed - 0.5));
        motion.advance_to(closed).unwrap();
        motion.set_state(start);
        assert_eq!(motion.advance_to(end).unwrap().q, [0.0]);
        // With the least speed it slides on.
        let start = State { v: [1e-3], ..start };
        close(clamped.simulate(start).advance_to(end).unwrap().q[0], 0.251, 1e-12);
    }
}

/// A block whose friction has the limit `mean` + `swing` cos t, but no less than `least`.
struct Swinging {
    mean: f64,
    swing: f64,
    least: f64,
}

#[lagrangian(coordinates = [x])]
impl Swinging {
    #[point(mass = 1.0)]
    fn block(&self, q: &Coordinates) -> f64 {
        q.x
    }

    fn holds(&self, t: f64) -> f64 {
        (self.mean + self.swing * t.cos()).max(self.least)
    }

    #[friction(limit = holds)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn a_limit_that_becomes_negative_on_the_way_is_an_error() {
    for mean in [0.0, 0.4, 0.9, 0.99] {
        // The limit is negative between these times, which long steps would pass over.
        let swinging = Swinging { mean, swing: 1.0, least: -9.0 };
        let begins = (-mean).acos();
        let mut motion = swinging.simulate(State::new([0.0], [40.0]));
        let before = begins - 1e-9;
        let slowed = mean * before + before.sin();
        close(motion.advance_to(before).unwrap().v[0], 40.0 - slowed, TIGHT);
        // The error stays where it is.
        for end in [20.0, begins + 1.0, 30.0] {
            let error = motion.advance_to(end).unwrap_err();
            let Cause::InvalidContact { name, .. } = error.cause else { panic!("{error}") };
            assert_eq!(name.as_str(), "slip");
            close(error.t, begins, 1e-7);
        }
        let mut stepper = swinging.stepper::<Jet<6>>(State::new([0.0], [40.0]));
        let error = (0..400).find_map(|_| stepper.step(0.05, &[]).err()).unwrap();
        assert!(matches!(error.cause, Cause::InvalidContact { .. }), "{error}");
        assert!((error.t - begins).abs() <= 0.05, "{error}");
    }
}

#[test]
fn a_limit_that_touches_zero_holds_on() {
    let mut motion = Swinging { mean: 1.0, swing: 1.0, least: -9.0 }.simulate(State::new([0.0], [40.0]));
    close(motion.advance_to(20.0).unwrap().v[0], 40.0 - 20.0 - 20.0_f64.sin(), 1e-12);
}

#[test]
fn a_limit_that_is_held_at_zero_holds_on() {
    let swinging = Swinging { mean: 0.0, swing: 1.0, least: 0.0 };
    let mut motion = swinging.simulate(State::new([0.0], [40.0]));
    // Half a wave takes ∫ cos t = 1 from the speed, two whole ones 4, and the last one until then sin 20 + 1.
    close(motion.advance_to(20.0).unwrap().v[0], 34.0 - 20.0_f64.sin(), 1e-11);
}

/// A puck on a floor that is smoother the further it slides.
struct Polished;

#[lagrangian(coordinates = [x, y])]
impl Polished {
    #[point(mass = 1.0)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    fn roughness(&self, q: &Coordinates) -> f64 {
        0.2 - 0.4 * q.x
    }

    #[friction(coefficient = roughness, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn a_coefficient_that_becomes_negative_on_the_way_is_an_error() {
    // x = 1/2 - cosh(ω t)/2 + v sinh(ω t)/ω with ω² = 0.4 g, and the coefficient is zero at 1/2.
    let omega = (0.4_f64 * 9.81).sqrt();
    let mut motion = Polished.simulate(State::new([0.0, 0.0], [3.0, 0.0]));
    let error = motion.advance_to(2.0).unwrap_err();
    assert!(matches!(error.cause, Cause::InvalidContact { name, .. } if name.as_str() == "slip"), "{error}");
    close(error.t, (0.5 * omega / 3.0).atanh() / omega, 1e-9);
    // In the air it does not matter.
    let end = *Polished.simulate(State::new([0.0, 0.1], [10.0, 0.0])).advance_to(0.1).unwrap();
    close(end.q[0], 1.0, TIGHT);
}
