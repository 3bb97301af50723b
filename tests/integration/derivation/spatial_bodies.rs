//! Bodies in space: every way to compose a rotation, against angular velocities by differences of the pose.

use lagrangian::prelude::*;

use crate::support::close::{all_close, all_close_on_largest, close};
use crate::support::difference::derivative;
use crate::support::identities::model;
use crate::support::sample::Samples;

/// M by differences of a pose: Σ m Jᵣᵀ Jᵣ + Jωᵀ I Jω in body axes.
fn mass_by_differences<const N: usize>(
    mass: f64,
    inertia: Matrix3<f64>,
    q: [f64; N],
    pose: impl Fn([f64; N]) -> Isometry3<f64>,
) -> SMatrix<f64, N, N> {
    let turn = pose(q).rotation.to_rotation_matrix();
    let columns: [(Vector3<f64>, Vector3<f64>); N] = std::array::from_fn(|i| {
        let moved = |x: f64| {
            let mut q = q;
            q[i] += x;
            pose(q)
        };
        let place = derivative(0.004, |x| moved(x).translation.vector.into());
        let slopes: [f64; 9] = derivative(0.004, |x| {
            let matrix = *moved(x).rotation.to_rotation_matrix().matrix();
            std::array::from_fn(|k| matrix.as_slice()[k])
        });
        let skew = turn.matrix().transpose() * Matrix3::from_column_slice(&slopes);
        (Vector3::from(place), Vector3::new(skew[(2, 1)], skew[(0, 2)], skew[(1, 0)]))
    });
    SMatrix::from_fn(|i, j| {
        mass * columns[i].0.dot(&columns[j].0) + columns[i].1.dot(&(inertia * columns[j].1))
    })
}

/// Checks M, T and the identities of a system with one body.
macro_rules! check {
    ($system:expr, $name:ident, $mass:expr, $inertia:expr, $low:expr, $high:expr) => {{
        let mut samples = Samples::new(3);
        for _ in 0..5 {
            let state = samples.state($low, $high);
            let found = $system.mass_matrix(&state);
            let expected = mass_by_differences($mass, $inertia, state.q, |q| $system.$name(&q.into()));
            all_close_on_largest(found.as_slice(), expected.as_slice(), 1e-11);
            let v = SVector::from(state.v);
            close($system.kinetic_energy(&state), 0.5 * v.dot(&(found * v)), 1e-13);
        }
        model!($system).holds($low, $high);
    }};
}

const MOMENTS: [f64; 3] = [0.7, 1.1, 1.6];

fn principal() -> Matrix3<f64> {
    Matrix3::from_diagonal(&MOMENTS.into())
}

/// Roll, pitch and yaw of a flying body.
struct Aeroplane {
    inertia: Matrix3<f64>,
}

#[lagrangian(coordinates = [x, y, z, roll, pitch, yaw])]
impl Aeroplane {
    /// The full tensor in body axes.
    fn tensor(&self) -> Matrix3<f64> {
        self.inertia
    }

    #[body(mass = 1.4, inertia = self.tensor())]
    fn aeroplane(&self, q: &Coordinates) -> Isometry3<f64> {
        let attitude = UnitQuaternion::from_euler_angles(q.roll, q.pitch, q.yaw);
        Isometry3::from_parts(Translation3::new(q.x, q.y, q.z), attitude)
    }
}

#[test]
fn euler_angles_and_a_full_tensor() {
    let aeroplane = Aeroplane { inertia: Matrix3::new(0.7, 0.1, -0.05, 0.1, 1.1, 0.2, -0.05, 0.2, 1.6) };
    check!(aeroplane, aeroplane, 1.4, aeroplane.inertia, -1.0, 1.0);
}

/// A wheel on a steered fork on a leaning frame.
struct Fork {
    inertia: [f64; 3],
    rake: f64,
}

#[lagrangian(coordinates = [lean, steer, spin])]
impl Fork {
    #[body(mass = 0.9, inertia = self.inertia)]
    fn wheel(&self, q: &Coordinates) -> Isometry3<f64> {
        let frame = Isometry3::rotation(Vector3::x() * q.lean);
        let head = Isometry3::new(Vector3::new(1.0, 0.0, 0.8), Vector3::y() * self.rake);
        let fork = Isometry3::from_parts(
            Translation3::identity(),
            UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q.steer),
        );
        frame * head * fork * Translation3::new(0.1, 0.0, -0.6) * UnitQuaternion::new(Vector3::y() * q.spin)
    }
}

#[test]
fn a_chain_of_isometries() {
    let fork = Fork { inertia: MOMENTS, rake: 0.3 };
    check!(fork, wheel, 0.9, principal(), -1.0, 1.0);
}

/// Rotations about skew axes, inverted and given by a matrix.
struct Gimbal {
    axis: Unit<Vector3<f64>>,
}

#[lagrangian(coordinates = [a, b, c])]
impl Gimbal {
    #[body(mass = 1.0, inertia = MOMENTS)]
    fn rotor(&self, q: &Coordinates) -> Isometry3<f64> {
        let outer = Rotation3::from_axis_angle(&self.axis, q.a);
        let middle = (Rotation3::new(Vector3::new(0.6, 0.0, 0.8) * q.b) * outer).inverse();
        let (sin, cos) = (q.c * q.c).sin_cos();
        let inner = Rotation3::from_matrix_unchecked(Matrix3::new(
            cos, -sin, 0.0, //
            sin, cos, 0.0, //
            0.0, 0.0, 1.0,
        ));
        let attitude = middle.transpose() * inner * Rotation3::identity();
        Isometry3::from_parts(Translation3::from(attitude * Vector3::new(0.3, 0.2, q.c)), attitude.into())
    }
}

#[test]
fn skew_axes_inverses_and_matrices() {
    let gimbal = Gimbal { axis: Unit::new_normalize(Vector3::new(1.0, 2.0, -2.0)) };
    check!(gimbal, rotor, 1.0, principal(), 0.3, 1.3);
}

/// Several bodies from one function, with moments of their own.
struct Pair {
    moments: [Vector3<f64>; 2],
}

#[lagrangian(coordinates = [a, b])]
impl Pair {
    #[body(mass = [1.0, 2.0], inertia = self.moments[..])]
    fn bodies(&self, q: &Coordinates) -> [(Vector3<f64>, Rotation3<f64>); 2] {
        let first = Rotation3::from_axis_angle(&Vector3::z_axis(), q.a);
        let second = first * Rotation3::from_axis_angle(&Vector3::y_axis(), q.b);
        [(first * Vector3::x(), first), (second * Vector3::x() * 2.0, second)]
    }
}

#[test]
fn bodies_in_an_array_add_up() {
    let pair = Pair { moments: [Vector3::new(0.1, 0.2, 0.3), Vector3::new(0.5, 0.6, 0.7)] };
    let mut samples = Samples::new(2);
    for _ in 0..5 {
        let state: State<f64, 2> = samples.state(-1.0, 1.0);
        let one = |i: usize, mass: f64| {
            mass_by_differences(mass, Matrix3::from_diagonal(&pair.moments[i]), state.q, |q| {
                let (place, turn) = pair.bodies(&q.into())[i];
                Isometry3::from_parts(place.into(), turn.into())
            })
        };
        let expected = one(0, 1.0) + one(1, 2.0);
        all_close_on_largest(pair.mass_matrix(&state).as_slice(), expected.as_slice(), 1e-10);
    }
    model!(pair).holds(-1.0, 1.0);
}

#[test]
fn a_free_body_keeps_its_angular_momentum_in_space() {
    let aeroplane = Aeroplane { inertia: principal() };
    let start = State::new([0.0, 0.0, 0.0, 0.1, 0.2, 0.3], [1.0, 2.0, 3.0, 0.5, -0.7, 0.9]);
    let momentum = |state: &State<f64, 6>| -> Vector3<f64> {
        // Body rates of yaw about z, pitch about y, roll about x.
        let ([_, _, _, roll, pitch, _], [_, _, _, droll, dpitch, dyaw]) = (state.q, state.v);
        let rates = Vector3::new(
            droll - dyaw * pitch.sin(),
            dpitch * roll.cos() + dyaw * roll.sin() * pitch.cos(),
            -dpitch * roll.sin() + dyaw * roll.cos() * pitch.cos(),
        );
        aeroplane.aeroplane(&state.q.into()).rotation * (principal() * rates)
    };
    let mut motion = aeroplane.simulate(start).with_tolerance(1e-14);
    for t in [0.5, 1.0, 2.0] {
        let state = motion.advance_to(t).unwrap();
        all_close(momentum(state).as_slice(), momentum(&start).as_slice(), 1e-11);
        all_close(&state.q[..3], [t, 2.0 * t, 3.0 * t], 1e-13);
    }
}
