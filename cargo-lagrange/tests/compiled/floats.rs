//! Bodies that fly freely and ball joints: poses beside angles, and beside another program.

use lagrangian::prelude::*;

use super::two_link::TwoLinkArm;
use super::{close, spread};

/// A floating base that rests where the fixed one stands has the same energies.
#[test]
fn a_floating_base_can_stand_still() {
    use super::two_link_floating::TwoLinkArm as Floating;
    let ([a, b], [c, d]) = (spread(1, 2.0), spread(2, 2.0));
    let floating = State::new([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, a, b], [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, c, d]);
    let fixed = State::new([a, b], [c, d]);
    let (on, off) = (TwoLinkArm::default(), Floating::default());
    close(&[off.kinetic_energy(&floating)], &[on.kinetic_energy(&fixed)], 1e-14);
    close(&[off.potential_energy(&floating)], &[on.potential_energy(&fixed)], 1e-14);
    // Lifted by a metre, it is heavier by its weight.
    let mut lifted = floating;
    lifted.q[2] = 1.0;
    let weight = off.potential_energy(&lifted) - off.potential_energy(&floating);
    close(&[weight], &[9.81 * 2.3], 1e-13);
}

/// The rate of named velocities along accelerations, by a difference of order four.
fn change<const N: usize>(
    state: &State<f64, N>,
    accelerations: &[f64; N],
    named: impl Fn(&State<f64, N>) -> Vector3<f64>,
) -> Vector3<f64> {
    let at = |tau: f64| {
        let q = std::array::from_fn(|i| state.q[i] + tau * state.v[i]);
        named(&State::new(q, std::array::from_fn(|i| state.v[i] + tau * accelerations[i])))
    };
    let step = 1e-3;
    (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step)
}

/// A pose and three shifts with three angles are the same drone: the same accelerations of all parts.
#[test]
fn a_pose_moves_as_angles_do() -> Result<(), Box<dyn std::error::Error>> {
    use super::everything::{Everything, EverythingCoordinates, EverythingVelocities};
    use super::everything_euler;
    let (pose, angles) = (Everything::default(), everything_euler::Everything::default());
    for case in 0..50 {
        let by_angles = State::new(spread::<11>(case, 1.2), spread::<11>(case + 50, 2.0));
        // The angular velocity in body axes by the rates of roll, pitch and yaw.
        let of_angles = |state: &State<f64, 11>| {
            let ([roll, pitch], [a, b, c]) =
                ([state.q[8], state.q[9]], [state.v[8], state.v[9], state.v[10]]);
            Vector3::new(
                a - c * pitch.sin(),
                b * roll.cos() + c * roll.sin() * pitch.cos(),
                c * roll.cos() * pitch.cos() - b * roll.sin(),
            )
        };
        let [q, v] = [by_angles.q, by_angles.v];
        let by_pose = pose.state(
            EverythingCoordinates {
                slide_joint: q[0],
                type_: q[1],
                puck_x: q[2],
                puck_y: q[3],
                puck_angle: q[4],
                drone: Isometry3::from_parts(
                    Translation3::new(q[5], q[6], q[7]),
                    UnitQuaternion::from_euler_angles(q[8], q[9], q[10]),
                ),
            },
            EverythingVelocities {
                slide_joint: v[0],
                type_: v[1],
                puck_x: v[2],
                puck_y: v[3],
                puck_angle: v[4],
                drone: PoseVelocity {
                    linear: Vector3::new(v[5], v[6], v[7]),
                    angular: of_angles(&by_angles),
                },
            },
        );
        let expected = angles.accelerations(&by_angles, &[0.4, -0.3])?;
        let found = pose.accelerations(&by_pose, &[0.4, -0.3])?;
        close(&found[..8], &expected[..8], 1e-12);
        let found = change(&by_pose, &found, |state| pose.velocities(state).drone.angular);
        let expected = change(&by_angles, &expected, of_angles);
        // The truncation error of the differences is about the fourth power of their step, a thousandth.
        close(found.as_slice(), expected.as_slice(), 1e-8);
    }
    Ok(())
}

/// A free and a ball joint with damping and rotors, the pitch of the base at a right angle: accelerations and
/// energies by MuJoCo 4.0, which has the same velocities.
#[test]
fn a_floating_robot_is_that_of_mujoco() -> Result<(), Box<dyn std::error::Error>> {
    use super::floating::{Floating, FloatingCoordinates, FloatingVelocities};
    let robot = Floating::default();
    let turn = UnitQuaternion::from_euler_angles(0.4, std::f64::consts::FRAC_PI_2, -0.9);
    let state = robot.state(
        FloatingCoordinates {
            base: Isometry3::from_parts(Translation3::new(0.3, -0.2, 0.7), turn),
            shoulder: UnitQuaternion::from_euler_angles(2.5, -0.6, 1.1),
            wrist: 0.8,
        },
        FloatingVelocities {
            base: PoseVelocity {
                linear: Vector3::new(0.5, -0.4, 0.3),
                angular: Vector3::new(1.1, -0.7, 0.9),
            },
            shoulder: Vector3::new(-1.3, 0.6, 0.8),
            wrist: 1.7,
        },
    );
    close(&[robot.potential_energy(&state)], &[18.092_045_616_335_643], 1e-12);
    close(&[robot.kinetic_energy(&state)], &[0.795_398_770_471_150_8], 1e-12);
    let found = robot.accelerations(&state, &[0.25])?;
    let turned = |name: fn(&FloatingVelocities<f64>) -> Vector3<f64>| {
        change(&state, &found, |state| name(&robot.velocities(state)))
    };
    let (base, shoulder) = (turned(|v| v.base.angular), turned(|v| v.shoulder));
    let [a, b, c, .., wrist] = found;
    close(
        &[a, b, c, wrist],
        &[-0.8388129663859569, -0.6081178677158405, -7.976255897649905, 404.5674357826931],
        1e-11,
    );
    close(
        &[base.as_slice(), shoulder.as_slice()].concat(),
        &[
            -12.53874272441668,
            -0.19746268489114627,
            -14.653555428553844,
            10.61119223048967,
            -45.78737291543001,
            -9.639767027331239,
        ],
        1e-7,
    );
    Ok(())
}
