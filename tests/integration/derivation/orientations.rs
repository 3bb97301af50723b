//! Orientations by quaternions, by axes that move, and poses among the parameters.

use lagrangian::State;
use lagrangian::prelude::*;

use crate::support::close::{all_close, close};
use crate::support::sample::Samples;

const MOMENTS: [f64; 3] = [0.3, 0.5, 0.9];

/// A top with three moments about a fixed point, by a quaternion whose length a constraint holds.
struct ByQuaternion;

#[lagrangian(coordinates = [e: [4]])]
impl ByQuaternion {
    fn quaternion(&self, q: &Coordinates) -> Quaternion<f64> {
        Quaternion::new(q.e[0], q.e[1], q.e[2], q.e[3])
    }

    #[body(mass = 2.0, inertia = MOMENTS)]
    fn top(&self, q: &Coordinates) -> (Vector3<f64>, UnitQuaternion<f64>) {
        let turn = UnitQuaternion::from_quaternion(self.quaternion(q));
        (turn * Vector3::new(0.1, 0.2, 0.7), turn)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * self.top(q).0.z
    }

    #[holonomic]
    fn unit(&self, q: &Coordinates) -> f64 {
        self.quaternion(q).norm_squared() - 1.0
    }

    fn rates(&self, q: &Coordinates, v: &Velocities) -> Twist3<f64> {
        self.top_velocity(q, v)
    }
}

/// The same by Euler angles.
struct ByAngles;

#[lagrangian(coordinates = [roll, pitch, yaw])]
impl ByAngles {
    #[body(mass = 2.0, inertia = MOMENTS)]
    fn top(&self, q: &Coordinates) -> (Vector3<f64>, UnitQuaternion<f64>) {
        let turn = UnitQuaternion::from_euler_angles(q.roll, q.pitch, q.yaw);
        (turn * Vector3::new(0.1, 0.2, 0.7), turn)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * self.top(q).0.z
    }

    fn rates(&self, q: &Coordinates, v: &Velocities) -> Twist3<f64> {
        self.top_velocity(q, v)
    }
}

#[test]
fn a_quaternion_moves_a_top_as_angles_do() {
    let (angles, rates) = ([0.4, -0.3, 0.8], [0.6, 1.1, -0.7]);
    let start = State::new(angles, rates);
    let turn = UnitQuaternion::from_euler_angles(angles[0], angles[1], angles[2]);
    let twist = ByAngles.rates(&angles.into(), &rates.into());
    // q′ = ½ q Ω, with a Quaternion of the body's rates.
    let rate = turn.quaternion() * Quaternion::from_imag(twist.angular_velocity_in_body) * 0.5;
    let parts = |q: &Quaternion<f64>| [q.w, q.i, q.j, q.k];
    let other = State::new(parts(turn.quaternion()), parts(&rate));
    let found = ByQuaternion.rates(&other.q.into(), &other.v.into());
    all_close(found.velocity.as_slice(), twist.velocity.as_slice(), 1e-13);
    all_close(found.angular_velocity.as_slice(), twist.angular_velocity.as_slice(), 1e-13);
    all_close(found.angular_velocity_in_body.as_slice(), twist.angular_velocity_in_body.as_slice(), 1e-13);
    close(ByQuaternion.energy(&other), ByAngles.energy(&start), 1e-13);
    // A velocity along the quaternion turns nothing.
    let along = std::array::from_fn(|i| other.v[i] + 0.7 * other.q[i]);
    let same = ByQuaternion.rates(&other.q.into(), &along.into());
    all_close(same.angular_velocity.as_slice(), twist.angular_velocity.as_slice(), 1e-13);

    let mut motion = ByAngles.simulate(start).with_tolerance(1e-13);
    let mut by_quaternion = ByQuaternion.simulate(other).with_tolerance(1e-13);
    let (end, other) =
        (*motion.advance_to(0.5).expect("angles"), *by_quaternion.advance_to(0.5).expect("parts"));
    let (at, expected) = (ByQuaternion.top(&other.q.into()).0, ByAngles.top(&end.q.into()).0);
    all_close(at.as_slice(), expected.as_slice(), 1e-10);
}

/// A body that turns about an axis which swings round, and the same made of fixed axes.
struct MovingAxis;

#[lagrangian(coordinates = [round, turn, own])]
impl MovingAxis {
    #[body(mass = 1.0, inertia = MOMENTS)]
    fn body(&self, q: &Coordinates) -> (Vector3<f64>, Rotation3<f64>) {
        let axis = Unit::new_normalize(Vector3::new(2.0 * q.round.cos(), 2.0 * q.round.sin(), 0.0));
        let turn =
            Rotation3::from_axis_angle(&axis, q.turn) * Rotation3::from_axis_angle(&Vector3::z_axis(), q.own);
        (turn * Vector3::new(0.2, 0.1, 0.4), turn)
    }
}

struct FixedAxes;

#[lagrangian(coordinates = [round, turn, own])]
impl FixedAxes {
    #[body(mass = 1.0, inertia = MOMENTS)]
    fn body(&self, q: &Coordinates) -> (Vector3<f64>, Rotation3<f64>) {
        let about_z = Rotation3::from_axis_angle(&Vector3::z_axis(), q.round);
        let turn = about_z
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.turn)
            * about_z.inverse()
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.own);
        (turn * Vector3::new(0.2, 0.1, 0.4), turn)
    }
}

#[test]
fn an_axis_that_moves_is_one_of_fixed_ones() {
    let mut samples = Samples::new(21);
    for _ in 0..5 {
        let state = samples.state::<3>(0.3, 1.2);
        close(MovingAxis.kinetic_energy(&state), FixedAxes.kinetic_energy(&state), 1e-13);
        let (found, expected) = (MovingAxis.accelerations(&state), FixedAxes.accelerations(&state));
        all_close(found.expect("moving"), expected.expect("fixed"), 1e-10);
    }
}

/// Poses among the parameters, of every type that nalgebra has for them.
struct Mounted {
    base: Isometry3<f64>,
    matrix: IsometryMatrix3<f64>,
    planar: Isometry2<f64>,
    pair: [Isometry3<f64>; 2],
    turn: Quaternion<f64>,
    weight: Box<f64>,
}

#[lagrangian(coordinates = [a, b])]
impl Mounted {
    #[body(mass = *self.weight, inertia = MOMENTS)]
    fn arm(&self, q: &Coordinates) -> Isometry3<f64> {
        let base: Isometry3<f64> = self.base;
        base * Isometry3::new(Vector3::new(q.a, 0.2, 0.0), Vector3::y() * q.b)
    }

    #[potential]
    fn heights(&self, q: &Coordinates) -> f64 {
        let matrix: IsometryMatrix3<f64> = self.matrix;
        let planar: Isometry2<f64> = self.planar;
        let pair: [Isometry3<f64>; 2] = self.pair;
        let turn: Quaternion<f64> = self.turn;
        let moved = Quaternion::new(q.a, q.b, 0.3, -0.2) * turn.conjugate() - 0.5 * turn;
        let own = *self.weight * q.b.sin();
        (matrix * Point3::new(q.a, q.b, 0.4)).z
            + (planar * Point2::new(q.b, q.a)).x
            + (pair[1] * (pair[0] * Point3::new(q.a, 0.1, q.b))).y
            + moved.w * moved.k
            + moved.imag().dot(&Vector3::new(1.0, 2.0, 3.0))
            + (UnitQuaternion::new_normalize(moved) * Vector3::new(q.a, 0.0, 1.0)).x
            + own
    }
}

#[test]
fn poses_are_parameters() {
    let pose =
        |k: f64| Isometry3::new(Vector3::new(0.1 * k, 0.2, -0.3 * k), Vector3::new(0.4, -0.5 * k, 0.6));
    let mounted = Mounted {
        base: pose(1.0),
        matrix: IsometryMatrix3::new(Vector3::new(1.0, 2.0, 3.0), Vector3::new(-0.3, 0.4, 0.8)),
        planar: Isometry2::new(Vector2::new(0.3, -0.4), 0.7),
        pair: [pose(-0.5), pose(2.0)],
        turn: Quaternion::new(0.3, -0.8, 0.4, 1.2),
        weight: Box::new(1.7),
    };
    let state = State::new([0.4, -0.6], [0.8, 0.5]);
    close(mounted.potential_energy(&state), mounted.heights(&state.q.into()), 1e-13);
    // ½ m ṙ² + ½ I ω² for any base: it changes neither speed.
    let [u, w] = state.v;
    close(mounted.kinetic_energy(&state), 0.5 * 1.7 * u * u + 0.5 * MOMENTS[1] * w * w, 1e-13);
}
