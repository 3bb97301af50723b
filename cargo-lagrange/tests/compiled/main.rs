//! Imported descriptions, compiled: against the same robots written by hand, and against other programs.

use lagrangian::prelude::*;

mod floats;

mod two_link {
    include!("../snapshots/two_link.rs");
}
mod two_link_rough {
    include!("../snapshots/two_link_rough.rs");
}
mod two_link_parameters {
    include!("../snapshots/two_link_parameters.rs");
}
mod two_link_floating {
    include!("../snapshots/two_link_floating.rs");
}
mod everything_euler {
    include!("../snapshots/everything_euler.rs");
}
mod floating {
    include!("../snapshots/floating.rs");
}
mod two_link_mjcf {
    include!("../snapshots/two_link_mjcf.rs");
}
mod everything {
    include!("../snapshots/everything.rs");
}
mod everything_constrained {
    include!("../snapshots/everything_constrained.rs");
}
mod hostile {
    include!("../snapshots/hostile.rs");
}
mod hostile_rough {
    include!("../snapshots/hostile_rough.rs");
}
mod tied_constrained {
    include!("../snapshots/tied_constrained.rs");
}
mod joints {
    include!("../snapshots/joints.rs");
}

/// The program that the help shows.
mod usage {
    use super::two_link::TwoLinkArm as Arm;
    use lagrangian::prelude::*;

    include!("../files/usage.rs");

    #[test]
    fn the_program_in_the_help_runs() -> Result<(), MotionError<f64>> {
        main()
    }
}

use everything::Everything;
use everything_constrained::Everything as Constrained;
use joints::Joints;
use two_link::TwoLinkArm;

/// The arm of `two_link.urdf` in its plane, written by hand. Angles turn the z axis towards the x axis.
struct ByHand {
    mass: [f64; 2],
    /// Distance of the centres of mass below the joints.
    centre: [f64; 2],
    inertia: [f64; 2],
    damping: [f64; 2],
    armature: f64,
    spring: f64,
}

#[lagrangian(coordinates = [shoulder, elbow], inputs = [torque: [2]])]
impl ByHand {
    #[body(mass = self.mass[0], inertia = self.inertia[0])]
    fn upper(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (-self.centre[0] * Vector2::new(q.shoulder.sin(), q.shoulder.cos()), q.shoulder)
    }

    #[body(mass = self.mass[1], inertia = self.inertia[1])]
    fn lower(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        let angle = q.shoulder + q.elbow;
        let elbow = -0.4 * Vector2::new(q.shoulder.sin(), q.shoulder.cos());
        (elbow - self.centre[1] * Vector2::new(angle.sin(), angle.cos()), angle)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (self.mass[0] * self.upper(q).0.y + self.mass[1] * self.lower(q).0.y)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.spring * (q.elbow - 30_f64.to_radians()).powi(2)
    }

    #[kinetic]
    fn armature(&self, v: &Velocities) -> f64 {
        0.5 * self.armature * v.shoulder.powi(2)
    }

    #[dissipation]
    fn damping(&self, v: &Velocities) -> f64 {
        0.5 * (self.damping[0] * v.shoulder.powi(2) + self.damping[1] * v.elbow.powi(2))
    }

    #[force]
    fn motors(&self, u: &Inputs) -> [f64; 2] {
        u.torque
    }
}

const URDF: ByHand = ByHand {
    mass: [1.5, 0.8],
    centre: [0.2, 0.15],
    inertia: [0.03, 0.012],
    damping: [0.2, 0.1],
    armature: 0.0,
    spring: 0.0,
};

/// Numbers without a pattern, from −`size` to `size`.
fn spread<const N: usize>(case: usize, size: f64) -> [f64; N] {
    std::array::from_fn(|i| size * ((case * 31 + i * 17) as f64 * 0.7391 + 0.3).sin())
}

/// The largest difference is a rounding error of the largest entry.
fn close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(f64::MIN_POSITIVE, |size, entry| size.max(entry.abs()));
    for (a, b) in found.iter().zip(expected) {
        // A difference that is no number is not below anything.
        assert!((a - b).abs() <= tolerance * size, "{found:?} is not {expected:?}");
    }
}

#[test]
fn an_imported_arm_is_the_one_by_hand() -> Result<(), Box<dyn std::error::Error>> {
    let parametric = two_link_parameters::TwoLinkArm::default();
    for case in 0..100 {
        let state = State::new(spread(case, 3.0), spread(case + 1000, 4.0));
        let inputs = spread(case + 2000, 5.0);
        let expected = URDF.accelerations(&state, &inputs)?;
        close(&TwoLinkArm::default().accelerations(&state, &inputs)?, &expected, 1e-13);
        close(&parametric.accelerations(&state, &inputs)?, &expected, 1e-13);
    }
    // A field is the number in the file: twice the mass is another arm.
    let heavy = two_link_parameters::TwoLinkArm { lower_mass: 1.6, ..parametric };
    let by_hand = ByHand { mass: [1.5, 1.6], ..URDF };
    let state = State::new([0.3, -0.4], [1.0, 2.0]);
    close(&heavy.accelerations(&state, &[0.0; 2])?, &by_hand.accelerations(&state, &[0.0; 2])?, 1e-13);
    Ok(())
}

/// Masses of geoms, degrees, defaults, rotors, springs and gears of `two_link.xml`.
#[test]
fn an_arm_of_mjcf_is_the_one_by_hand() -> Result<(), Box<dyn std::error::Error>> {
    let (radius, half) = (0.02_f64, 0.15_f64);
    let cylinder = 500.0 * std::f64::consts::PI * radius * radius * 2.0 * half;
    let ends = 500.0 * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
    let rod = cylinder + ends;
    let about_centre = cylinder * (radius * radius / 4.0 + half * half / 3.0)
        + ends * (0.4 * radius * radius + half * half + 0.75 * half * radius);
    // About y a quarter turn exchanges the sizes along x and z.
    let tip = 0.4 / 3.0 * (0.03_f64.powi(2) + 0.05_f64.powi(2));
    let mass = rod + 0.4;
    let centre = (rod * half + 0.4 * 0.3) / mass;
    let inertia = about_centre + rod * (centre - half).powi(2) + tip + 0.4 * (0.3 - centre).powi(2);
    let by_hand = ByHand {
        mass: [1.5, mass],
        centre: [0.2, centre],
        inertia: [0.03, inertia],
        armature: 0.05,
        spring: 3.0,
        ..URDF
    };
    for case in 0..100 {
        let state = State::new(spread(case, 3.0), spread(case + 1000, 4.0));
        let [elbow, shoulder] = spread(case + 2000, 1.0);
        let expected = by_hand.accelerations(&state, &[shoulder, 20.0 * elbow])?;
        let arm = two_link_mjcf::TwoLinkArm::default();
        close(&arm.accelerations(&state, &[elbow, shoulder])?, &expected, 1e-13);
    }
    Ok(())
}

#[test]
fn stops_and_friction_hold() -> Result<(), Box<dyn std::error::Error>> {
    let arm = two_link_rough::Rough::default();
    let mut motion = arm.simulate(State::at_rest([1.9, 0.0])).with_inputs([30.0, 0.0]);
    for _ in 0..20 {
        let state = *motion.advance_to(motion.state().t + 0.1)?;
        assert!(state.q[0] <= 2.0 + 1e-12, "the shoulder has its stop at 2 rad, not at {}", state.q[0]);
    }
    assert!((motion.state().q[0] - 2.0).abs() < 1e-9, "the motor holds it there");
    Ok(())
}

/// Mass, centre and tensor in a frame, and the frame as a function of the coordinates.
type Part<'a, const N: usize> =
    (f64, Vector3<f64>, Matrix3<f64>, &'a dyn Fn([f64; N]) -> IsometryMatrix3<f64>);

/// The energies of a robot by the numbers of its file, body by body.
fn energies<const N: usize>(state: &State<f64, N>, parts: &[Part<'_, N>]) -> (f64, f64) {
    let (mut kinetic, mut potential) = (0.0, 0.0);
    for (mass, centre, tensor, frame) in parts {
        // Differences of order four along the velocity.
        let step = 1e-3;
        let at = |k: f64| frame(std::array::from_fn(|i| state.q[i] + k * step * state.v[i]));
        let place = |k: f64| at(k).rotation * centre + at(k).translation.vector;
        let turn = |k: f64| at(k).rotation.into_inner();
        let velocity = (8.0 * (place(1.0) - place(-1.0)) - (place(2.0) - place(-2.0))) / (12.0 * step);
        let rate = (8.0 * (turn(1.0) - turn(-1.0)) - (turn(2.0) - turn(-2.0))) / (12.0 * step);
        let spin = turn(0.0).transpose() * rate;
        let omega = Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]);
        kinetic += 0.5 * mass * velocity.dot(&velocity) + 0.5 * omega.dot(&(tensor * omega));
        potential += mass * 9.81 * place(0.0).z;
    }
    (kinetic, potential)
}

/// Lumped parts, joints of all types and a follower: the energies are those of the parts in the file.
#[test]
fn everything_has_the_energies_of_its_parts() {
    use everything::EverythingCoordinates as At;
    let robot = Everything::default();
    let diagonal = |a: f64, b: f64, c: f64| Matrix3::from_diagonal(&Vector3::new(a, b, c));
    let mut payload = diagonal(0.2, 0.2, 0.3);
    (payload[(0, 1)], payload[(1, 0)]) = (0.01, 0.01);
    let tilted = Rotation3::from_axis_angle(&Vector3::y_axis(), 0.2).into_inner();
    let drone = tilted * diagonal(0.02, 0.02, 0.03) * tilted.transpose();
    let finger = Vector3::new(0.0, 0.1, 0.0);
    for case in 0..50 {
        let state = State::new(spread::<11>(case, 1.0), spread::<11>(case + 500, 1.0));
        let (kinetic, potential) = energies(
            &state,
            &[
                (2.0, Vector3::zeros(), diagonal(0.1, 0.1, 0.1), &|q| robot.slider_frame(&At::from(q))),
                (2.0, Vector3::new(0.2, 0.0, 0.0), payload, &|q| robot.box_frame(&At::from(q))),
                (0.3, finger, diagonal(0.001, 0.001, 0.001), &|q| robot.finger_1_frame(&At::from(q))),
                (0.3, finger, diagonal(0.001, 0.001, 0.001), &|q| robot.finger_1_2_frame(&At::from(q))),
                (0.5, Vector3::zeros(), diagonal(0.002, 0.001, 0.001), &|q| robot.puck_frame(&At::from(q))),
                (0.9, Vector3::zeros(), drone, &|q| robot.drone_frame(&At::from(q))),
            ],
        );
        close(&[robot.kinetic_energy(&state)], &[kinetic], 1e-9);
        close(&[robot.potential_energy(&state)], &[potential], 1e-12);
    }
}

/// The frames of `everything.urdf`, joint by joint, by what URDF says of each.
#[test]
fn frames_are_those_of_urdf() {
    let robot = Everything::default();
    let q = spread::<11>(3, 1.0);
    let at = everything::EverythingCoordinates::from(q);
    let about =
        |axis: Vector3<f64>, angle: f64| Rotation3::from_axis_angle(&Unit::new_normalize(axis), angle);
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let pose = |shift: Vector3<f64>, turn: Rotation3<f64>| IsometryMatrix3::from_parts(shift.into(), turn);
    let still = Rotation3::identity();
    let base = pose(z, still);
    // The file has seven decimals of this angle.
    let yaw = "-1.5707963".parse().expect("it is a number");
    let bent = about(z, yaw) * about(x, std::f64::consts::FRAC_PI_2);
    let slider = base * pose(0.1 * x, bent) * pose(-at.slide_joint * y, still);
    let tip = slider * pose(0.5 * z, about(z, std::f64::consts::PI)) * pose(0.1 * z, about(x, 0.3));
    let follower = -0.5 * at.type_ + 0.1;
    // The last three numbers of a state are 4 tan(θ/4) along the axis of the turn.
    let turn = Vector3::new(q[8], q[9], q[10]);
    let drone = about(turn, 4.0 * (turn.norm() / 4.0).atan());
    for (found, expected) in [
        (robot.base_link_frame(), base),
        (robot.slider_frame(&at), slider),
        (robot.tip_frame(&at), tip),
        (robot.finger_1_frame(&at), tip * about(x + y, at.type_)),
        (robot.finger_1_2_frame(&at), tip * pose(0.05 * y, about(z, follower))),
        (robot.puck_frame(&at), base * pose(at.puck_x * y + at.puck_y * z, about(x, at.puck_angle))),
        (robot.drone_frame(&at), pose(Vector3::new(q[5], q[6], q[7]), drone)),
    ] {
        close(found.to_homogeneous().as_slice(), expected.to_homogeneous().as_slice(), 1e-14);
    }
}

/// A follower tied by a constraint moves as one without a coordinate.
#[test]
fn both_kinds_of_followers_move_alike() -> Result<(), Box<dyn std::error::Error>> {
    let (without, tied) = (Everything::default(), Constrained::default());
    let place =
        Constrained::COORDINATES.iter().position(|name| *name == "follower").ok_or("it has a coordinate")?;
    let leader = place - 1;
    assert_eq!(Constrained::COORDINATES[leader], "type_");
    for case in 0..50 {
        let (q, v): ([f64; 11], [f64; 11]) = (spread(case, 0.8), spread(case + 50, 0.8));
        // The entry of the follower pushes those behind it by one.
        let with = |from: &[f64; 11], follower: f64| -> [f64; 12] {
            std::array::from_fn(|i| match i.cmp(&place) {
                std::cmp::Ordering::Less => from[i],
                std::cmp::Ordering::Equal => follower,
                std::cmp::Ordering::Greater => from[i - 1],
            })
        };
        let state = State::new(with(&q, -0.5 * q[leader] + 0.1), with(&v, -0.5 * v[leader]));
        assert!(tied.constraint_residuals(&state)[0].abs() < 1e-15);
        let expected = without.accelerations(&State::new(q, v), &[0.4, -0.3])?;
        // A torque of the follower acts on the leader through the gear.
        let found = tied.accelerations(&state, &[0.4, -0.2, 0.2])?;
        close(&found, &with(&expected, -0.5 * expected[leader]), 1e-12);
    }
    Ok(())
}

/// Three pendulums that two ties make one, and a slide that does not move.
#[test]
fn a_joint_tied_to_two_others_moves_them() -> Result<(), Box<dyn std::error::Error>> {
    let system = tied_constrained::Tied::default();
    let zero = 20_f64.to_radians();
    // The tie of `one` and `two` is one of their ways from the pose of the file.
    let pendulums = [(1.0, 0.5, 1.0), (2.0, 0.4, 0.5), (3.0, 0.3, 1.0)];
    for case in 0..20 {
        let [one, speed] = spread(case, 1.5);
        let way = 0.5 * (one - 0.1);
        let angles = [one, way, one];
        let state = State::new([one, way + zero, one, 0.05], [speed, 0.5 * speed, speed, 0.0]);
        assert!(system.constraint_residuals(&state).iter().all(|residual| residual.abs() < 1e-15));
        let (mut inertia, mut torque) = (0.0, 0.0);
        for ((mass, length, factor), angle) in pendulums.into_iter().zip(angles) {
            inertia += factor * factor * mass * (length * length + 0.4 * 0.1_f64.powi(2));
            torque -= factor * mass * 9.81 * length * angle.sin();
        }
        let expected = torque / inertia;
        let found = system.accelerations(&state)?;
        close(&found, &[expected, 0.5 * expected, expected, 0.0], 1e-13);
    }
    Ok(())
}

/// Names that mean something else elsewhere do no harm.
#[test]
fn hostile_names_are_names() -> Result<(), Box<dyn std::error::Error>> {
    assert_eq!(hostile::State::COORDINATES[..3], ["q", "self_", "gravity"]);
    let system = hostile::State::default();
    let state = State::new(spread::<9>(1, 1.0), spread::<9>(2, 1.0));
    let accelerations = system.accelerations(&state, &[0.1, 0.2, 0.3])?;
    assert!(accelerations.iter().all(|entry| entry.is_finite()));
    let rough = hostile_rough::State::default();
    let start = State::at_rest([0.0; 10]);
    rough.simulate(start).with_inputs([0.1; 4]).advance_to(0.01)?;
    Ok(())
}

/// Several joints in a body, a ball, references, a tilted gravity and a follower: energies by MuJoCo 4.0
/// (½ vᵀ M v, and −Σ m g·r of the bodies).
#[test]
fn joints_have_the_energies_of_mujoco() {
    use joints::{JointsCoordinates, JointsVelocities};
    let joints = Joints::default();
    // The angular velocity of roll, pitch and yaw 0.5, 0.6, −0.7 with the rates 0.6, 0.9, −1.1.
    let ((sr, cr), (sp, cp)) = (0.5_f64.sin_cos(), 0.6_f64.sin_cos());
    let spin = Vector3::new(0.6 + 1.1 * sp, 0.9 * cr - 1.1 * sr * cp, -0.9 * sr - 1.1 * cr * cp);
    let state = joints.state(
        JointsCoordinates {
            yaw: 0.4,
            roll: -0.3,
            body_3: UnitQuaternion::from_euler_angles(0.5, 0.6, -0.7),
            left: 0.2,
        },
        JointsVelocities { yaw: 1.0, roll: -0.8, body_3: spin, left: 0.7 },
    );
    close(&[joints.kinetic_energy(&state)], &[0.981_498_442_442_059_1], 1e-12);
    close(&[joints.potential_energy(&state)], &[36.265_200_710_945_28], 1e-12);
}
