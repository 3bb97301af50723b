//! The behaviour on which everything relies, in a quick look: a system of each kind against its closed form
//! or reference digits. `tests/integration`, which `scripts/check.sh integration` runs, is the thorough one.

#[allow(dead_code)]
#[path = "integration/support/close.rs"]
mod close;
#[path = "integration/orientations/elliptic.rs"]
mod elliptic;

use lagrangian::prelude::*;

use close::{all_close, all_close_on_largest, close, close_on};
use elliptic::jacobi;

const G: f64 = 9.81;
const TIGHT: f64 = 1e-15;

struct Pendulum {
    mass: f64,
    length: f64,
}

const PENDULUM: Pendulum = Pendulum { mass: 2.0, length: 0.7 };
const AMPLITUDE: f64 = 2.5;

#[lagrangian(coordinates = [theta])]
impl Pendulum {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        self.length * Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * G * self.bob(q).y
    }
}

/// Angle and rate of a pendulum let go at an angle: sin θ/2 = k cd(ωt), k = sin θ₀/2 (Landau and Lifshitz,
/// *Mechanics*, § 11).
fn swing(t: f64) -> [f64; 2] {
    let k = (AMPLITUDE / 2.0).sin();
    let frequency = (G / PENDULUM.length).sqrt();
    let [_, cn, dn] = jacobi(frequency * t, k * k);
    let sine = k * cn / dn;
    // The rate by the energy; it is negative in the first half of a period.
    [2.0 * sine.asin(), -2.0 * frequency * (k * k - sine * sine).sqrt()]
}

#[test]
fn a_pendulum_swings_as_elliptic_functions_do() {
    let mut motion = PENDULUM.simulate(State::at_rest([AMPLITUDE])).with_tolerance(TIGHT);
    for t in [0.1, 0.4, 0.9] {
        let state = motion.advance_to(t).unwrap();
        all_close([state.q[0], state.v[0]], swing(t), 1e-13);
    }
}

/// The same in Cartesian coordinates on a circle.
struct Bob {
    mass: f64,
    length: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Bob {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * G * q.y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - self.length
    }
}

#[test]
fn a_constraint_holds_the_same_pendulum_and_tells_its_force() {
    let Pendulum { mass, length } = PENDULUM;
    let bob = Bob { mass, length };
    let place = |angle: f64| [length * angle.sin(), -length * angle.cos()];
    let mut motion = bob.simulate(State::at_rest(place(AMPLITUDE))).with_tolerance(TIGHT);
    for t in [0.1, 0.4, 0.9] {
        let [angle, rate] = swing(t);
        let state = *motion.advance_to(t).unwrap();
        all_close(state.q, place(angle), 1e-12);
        close_on(length, state.q[0].hypot(state.q[1]), length, 1e-15);
        // The rod carries the part of the weight along it, and keeps the bob on the circle.
        close(motion.reactions().rod, -mass * (G * angle.cos() + length * rate * rate), 1e-12);
    }
}

#[test]
fn a_start_off_its_constraint_is_refused() {
    let bob = Bob { mass: 1.0, length: 1.0 };
    let error = bob.simulate(State::at_rest([2.0, 0.0])).advance_to(1.0).unwrap_err();
    assert!(matches!(error.cause, Cause::PositionViolated { .. }), "{error}");
}

/// The second angle is relative.
struct Double;

#[lagrangian(coordinates = [theta, relative])]
impl Double {
    #[point(mass = 1.0)]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[point(mass = 1.0)]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        let angle = q.theta + q.relative;
        self.upper(q) + Vector2::new(angle.sin(), -angle.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * (self.upper(q).y + self.lower(q).y)
    }
}

/// Case S08 of `data/seeds.json`.
#[test]
fn a_double_pendulum_has_its_reference_digits() {
    let state = *Double.simulate(State::at_rest([1.0, 0.5])).with_tolerance(TIGHT).advance_to(10.0).unwrap();
    all_close(state.q, [-1.181_535_314_740_716_1, 0.204_834_921_827_908_85], 1e-9);
    all_close(state.v, [1.767_292_963_448_003, -3.317_689_776_487_520_4], 1e-9);
}

struct Ball {
    restitution: f64,
}

#[lagrangian(coordinates = [y])]
impl Ball {
    #[point(mass = 0.3)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(0.0, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        0.3 * G * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }
}

/// The ball falls for √(2h/g). It flies for twice e, e², … of that between its impacts, and rests after all
/// of them.
#[test]
fn a_ball_bounces_in_time_and_comes_to_rest() {
    let ball = Ball { restitution: 0.8 };
    let fall = (2.0 / G).sqrt();
    let mut motion = ball.simulate(State::at_rest([1.0])).with_tolerance(TIGHT);
    let (mut time, mut flight) = (fall, 2.0 * fall);
    for _ in 0..8 {
        let impact = motion.advance_to_switch(10.0).unwrap().unwrap();
        close(impact.state.t, time, 1e-12);
        close(impact.state.v[0], -0.8 * impact.before.v[0], 1e-14);
        flight *= 0.8;
        time += flight;
    }
    let last = *motion.advance_to(10.0).unwrap();
    assert_eq!((last.q[0], last.v[0]), (0.0, 0.0));
    close(motion.reactions().floor, 0.3 * G, 1e-12);
}

struct Rubbing {
    stiffness: f64,
    friction: f64,
}

#[lagrangian(coordinates = [x])]
impl Rubbing {
    #[point(mass = 1.0)]
    fn block(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.x * q.x
    }

    #[friction(limit = self.friction)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

/// Each half period takes 2 F / k of the amplitude, until the spring is weaker than the friction.
#[test]
fn friction_takes_as_much_of_each_swing_and_then_holds() {
    let block = Rubbing { stiffness: 25.0, friction: 2.0 };
    let mut motion = block.simulate(State::at_rest([0.6])).with_tolerance(TIGHT);
    let half = core::f64::consts::PI / 5.0;
    for (turn, place) in [-0.44, 0.28, -0.12, -0.04].into_iter().enumerate() {
        let t = (turn + 1) as f64 * half;
        close_on(1.0, motion.advance_to(t).unwrap().q[0], place, 1e-12);
    }
    assert_eq!(motion.advance_to(100.0).unwrap().v[0], 0.0);
}

struct Body {
    inertia: [f64; 3],
}

#[lagrangian(coordinates = [attitude: Rotation])]
impl Body {
    #[body(mass = 1.0, inertia = self.inertia)]
    fn body(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::identity(), q.attitude)
    }
}

/// A free symmetric body turns at L/A about its angular momentum while it spins at (1 − C/A) ω₃ about its own
/// axis (Landau and Lifshitz, § 33): several times around, through every attitude.
#[test]
fn a_free_symmetric_body_precesses_evenly() {
    let (across, along) = (1.0, 1.8);
    let body = Body { inertia: [across, across, along] };
    let attitude = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -1.1, 0.4));
    let rates = Vector3::new(1.5, -0.4, 2.0);
    let momentum = attitude * Vector3::new(across * rates.x, across * rates.y, along * rates.z);
    let start = body.state(BodyCoordinates { attitude }, BodyVelocities { attitude: rates });
    let mut motion = body.simulate(start).with_tolerance(TIGHT);
    for t in [0.5, 2.0, 10.0] {
        let state = *motion.advance_to(t).unwrap();
        let found = BodyCoordinates::from(state.q).attitude.to_rotation_matrix();
        let precession = UnitQuaternion::from_scaled_axis(momentum * (t / across));
        let spin = UnitQuaternion::from_scaled_axis(Vector3::z() * ((1.0 - along / across) * rates.z * t));
        let expected = (precession * attitude * spin).to_rotation_matrix();
        all_close_on_largest(found.matrix(), expected.matrix(), 1e-12);
    }
}

/// A planet is back after its period, 2π for unit masses and axes, and has swept as much as it should.
#[test]
fn a_planet_returns() {
    let start = State::new([0.4, 0.0], [0.0, 2.0]);
    let mut motion = Planet.simulate(start).with_tolerance(TIGHT);
    let state = *motion.advance_to(core::f64::consts::TAU).unwrap();
    close_on(1.0, state.q[0], 0.4, 1e-12);
    close_on(1.0, state.q[1], 0.0, 1e-12);
    close(motion.energy(), -0.5, 1e-14);
    close(state.q[0] * state.v[1] - state.q[1] * state.v[0], 0.8, 1e-14);
}

struct Planet;

#[lagrangian(coordinates = [x, y])]
impl Planet {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (v.x * v.x + v.y * v.y)
    }

    #[potential]
    fn sun(&self, q: &Coordinates) -> f64 {
        -q.x.hypot(q.y).recip()
    }
}
