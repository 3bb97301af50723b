//! Slips in two directions that begin and end at rest, on surfaces that move; rest that costs nothing.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close, close, close_on};
use crate::support::sample::Samples;

/// A block on a turntable.
struct Turntable {
    friction: f64,
    rate: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Turntable {
    #[point(mass = 1.0)]
    fn block(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[friction(limit = self.friction * 9.81)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x + self.rate * q.y, v.y - self.rate * q.x)
    }
}

#[test]
fn a_block_goes_with_a_turntable() {
    let table = Turntable { friction: 0.3, rate: 1.0 };
    for radius in [0.1, 1.0, 2.9] {
        let mut motion = table.simulate(State::new([radius, 0.0], [0.0, radius])).with_tolerance(TIGHT);
        let state = *motion.advance_to(100.0).unwrap();
        all_close(state.q, [radius * 100.0_f64.cos(), radius * 100.0_f64.sin()], 1e-11);
        assert!(motion.steps().accepted < 200, "{:?}", motion.steps());
    }
}

#[test]
fn a_block_slips_where_friction_does_not_hold_it() {
    // Beyond r = μg/ω² it slips from the start, in the direction that friction leaves.
    let table = Turntable { friction: 0.3, rate: 1.0 };
    let start = State::new([3.0, 0.0], [0.0, 3.0]);
    let mut motion = table.simulate(start).with_tolerance(TIGHT);
    let fine = *motion.advance_to(1.0).unwrap();
    assert!(motion.steps().accepted < 400, "{:?}", motion.steps());
    let mut motion = table.simulate(start);
    let coarse = *motion.advance_to(1.0).unwrap();
    assert!(motion.steps().accepted < 300, "{:?}", motion.steps());
    all_close(coarse.q, fine.q, 1e-8);
    // The acceleration is ω²r − μg outwards at first.
    let early = *table.simulate(start).with_tolerance(TIGHT).advance_to(1e-3).unwrap();
    close_on(1.0, early.v[0] + early.q[1], 0.057e-3, 1e-6);
}

/// A block on a slope, and one whose normal force is a reaction.
struct Slope {
    angle: f64,
    friction: f64,
}

#[lagrangian(coordinates = [along, across, off])]
impl Slope {
    #[point(mass = 1.0)]
    fn block(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.along, q.across, q.off)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (self.angle.sin() * q.along + self.angle.cos() * q.off)
    }

    #[unilateral]
    fn plane(&self, q: &Coordinates) -> f64 {
        q.off
    }

    #[friction(coefficient = self.friction, normal = plane)]
    fn slip(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.along, v.across)
    }
}

#[test]
fn a_block_turns_or_rests_at_its_angle_of_friction() {
    for angle in [0.1, 0.3, 0.5, 1.0_f64] {
        let slope = Slope { angle, friction: angle.tan() };
        let mut motion = slope.simulate(State::new([0.0; 3], [1.0, 0.0, 0.0])).with_tolerance(TIGHT);
        let state = *motion.advance_to(1.0).unwrap();
        close_on(1.0, state.q[0], 1.0 / (4.0 * 9.81 * angle.sin()), 1e-13);
        assert_eq!(state.v, [0.0; 3]);
        // Downwards it keeps its speed.
        let mut motion = slope.simulate(State::new([0.0; 3], [-1.0, 0.0, 0.0])).with_tolerance(TIGHT);
        close_on(1.0, motion.advance_to(100.0).unwrap().v[0], -1.0, 1e-11);
        // Pushed across, |v| + the part of v downhill is conserved: half the speed in the end.
        let mut motion = slope.simulate(State::new([0.0; 3], [0.0, 1.0, 0.0])).with_tolerance(TIGHT);
        close_on(1.0, motion.advance_to(100.0).unwrap().v[0], -0.5, 1e-10);
    }
}

#[test]
fn rest_is_rest_and_costs_nothing() {
    let slope = Slope { angle: 0.3, friction: 0.4 };
    let mut motion = slope.simulate(State::at_rest([0.0; 3])).with_tolerance(TIGHT);
    assert_eq!(motion.advance_to(1e6).unwrap().q, [0.0; 3]);
    assert_eq!(motion.steps().accepted, 0);
    let mut motion = slope.simulate(State::new([0.0; 3], [0.5, 0.2, 0.0])).with_tolerance(TIGHT);
    let state = *motion.advance_to(2.0).unwrap();
    let cost = motion.steps().accepted;
    assert_eq!(motion.advance_to(1e6).unwrap().q, state.q);
    assert_eq!(motion.advance_to(2e6).unwrap().q, state.q);
    assert_eq!(motion.steps().accepted, cost);
}

#[test]
fn no_time_is_lost_where_a_slip_begins_or_ends() {
    // Samples beside the end of a slip, and events on it, at a coarse tolerance.
    let slope = Slope { angle: 0.3, friction: 0.45 };
    let mut motion = slope.simulate(State::new([0.0; 3], [0.0, 2.0, 0.0])).with_tolerance(1e-4);
    let mut last = 2.0;
    let end = 0.8990851212853052;
    for i in -200..200 {
        let state = *motion.advance_to(end + 1e-6 * f64::from(i)).unwrap();
        assert_eq!(state.t, end + 1e-6 * f64::from(i));
        let speed = state.v[0].hypot(state.v[1]);
        assert!(speed <= last + 1e-4, "{state:?}");
        last = speed;
    }
    assert_eq!(last, 0.0);
    let slope = Slope { angle: 0.5, friction: 0.45 };
    let mut motion = slope.simulate(State::at_rest([0.0; 3])).with_tolerance(1e-4);
    for i in 1..200 {
        let t = 1e-6 * f64::from(i);
        let v = motion.advance_to(t).unwrap().v[0];
        close_on(1e-3, v, -9.81 * (0.5_f64.sin() - 0.45 * 0.5_f64.cos()) * t, 1e-6);
    }
}

/// A rope of a given length: the distance from its end has no gradient there.
struct Leash;

#[lagrangian(coordinates = [x, y])]
impl Leash {
    #[point(mass = 1.0)]
    fn dog(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[unilateral]
    fn rope(&self, q: &Coordinates) -> f64 {
        1.0 - q.x.hypot(q.y)
    }
}

#[test]
fn a_gap_without_a_gradient_is_named() {
    let error = Leash.simulate(State::at_rest([0.0, 0.0])).advance_to(1.0).unwrap_err();
    assert!(
        matches!(error.cause, Cause::VanishingGradient { name, .. } if name.as_str() == "rope"),
        "{error}"
    );
}

#[test]
fn a_leash_goes_through_its_centre() {
    // The distance has no series at the centre, and near it one with large rounding errors.
    for [x, y] in [[1.0, 0.0], [0.8, 0.6], [-0.28, 0.96]] {
        let start = State::new([0.5 * x, 0.5 * y], [-x, -y]);
        let state = *Leash.simulate(start).with_tolerance(TIGHT).advance_to(2.0).unwrap();
        all_close(state.q, [-x, -y], 1e-14);
        all_close(state.v, [0.0; 2], 1e-14);
    }
}

/// An object between two fingers. Nothing holds the three along the line of the fingers but forces that
/// cancel, up to their rounding errors.
struct Held {
    mass: f64,
    friction: f64,
    grip: f64,
}

#[lagrangian(coordinates = [left, right, x, y])]
impl Held {
    #[point(mass = 0.1)]
    fn one(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.left, 0.0)
    }

    #[point(mass = 0.1)]
    fn other(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.right, 0.0)
    }

    #[point(mass = self.mass)]
    fn object(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn forces(&self, q: &Coordinates) -> f64 {
        9.81 * self.mass * q.y - self.grip * q.left + self.grip * q.right
    }

    #[unilateral]
    fn pads(&self, q: &Coordinates) -> [f64; 2] {
        [self.object(q).x - 0.1 - self.one(q).x, self.other(q).x - self.object(q).x - 0.1]
    }

    #[friction(coefficient = self.friction, normal = pads)]
    fn slip(&self, v: &Velocities) -> [f64; 2] {
        [v.y, v.y]
    }
}

#[test]
fn an_object_between_two_fingers_stays_where_it_is_held() {
    let mut samples = Samples::new(12);
    for speed in [0.0, 1e-3, -0.2] {
        for _ in 0..100 {
            let (mass, friction) = (samples.number(0.2, 2.0), samples.number(0.1, 1.0));
            let more = samples.number(1.1, 3.0);
            let held = Held { mass, friction, grip: more * mass * 9.81 / (2.0 * friction) };
            let (x, y) = (samples.number(-0.3, 0.3), samples.number(-0.4, 0.4));
            let start = State::new([x - 0.1, x + 0.1, x, y], [0.0, 0.0, 0.0, speed]);
            let end = *held.simulate(start).with_max_steps(100).advance_to(1.0).unwrap();
            // Friction and weight brake it upwards, and their difference downwards.
            let brake = 9.81 * if speed < 0.0 { more - 1.0 } else { more + 1.0 };
            let way = 0.5 * speed * speed.abs() / brake;
            close(end.q[3] - y, way, 1e-12);
            assert_eq!(end.v[3], 0.0);
        }
    }
}
