//! Grooves: floor and wall, or two faces, share a load in ways that no law tells, as long as any shares keep
//! the laws. A ball that rolls, and a grain that slides and stops.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{close, close_on};
use crate::support::sample::Samples;

/// A ball in the corner of a floor and a wall, pressed against both and pulled along them.
struct Groove {
    mass: f64,
    radius: f64,
    /// Moments of inertia in units of 0.4 m r².
    inertia: [f64; 3],
    /// Coefficients of friction of the floor and of the wall.
    rough: [f64; 2],
    /// Forces against floor and wall.
    press: [f64; 2],
    /// Growth of the force along the groove.
    pull: f64,
}

#[lagrangian(coordinates = [x, y, z, a, b, c])]
impl Groove {
    #[body(mass = self.mass, inertia = [
        0.4 * self.inertia[0] * self.mass * self.radius.powi(2),
        0.4 * self.inertia[1] * self.mass * self.radius.powi(2),
        0.4 * self.inertia[2] * self.mass * self.radius.powi(2),
    ])]
    fn ball(&self, q: &Coordinates) -> (Vector3<f64>, Rotation3<f64>) {
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), q.a)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), q.b)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.c);
        (Vector3::new(q.x, q.y, q.z), turn)
    }

    #[force]
    fn pulls(&self, t: f64) -> [f64; 6] {
        [self.press[1], self.pull * t, -self.press[0], 0.0, 0.0, 0.0]
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.z - self.radius
    }

    #[unilateral]
    fn wall(&self, q: &Coordinates) -> f64 {
        -q.x - self.radius
    }

    #[friction(coefficient = self.rough[0], normal = floor)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let slip = self.ball_velocity(q, v).at(Vector3::new(q.x, q.y, q.z - self.radius));
        Vector2::new(slip.x, slip.y)
    }

    #[friction(coefficient = self.rough[1], normal = wall)]
    fn rub(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let rub = self.ball_velocity(q, v).at(Vector3::new(q.x + self.radius, q.y, q.z));
        Vector2::new(rub.y, rub.z)
    }
}

impl Groove {
    fn new(rough: [f64; 2], press: [f64; 2]) -> Self {
        Self { mass: 0.7, radius: 0.1, inertia: [1.0; 3], rough, press, pull: 12.0 }
    }

    fn start(&self) -> State<f64, 6> {
        State::new([-self.radius, 0.0, self.radius, 0.0, 0.0, 0.0], [0.0; 6])
    }

    /// When the last possible shares are gone. The ball rolls if each contact bears 2/9 of the pull along the
    /// groove. Forces p between the two, along the line through them, press it against both.
    fn end(&self) -> f64 {
        let borne = |p: f64, i: usize| (self.rough[i] * (self.press[i] + p)).powi(2) - p * p;
        let least = |p: f64| borne(p, 0).min(borne(p, 1));
        // Both are parabolas in p: the best p is where one is largest, or where they cross.
        let peak = |i: usize| self.rough[i].powi(2) * self.press[i] / (1.0 - self.rough[i].powi(2));
        let [one, other] = self.rough;
        let crossing =
            |sign: f64| (sign * other * self.press[1] - one * self.press[0]) / (one - sign * other);
        let places = [peak(0), peak(1), crossing(1.0), crossing(-1.0)];
        let presses = |p: f64| p.is_finite() && p >= -self.press[0].min(self.press[1]);
        let most = places.into_iter().filter(|&p| presses(p)).map(least).fold(0.0, f64::max);
        4.5 * most.sqrt() / self.pull
    }
}

#[test]
fn a_ball_rolls_in_a_groove_until_the_last_possible_shares_are_gone() {
    let cases = [
        // The best share is where both reach their limits …
        ([0.3, 0.4], [2.0, 1.0]),
        ([0.2, 0.1], [1.0, 3.0]),
        ([0.6, 0.15], [1.5, 3.0]),
        // … or where one cone is widest, far from the shortest share.
        ([0.3, 0.3], [2.0, 2.0]),
        ([0.3, 0.5], [2.0, 2.0]),
        ([0.5, 0.2], [1.0, 4.0]),
    ];
    for (rough, press) in cases {
        let groove = Groove::new(rough, press);
        let end = groove.end();
        let rolled = |t: f64| 5.0 / 9.0 * groove.pull / groove.mass * t.powi(3) / 6.0;
        let mut motion = groove.simulate(groove.start()).with_tolerance(1e-12);
        let half = *motion.advance_to(0.5 * end).unwrap();
        close(half.q[1], rolled(half.t), 1e-12);
        let switch = motion.advance_to_switch(2.0 * end).unwrap().unwrap();
        // The margin is known to 256 ulps of the forces, 6e-14 of them. Of the time that is 1e-12 in the worst
        // of these cases, as measured.
        assert!((switch.state.t / end - 1.0).abs() < 2e-12, "{rough:?}: {} instead of {end}", switch.state.t);
        close(switch.before.q[1], rolled(end), 1e-11);

        let after = *motion.advance_to(1.3 * end).unwrap();
        let mut coarse = groove.simulate(groove.start()).with_tolerance(1e-7);
        let again = coarse.advance_to(1.3 * end).unwrap();
        close(after.q[1], again.q[1], 1e-6);
        assert!(after.v[1] > 1.01 * 5.0 / 9.0 * groove.pull / groove.mass * after.t.powi(2) / 2.0);
    }
}

/// A ball with three different moments of inertia that wobbles in the groove. It rolls along the groove, or
/// slips on both.
fn wobbling(number: usize, sample: &mut Samples) -> (Groove, State<f64, 6>) {
    let mut groove = Groove::new(
        [sample.number(0.05, 0.6), sample.number(0.05, 0.6)],
        [sample.number(0.2, 4.0), sample.number(-0.1, 3.0)],
    );
    groove.inertia = [1.0, sample.number(0.7, 1.3), sample.number(0.7, 1.3)];
    let mut start = groove.start();
    start.q[3..].copy_from_slice(&[0.3, 0.2, -0.4].map(|a: f64| a * sample.number(-1.0, 1.0)));
    let spin = sample.number(-8.0, 8.0);
    start.v[1] =
        -spin * groove.radius + if number.is_multiple_of(2) { 0.0 } else { sample.number(-0.5, 0.5) };
    let [sb, cb] = [start.q[4].sin(), start.q[4].cos()];
    let [sa, ca] = [start.q[3].sin(), start.q[3].cos()];
    // Rates of the angles for the angular velocity (spin, 0, spin).
    let rolls = spin * ca / cb;
    (start.v[3], start.v[4], start.v[5]) = (spin + rolls * sb, -spin * sa, rolls);
    (groove, start)
}

/// Follows one at tolerances, the last of which is the finest.
fn wobble(number: usize, groove: &Groove, start: State<f64, 6>, tolerances: &[f64]) {
    let end = |tolerance: f64| {
        let mut motion = groove.simulate(start).with_tolerance(tolerance);
        *motion.advance_to(0.35).unwrap_or_else(|error| panic!("{number}: {error}"))
    };
    let (finest, others) = tolerances.split_last().unwrap();
    let best = end(*finest);
    for &tolerance in others {
        for (own, other) in end(tolerance).q.iter().zip(&best.q) {
            assert!((own - other).abs() < 1e3 * tolerance, "{number}, {tolerance:e}: {own} and {other}");
        }
    }
    assert!(best.q[2] - groove.radius > -TIGHT && -best.q[0] - groove.radius > -TIGHT, "{number}");
}

/// 300 of them wobble in the groove, slip, stick, and leave the wall.
#[test]
#[ignore = "slow: 300 motions"]
fn balls_that_wobble_in_a_groove_go_on() {
    let mut sample = Samples::new(31);
    for number in 0..300 {
        let (groove, start) = wobbling(number, &mut sample);
        wobble(number, &groove, start, &[1e-5, 1e-6, 1e-7, 1e-8, 1e-11]);
    }
}

/// One of them.
fn numbered(number: usize) -> (Groove, State<f64, 6>) {
    let mut sample = Samples::new(31);
    (0..=number).map(|number| wobbling(number, &mut sample)).last().unwrap()
}

/// Of these a motion that had run away long ahead, 28 s or 11 hours, passed for a slip that a growing load
/// begins: the rounding errors of its own forces hid all others, or no shorter time seemed long enough for a
/// slip.
#[test]
fn balls_that_begin_to_slip_do_not_run_away() {
    for (number, tolerance) in [(69, 1e-8), (145, 1e-5), (148, 1e-6), (150, 1e-5), (224, 1e-7)] {
        let (groove, start) = numbered(number);
        wobble(number, &groove, start, &[tolerance, 1e-9]);
    }
}

/// Rounding errors of velocities turn a slip that is so slow. They are no reason for a slower one, which
/// would take more than twenty thousand steps.
#[test]
fn a_slow_slip_begins_as_fast_as_its_load_grows() {
    let (groove, start) = numbered(182);
    let mut motion = groove.simulate(start).with_tolerance(1e-12).with_max_steps(20_000);
    motion.advance_to(0.35).unwrap();
}

/// A grain in a straight groove with frictions of two coefficients, which a growing force pushes along.
struct Grain {
    /// The tilt of the faces \[rad].
    face: f64,
    /// The slope of the groove \[rad].
    slope: f64,
    frictions: [f64; 2],
    push: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl Grain {
    #[point(mass = 1.0)]
    fn grain(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        10.0 * (q.z * self.slope.cos() - q.x * self.slope.sin())
    }

    #[force(on = x)]
    fn force(&self, t: f64) -> f64 {
        self.push * t
    }

    #[unilateral]
    fn faces(&self, q: &Coordinates) -> [f64; 2] {
        [1.0, -1.0].map(|side| q.z * self.face.cos() + side * q.y * self.face.sin())
    }

    #[friction(coefficient = self.frictions[0], normal = faces[0])]
    fn left(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x, v.y * self.face.cos() - v.z * self.face.sin())
    }

    #[friction(coefficient = self.frictions[1], normal = faces[1])]
    fn right(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x, v.y * self.face.cos() + v.z * self.face.sin())
    }
}

#[test]
fn a_grain_stops_and_rests_in_a_groove_of_two_coefficients() {
    let mut samples = Samples::new(29);
    for _ in 0..20 {
        let face = samples.number(0.2, 1.3_f64);
        let frictions = [samples.number(0.02, 0.32), samples.number(0.02, 0.32)];
        // Each face bears g cos(slope) / (2 cos(face)).
        let most = (frictions[0] + frictions[1]) / (2.0 * face.cos());
        let slope = (samples.number(0.0, 0.8) * most).atan();
        let grain = Grain { face, slope, frictions, push: 0.0 };
        let speed = samples.number(0.3, 1.3);
        let slows = 10.0 * (slope.cos() * most - slope.sin());
        for (speed, way) in [(0.0, 0.0), (speed, 0.5 * speed * speed / slows)] {
            let mut motion = grain.simulate(State::new([0.0; 3], [speed, 0.0, 0.0]));
            let end = *motion.advance_to(speed / slows + 1.0).unwrap();
            close_on(1.0 + way, end.q[0], way, 1e-9);
            assert_eq!(end.v, [0.0; 3]);
        }
    }
}

#[test]
fn a_grain_in_a_steep_groove_holds_as_long_as_any_reactions_do() {
    // The largest force that reactions hold, found by writing them down.
    for (face, frictions, holds) in [
        (0.967_288_196_354_871_6, [0.282_567_493_938_796_7; 2], 5.458_589_348_239_824),
        (0.968_875_469_782_762_2, [0.305_692_153_646_589_97; 2], 6.028_532_861_929_597),
    ] {
        let grain = Grain { face, slope: 0.0, frictions, push: holds };
        let mut motion = grain.simulate(State::at_rest([0.0; 3]));
        assert_eq!(motion.advance_to(0.999).unwrap().v, [0.0; 3]);
        assert!(motion.advance_to(1.01).unwrap().v[0] > 0.0);
    }
}
