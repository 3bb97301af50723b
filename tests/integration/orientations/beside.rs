//! Other things beside orientations in a system: other methods, derivatives, lanes of numbers, contacts,
//! forces.

use lagrangian::prelude::*;

use crate::support::close::{all_close_on_largest, close, close_on};

/// A body on a damped spherical joint under a torque in body axes.
struct Joint {
    damping: f64,
}

#[lagrangian(coordinates = [turret: Rotation], jacobians, analysis)]
impl Joint {
    #[body(mass = 1.0, inertia = [1.0, 2.0, 3.0])]
    fn body(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::identity(), q.turret)
    }

    #[dissipation]
    fn drag(&self, v: &Velocities) -> f64 {
        0.5 * self.damping * v.turret.norm_squared()
    }

    #[force(on = turret)]
    fn torque(&self, t: f64) -> Vector3<f64> {
        Vector3::new(t.cos(), 0.0, 0.5)
    }
}

/// Euler's equations I ω′ = (I ω) × ω + τ − c ω by the classical method with 1e5 steps: 1e-15 here.
fn euler(damping: f64, end: f64) -> [f64; 3] {
    let slope = |t: f64, [x, y, z]: [f64; 3]| {
        [t.cos() - damping * x - y * z, (2.0 * z * x - damping * y) / 2.0, (0.5 - damping * z - x * y) / 3.0]
    };
    let along = |w: [f64; 3], k: [f64; 3], h: f64| core::array::from_fn(|i| w[i] + h * k[i]);
    let (count, mut w) = (100_000, [0.0; 3]);
    let h = end / f64::from(count);
    for i in 0..count {
        let t = h * f64::from(i);
        let a = slope(t, w);
        let b = slope(t + 0.5 * h, along(w, a, 0.5 * h));
        let c = slope(t + 0.5 * h, along(w, b, 0.5 * h));
        let d = slope(t + h, along(w, c, h));
        w = core::array::from_fn(|i| w[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
    }
    w
}

#[test]
fn torques_and_damping_act_on_the_angular_velocity() {
    let joint = Joint { damping: 0.1 };
    let start =
        State::at_rest(JointCoordinates { turret: UnitQuaternion::from_euler_angles(2.0, 1.0, -3.0) });
    let mut motion = joint.simulate(start).with_tolerance(1e-13);
    let state = *motion.advance_to(10.0).unwrap();
    all_close_on_largest(joint.velocities(&state).turret, euler(0.1, 10.0), 1e-11);
    let power = joint.power(&state);
    let omega = joint.velocities(&state).turret;
    close(power, omega.dot(&Vector3::new(10.0_f64.cos(), 0.0, 0.5)) - 0.1 * omega.norm_squared(), 1e-12);
}

#[test]
fn every_method_goes_through_half_turns() {
    let joint = Joint { damping: 0.1 };
    let start =
        State::at_rest(JointCoordinates { turret: UnitQuaternion::from_euler_angles(2.0, 1.0, -3.0) });
    let end =
        |state: &State<f64, 3>| (JointCoordinates::from(state.q).turret, joint.velocities(state).turret);
    let (turn, omega) = end(joint.simulate(start).with_tolerance(1e-13).advance_to(10.0).unwrap());
    let close = |state: &State<f64, 3>, tolerance: f64| {
        let (other, rates) = end(state);
        close_on(1.0, turn.angle_to(&other), 0.0, tolerance);
        all_close_on_largest(rates, omega, tolerance);
    };
    close(joint.simulate_with::<Dop853>(start).with_tolerance(1e-12).advance_to(10.0).unwrap(), 1e-10);
    fn fixed<M: lagrangian::integrator::FixedStep<Joint, 3, 0>>(
        joint: &Joint,
        start: State<f64, 3>,
    ) -> State<f64, 3> {
        let mut stepper = joint.stepper::<M>(start);
        for _ in 0..2000 {
            stepper.step(0.005, &[]).unwrap();
        }
        *stepper.state()
    }
    close(&fixed::<Rk4>(&joint, start), 1e-7);
    close(&fixed::<Jet<12>>(&joint, start), 1e-11);
    close(&fixed::<Gauss6>(&joint, start), 1e-10);
}

#[test]
fn derivatives_of_a_motion_go_through_half_turns() {
    let joint = Joint { damping: 0.1 };
    let q = JointCoordinates { turret: UnitQuaternion::from_euler_angles(2.0, 1.0, -3.0) };
    let start = State::at_rest(q);
    let variational = joint.variational();
    let mut motion = variational.motion(start).unwrap().with_tolerance(1e-12);
    motion.advance_to(7.0).unwrap();
    let matrix = motion.transition();
    let moved = |d: f64| {
        let mut start = start;
        start.q[1] += d;
        *joint.simulate(start).with_tolerance(1e-13).advance_to(7.0).unwrap()
    };
    let (plus, minus) = (moved(1e-5), moved(-1e-5));
    for i in 0..3 {
        close_on(1.0, matrix.entry(i, 1), (plus.q[i] - minus.q[i]) / 2e-5, 1e-7);
        close_on(1.0, matrix.entry(3 + i, 1), (plus.v[i] - minus.v[i]) / 2e-5, 1e-7);
    }
}

/// A pendulum of two bodies in space.
struct Pendulum;

#[lagrangian(coordinates = [links: [Rotation; 2]], jacobians, analysis)]
impl Pendulum {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.02])]
    fn links(&self, q: &Coordinates) -> [Isometry3<f64>; 2] {
        let half = Vector3::new(0.0, 0.0, -0.5);
        let first = q.links[0] * half;
        [(first, q.links[0]), (2.0 * first + q.links[1] * half, q.links[1])]
            .map(|(place, turn)| Isometry3::from_parts(Translation3::from(place), turn))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.links(q).iter().map(|link| 9.81 * link.translation.z).sum()
    }
}

#[test]
fn a_pendulum_of_orientations_hangs_and_swings() {
    let guess = [0.3, -0.2].map(|angle| UnitQuaternion::from_euler_angles(angle, 0.5 * angle, 1.0));
    let rest = Pendulum.equilibrium(State::at_rest(PendulumCoordinates { links: guess }), &[]).unwrap();
    let links = PendulumCoordinates::from(rest.state.q).links;
    for link in links {
        close_on(1.0, (link * Vector3::z()).z, 1.0, 1e-14);
    }
    // A planar double pendulum of links of 1 m: det(K − ω² M) = 0, each frequency in two planes, and two
    // free spins.
    let modes = Pendulum.modes(&rest.state, &[]).unwrap();
    let mut found: Vec<f64> = modes.iter().map(|mode| mode.eigenvalue.im).filter(|im| *im > 1e-6).collect();
    found.sort_by(f64::total_cmp);
    let (a, b, c) = (1.35, 0.5, 0.35);
    let (k, l) = (1.5 * 9.81, 0.5 * 9.81);
    let (p, q) = (a * l + c * k, ((a * l - c * k).powi(2) + 4.0 * b * b * k * l).sqrt());
    let det = 2.0 * (a * c - b * b);
    let expected = [(p - q) / det, (p + q) / det].map(f64::sqrt);
    assert_eq!(found.len(), 4, "{found:?}");
    for (found, expected) in found.iter().zip([expected[0], expected[0], expected[1], expected[1]]) {
        close(*found, expected, 1e-10);
    }
    Pendulum.verify().unwrap();
}

/// A die: a cube that falls on a floor with its corners.
struct Die;

#[lagrangian(coordinates = [die: Pose])]
impl Die {
    #[body(mass = 1.0, inertia = [0.06; 3])]
    fn die(&self, q: &Coordinates) -> Isometry3<f64> {
        q.die
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.die.translation.z
    }

    #[unilateral(restitution = 0.5)]
    fn corners(&self, q: &Coordinates) -> [f64; 8] {
        let signs: [f64; 2] = [1.0, -1.0];
        core::array::from_fn(|i| {
            let corner = 0.3 * Vector3::new(signs[i % 2], signs[(i / 2) % 2], signs[i / 4]);
            (q.die.translation.vector + q.die.rotation * corner).z
        })
    }
}

#[test]
fn a_component_of_the_quaternion_is_zero_where_it_vanishes_alone() {
    struct Free;
    #[lagrangian(coordinates = [body: Rotation])]
    impl Free {
        #[body(mass = 1.0, inertia = [1.0, 2.0, 3.0])]
        fn body(&self, q: &Coordinates) -> Isometry3<f64> {
            Isometry3::from_parts(Translation3::identity(), q.body)
        }
    }
    let spin = FreeVelocities { body: Vector3::new(0.0, 0.0, 1.0) };
    let start = Free.state(FreeCoordinates { body: UnitQuaternion::identity() }, spin);
    let mut motion = Free.simulate(start).with_tolerance(1e-15);
    // k = sin(t/2) of the one quaternion or of the other: zero after every full turn, and nowhere else.
    for turn in 1..=4 {
        let event = motion.advance_to_event(|s: &State<f64, 3>| FreeCoordinates::from(s.q).body.k, 40.0);
        let event = event.unwrap().unwrap();
        close(event.state.t, f64::from(turn) * core::f64::consts::TAU, 1e-12);
    }
}

#[test]
fn starts_with_components_that_are_zero_take_ordinary_steps() {
    let half = |axis: Vector3<f64>| UnitQuaternion::from_scaled_axis(axis * core::f64::consts::PI);
    let rates = [Vector3::new(0.1, 0.0, 1.0), Vector3::new(0.0, 0.3, 0.0)];
    for links in [[half(Vector3::x()), half(Vector3::y())], [UnitQuaternion::identity(); 2]] {
        for tolerance in [1e-7, 1e-10, 1e-13] {
            let start = Pendulum.state(PendulumCoordinates { links }, PendulumVelocities { links: rates });
            let mut motion = Pendulum.simulate(start).with_tolerance(tolerance).with_max_steps(500);
            let energy = motion.energy();
            motion.advance_to(3.0).unwrap();
            close_on(20.0, motion.energy(), energy, 20.0 * tolerance);
        }
    }
}

#[test]
fn the_report_names_orientations() {
    let facts = Die::STRUCTURE.facts;
    assert!(facts.contains(&"orientations without a singular attitude: die"), "{facts:?}");
    assert_eq!(Die::COORDINATES[3], "die[3]");
}

#[test]
fn a_die_falls_on_its_corners() {
    let start = Die.state(
        DieCoordinates { die: Isometry3::translation(0.0, 0.0, 1.0) },
        DieVelocities {
            die: PoseVelocity { linear: Vector3::new(1.0, 0.0, 0.0), angular: Vector3::new(5.0, 3.0, 1.0) },
        },
    );
    let mut motion = Die.simulate(start);
    let mut energy = motion.energy();
    for _ in 0..4 {
        let time = motion.t();
        assert!(motion.advance_to_switch(3.0).unwrap().is_some());
        assert!(motion.t() > time && motion.energy() < energy, "{} {energy}", motion.energy());
        energy = motion.energy();
        let gaps = Die.corners(&DieCoordinates::from(motion.state().q));
        assert!(gaps.iter().all(|&gap| gap > -1e-14), "{gaps:?}");
    }
}

/// In the end it lies on four corners, and their reactions are not unique: two on a diagonal can bear all of
/// the weight.
#[test]
fn a_die_comes_to_lie_flat_and_slides_on() {
    let start = Die.state(
        DieCoordinates { die: Isometry3::translation(0.0, 0.0, 1.0) },
        DieVelocities {
            die: PoseVelocity { linear: Vector3::new(1.0, 0.0, 0.0), angular: Vector3::new(5.0, 3.0, 1.0) },
        },
    );
    let mut motion = Die.simulate(start);
    let end = motion.advance_to(3.0).unwrap();
    let gaps = Die.corners(&DieCoordinates::from(end.q));
    assert!(gaps.iter().filter(|gap| gap.abs() < 1e-14).count() == 4, "{gaps:?}");
    // Nothing pushes or turns it horizontally.
    close(end.q[0], 3.0, 1e-13);
    close(motion.energy(), 9.81 * 0.3 + 0.5 + 0.5 * 0.06, 1e-12);
}

/// A body that turns about one axis through the kinks of its potential, by its orientation and by an angle.
struct Ridge;

#[lagrangian(coordinates = [body: Rotation])]
impl Ridge {
    #[body(mass = 1.0, inertia = [1.0, 2.0, 3.0])]
    fn body(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::identity(), q.body)
    }

    #[potential]
    fn valley(&self, q: &Coordinates) -> f64 {
        4.0 * (q.body * Vector3::x()).y.abs()
    }
}

struct RidgeByAngle;

#[lagrangian(coordinates = [angle])]
impl RidgeByAngle {
    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        1.5 * v.angle.powi(2)
    }

    #[potential]
    fn valley(&self, q: &Coordinates) -> f64 {
        4.0 * q.angle.sin().abs()
    }
}

#[test]
fn kinks_of_an_orientation_are_passed() {
    let spin = RidgeVelocities { body: Vector3::new(0.0, 0.0, 2.0) };
    let start = Ridge.state(RidgeCoordinates { body: UnitQuaternion::identity() }, spin);
    let mut motion = Ridge.simulate(start).with_tolerance(1e-13);
    let mut by_angle = RidgeByAngle.simulate(State::new([0.0], [2.0])).with_tolerance(1e-13);
    for second in 1..=10 {
        let (state, angle) = (
            *motion.advance_to(f64::from(second)).unwrap(),
            *by_angle.advance_to(f64::from(second)).unwrap(),
        );
        let about_z = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle.q[0]);
        close_on(1.0, RidgeCoordinates::from(state.q).body.angle_to(&about_z), 0.0, 1e-10);
        close_on(2.0, Ridge.velocities(&state).body.z, angle.v[0], 1e-10);
    }
}
