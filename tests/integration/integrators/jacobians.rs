//! Generated derivatives of the equations against differences of order eight of the generated accelerations.

use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::difference::{STEP, derivative, moved};
use crate::support::sample::Samples;

/// A cart with a pole, a damped bearing and a motor.
struct CartPole<R> {
    masses: [R; 2],
    length: R,
    damping: R,
}

#[lagrangian(coordinates = [x, theta], inputs = [motor, wind], jacobians)]
impl<R: Real> CartPole<R> {
    #[point(mass = self.masses[0])]
    fn cart(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, R::zero())
    }

    #[point(mass = self.masses[1])]
    fn tip(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x + self.length * q.theta.sin(), self.length * q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        self.masses[1] * 9.81 * self.tip(q).y
    }

    #[dissipation]
    fn bearing(&self, v: &Velocities<R>) -> R {
        0.5 * self.damping * v.theta.powi(2)
    }

    #[force(on = x)]
    fn drive(&self, u: &Inputs<R>, t: R) -> R {
        u.motor * t.cos()
    }

    #[force(at = tip)]
    fn wind(&self, v: &Velocities<R>, u: &Inputs<R>) -> Vector2<R> {
        Vector2::new(u.wind * u.wind - v.x * v.x.abs(), R::zero())
    }
}

struct DoublePendulum;

#[lagrangian(coordinates = [theta: [2]], jacobians)]
impl DoublePendulum {
    #[point(mass = 1.0)]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta[0].sin(), -q.theta[0].cos())
    }

    #[point(mass = 0.7)]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        self.upper(q) + 1.3 * Vector2::new(q.theta[1].sin(), -q.theta[1].cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * (self.upper(q).y + 0.7 * self.lower(q).y)
    }
}

/// A heavy top by Euler angles, and a spring from its centre of mass to a point that moves.
struct Top;

#[lagrangian(coordinates = [phi, theta, psi], jacobians)]
impl Top {
    #[body(mass = 1.0, inertia = [0.3, 0.5, 0.2])]
    fn top(&self, q: &Coordinates) -> (Vector3<f64>, Rotation3<f64>) {
        let attitude = Rotation3::from_axis_angle(&Vector3::z_axis(), q.phi)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.theta)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.psi);
        (attitude * Vector3::new(0.0, 0.0, 0.8), attitude)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates, t: f64) -> f64 {
        let (centre, _) = self.top(q);
        9.81 * centre.z + 2.0 * (centre - Vector3::new(t.sin(), 0.0, 1.0)).norm_squared()
    }
}

/// A Lagrangian given as a whole, with an indefinite metric and a magnetic term.
struct Saddle;

#[lagrangian(coordinates = [x, y, z], jacobians)]
impl Saddle {
    #[lagrangian]
    fn lagrangian(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let metric = (v.x * v.y + 0.5 * v.z.powi(2) + 0.2 * v.y * v.z) * (2.0 + q.x.sin() * q.z);
        metric + q.x * q.y * v.z - q.z * v.x + q.y.powi(3)
    }
}

/// Beads of a weight that depends on their place, between cubic springs, with a motor at every second: more
/// coordinates and inputs than are named one by one, and matrices that are filled row by row.
struct Beads;

#[lagrangian(coordinates = [x: [40]], inputs = [motor: [20]], jacobians)]
impl Beads {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        (0..40).map(|i| 0.5 * (1.0 + 0.3 * q.x[i].sin()) * v.x[i].powi(2)).sum()
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        q.x.windows(2).map(|pair| 0.25 * (pair[1] - pair[0]).powi(4)).sum()
    }

    #[force]
    fn motors(&self, q: &Coordinates, u: &Inputs) -> [f64; 40] {
        let mut forces = [0.0; 40];
        for i in 0..20 {
            forces[2 * i] = u.motor[i] * q.x[2 * i];
        }
        forces
    }
}

#[track_caller]
fn agrees<S, const N: usize, const K: usize>(system: &S, inputs: [f64; K], low: f64, high: f64)
where
    S: Linearized<N, K, Scalar = f64>,
{
    let mut samples = Samples::new(5);
    for _ in 0..20 {
        let state = samples.state::<N>(low, high);
        let constants = system.constants();
        let accelerations =
            |s: &State<f64, N>, u: &[f64; K]| system.accelerations_at(&constants, s.t, &s.q, &s.v, u);
        let a = accelerations(&state, &inputs);
        // The error of a difference is proportional to the size of its terms.
        let size = a.iter().fold(1.0_f64, |size, a| size.max(a.abs()));
        let found = system.jacobians(&state, &inputs).unwrap();
        for column in 0..N {
            let by = |index: usize| derivative(STEP, |x| accelerations(&moved(&state, index, x), &inputs));
            let (by_q, by_v) = (by(column), by(N + column));
            for row in 0..N {
                close_on(size.max(by_q[row].abs()), found.by_q[(row, column)], by_q[row], 1e-10);
                close_on(size.max(by_v[row].abs()), found.by_v[(row, column)], by_v[row], 1e-10);
            }
        }
        for column in 0..K {
            let by_u = derivative(STEP, |x| {
                let mut u = inputs;
                u[column] += x;
                accelerations(&state, &u)
            });
            for row in 0..N {
                close_on(size.max(by_u[row].abs()), found.by_u[(row, column)], by_u[row], 1e-10);
            }
        }
        let residual = system.residual_at(&constants, state.t, &state.q, &state.v, &a, &inputs);
        assert!(residual.iter().all(|r| r.abs() < 1e-12 * size), "{residual:?}");
    }
}

#[test]
fn a_cart_pole_with_inputs_damping_and_time() {
    agrees(&CartPole { masses: [1.0, 0.3], length: 0.8, damping: 0.2 }, [1.5, -0.4], 0.2, 1.2);
}

#[test]
fn a_double_pendulum() {
    agrees(&DoublePendulum, [], -1.5, 1.5);
}

#[test]
fn a_top_under_a_spring_that_moves() {
    agrees(&Top, [], 0.5, 1.5);
}

#[test]
fn an_indefinite_mass_matrix_and_a_magnetic_term() {
    agrees(&Saddle, [], 0.1, 0.9);
}

#[test]
fn forty_beads_with_twenty_motors() {
    agrees(&Beads, core::array::from_fn(|i| 0.1 * i as f64 - 0.7), -1.2, 1.2);
}

/// A machine on a base that flies: an arm of four hinges with a slide, a leg of three, a carriage on a curve,
/// springs, bearings and a force on the hand. Enough of bodies for derivatives from screws.
struct Machine;

#[lagrangian(
    coordinates = [base: Pose, shoulder: [3], slide, wrist, hip: [3], carriage],
    inputs = [motor],
    jacobians
)]
impl Machine {
    fn base_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        q.base.translation * q.base.rotation.to_rotation_matrix()
    }

    fn arm(&self, q: &Coordinates) -> [IsometryMatrix3<f64>; 5] {
        let upper = self.base_frame(q)
            * Translation3::new(0.2, 0.1, 0.3)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.shoulder[0]);
        let second = upper * Rotation3::from_axis_angle(&Vector3::x_axis(), q.shoulder[1]);
        let elbow = second
            * Translation3::new(0.0, 0.4, 0.1)
            * Rotation3::from_euler_angles(0.3, 0.1, -0.2)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), q.shoulder[2]);
        let slide = elbow * Translation3::new(0.1, q.slide, 0.0);
        let wrist = slide * Rotation3::from_axis_angle(&Vector3::x_axis(), q.wrist);
        [upper, second, elbow, slide, wrist]
    }

    fn leg(&self, q: &Coordinates) -> [IsometryMatrix3<f64>; 3] {
        let hip = self.base_frame(q)
            * Translation3::new(-0.3, 0.0, -0.1)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.hip[0]);
        let thigh = hip * Rotation3::from_axis_angle(&Vector3::y_axis(), q.hip[1]);
        let shank = thigh
            * Translation3::new(0.0, 0.0, -0.5)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), q.hip[2]);
        [hip, thigh, shank]
    }

    #[body(mass = 4.0, inertia = [0.3, 0.4, 0.5])]
    fn base(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.base_frame(q) * Translation3::new(0.02, -0.03, 0.01)
    }

    #[body(mass = 1.2, inertia = [0.03, 0.02, 0.01])]
    fn upper_arm(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.arm(q)[1] * Translation3::new(0.01, 0.2, 0.05)
    }

    #[body(mass = 0.8, inertia = [0.02, 0.03, 0.015])]
    fn elbow(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.arm(q)[2] * Translation3::new(0.0, 0.1, -0.05)
    }

    #[body(mass = 0.5, inertia = [0.004, 0.003, 0.005])]
    fn sledge(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.arm(q)[3]
    }

    #[body(mass = 0.3, inertia = [0.002, 0.003, 0.001])]
    fn hand(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.arm(q)[4] * Translation3::new(0.0, 0.1, 0.05)
    }

    #[body(mass = 0.9, inertia = [0.02, 0.01, 0.03])]
    fn thigh(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.leg(q)[1] * Translation3::new(0.03, 0.0, -0.2)
    }

    #[body(mass = 0.6, inertia = [0.01, 0.02, 0.005])]
    fn shank(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.leg(q)[2] * Translation3::new(0.0, 0.02, -0.2)
    }

    /// On a parabola, turning as it goes.
    #[body(mass = 0.4, inertia = [0.01, 0.02, 0.015])]
    fn carriage(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.base_frame(q)
            * Translation3::new(q.carriage, 0.3 * q.carriage * q.carriage, 0.4)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), 0.6 * q.carriage)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        let arm = 1.2 * self.upper_arm(q).translation.z
            + 0.8 * self.elbow(q).translation.z
            + 0.5 * self.sledge(q).translation.z
            + 0.3 * self.hand(q).translation.z;
        let leg = 0.9 * self.thigh(q).translation.z + 0.6 * self.shank(q).translation.z;
        9.81 * (4.0 * self.base(q).translation.z + arm + leg + 0.4 * self.carriage(q).translation.z)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        2.0 * q.slide.powi(2) + 3.0 * (q.wrist - q.hip[2]).powi(2) + 1.5 * q.carriage.powi(4)
    }

    #[dissipation]
    fn bearings(&self, v: &Velocities) -> f64 {
        0.05 * v.shoulder.iter().map(|v| v * v).sum::<f64>() + 0.1 * v.hip[1].powi(2)
    }

    #[force(at = hand)]
    fn wind(&self, q: &Coordinates, u: &Inputs) -> Vector3<f64> {
        Vector3::new(u.motor * q.wrist.cos(), 0.3, u.motor)
    }
}

#[test]
fn a_machine_of_two_arms_on_a_pose() {
    agrees(&Machine, [0.7], -0.9, 0.9);
}
