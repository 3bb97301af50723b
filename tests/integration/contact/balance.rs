//! Reactions that are told are those that act: they balance the motion, where feet share a load and some are
//! relieved of it, or a brake shares it.

use lagrangian::prelude::*;

use crate::support::close::{close, close_on};

/// A table on four rough feet, pulled at a grip beside its middle.
struct Table {
    roughness: f64,
    /// Half the distances of the feet, and the height of the top.
    half: [f64; 3],
}

#[lagrangian(coordinates = [top: Pose], inputs = [pull: [3]])]
impl Table {
    #[body(mass = 2.0, inertia = [0.1, 0.15, 0.2])]
    fn top(&self, q: &Coordinates) -> Isometry3<f64> {
        q.top
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * q.top.translation.vector.z
    }

    fn grip(&self, q: &Coordinates) -> Vector3<f64> {
        q.top.translation.vector + q.top.rotation * Vector3::new(0.1, 0.05, 0.0)
    }

    #[force(at = grip)]
    fn pull(&self, u: &Inputs) -> Vector3<f64> {
        Vector3::new(u.pull[0], u.pull[1], u.pull[2])
    }

    fn feet(&self, q: &Coordinates) -> [Vector3<f64>; 4] {
        let [a, b, height] = self.half;
        [(a, b), (a, -b), (-a, -b), (-a, b)]
            .map(|(x, y)| q.top.translation.vector + q.top.rotation * Vector3::new(x, y, -height))
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> [f64; 4] {
        self.feet(q).map(|foot| foot.z)
    }

    #[friction(coefficient = self.roughness, normal = floor[0])]
    fn first(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.feet_velocity(q, v)[0].xy()
    }

    #[friction(coefficient = self.roughness, normal = floor[1])]
    fn second(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.feet_velocity(q, v)[1].xy()
    }

    #[friction(coefficient = self.roughness, normal = floor[2])]
    fn third(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.feet_velocity(q, v)[2].xy()
    }

    #[friction(coefficient = self.roughness, normal = floor[3])]
    fn fourth(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.feet_velocity(q, v)[3].xy()
    }
}

/// The roughness, the half sizes, the yaw, the speed of the slide, that of the turn, and the pull of a table.
type Slide = (f64, [f64; 3], f64, [f64; 2], f64, [f64; 3]);

/// What the reactions lack of the mass times the acceleration at some times of a slide, at most.
fn lacks((roughness, half, yaw, [x, y], turn, pull): Slide) -> f64 {
    let table = Table { roughness, half };
    let place = Isometry3::from_parts(
        Translation3::new(0.0, 0.0, half[2]),
        UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw),
    );
    let twist = PoseVelocity { linear: Vector3::new(x, y, 0.0), angular: Vector3::new(0.0, 0.0, turn) };
    let start = table.state(TableCoordinates { top: place }, TableVelocities { top: twist });
    let times = [0.02, 0.04, 0.06, 0.08];
    let lacks = times.map(|t| {
        let mut motion = table.simulate(start).with_inputs(pull).with_tolerance(1e-12);
        let speed = |state: &_| table.velocities(state).top.linear;
        let before = speed(motion.advance_to(t).unwrap());
        let told = motion.reactions();
        let frictions = [told.first, told.second, told.third, told.fourth];
        let along = |axis: usize| frictions.iter().map(|friction| friction[axis]).sum::<f64>();
        let bears = told.floor.iter().sum::<f64>() - 2.0 * 9.81;
        let force = Vector3::new(along(0) + pull[0], along(1) + pull[1], bears + pull[2]);
        let passed = 1e-6;
        let after = speed(motion.advance_to(t + passed).unwrap());
        (2.0 * (after - before) / passed - force).norm()
    });
    lacks.into_iter().fold(0.0, f64::max)
}

/// The slide goes on without a foot as soon as its load is gone, whatever other loads would be possible.
#[test]
fn a_foot_of_a_turning_table_never_pulls() {
    let slides = [
        (0.9584, [0.4394, 0.2067, 0.3771], 1.5577, [0.0626, 0.7738], -1.8506, [0.178, -1.5148, 0.3664]),
        (1.1462, [0.4265, 0.3556, 0.3344], -0.8306, [-0.1389, 0.7887], 1.4782, [-1.5641, 3.975, -0.3531]),
    ];
    for slide in slides {
        let lacks = lacks(slide);
        assert!(lacks < 1e-3, "{slide:?}: {lacks}");
    }
}

/// The gap of a relieved foot stays zero, and tells nothing.
#[test]
fn a_foot_that_others_relieve_bears_again() {
    let slides = [
        (0.978, [0.4376, 0.3139, 0.3154], 0.3837, [0.8563, 0.0637], -0.5887, [1.0613, 0.5948, -2.4601]),
        (0.9788, [0.2029, 0.2317, 0.1663], -1.0355, [0.853, -0.3463], 1.7751, [-0.3401, -3.7446, -0.4839]),
    ];
    for slide in slides {
        let lacks = lacks(slide);
        assert!(lacks < 1e-3, "{slide:?}: {lacks}");
    }
}

/// A box on two rough feet, with a dry brake on its angle.
struct Braked;

#[lagrangian(coordinates = [x, y, phi])]
impl Braked {
    #[body(mass = 1.015_665_597_474_73, inertia = 0.216_000_765_453_171_2)]
    fn hull(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.phi)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        1.015_665_597_474_73 * 9.81 * q.y
    }

    fn arms(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        let turn = Rotation2::new(q.phi);
        [-1.0, 1.0].map(|side| turn * Vector2::new(side * 0.303_270_054_727_004, -0.240_091_458_591_128_82))
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> [f64; 2] {
        self.arms(q).map(|arm| q.y + arm.y)
    }

    #[friction(coefficient = 0.15, normal = floor)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        self.arms(q).map(|arm| v.x - arm.y * v.phi)
    }

    #[friction(limit = 0.2)]
    fn brake(&self, v: &Velocities) -> f64 {
        v.phi
    }
}

/// The brake and both feet hold the angle. It has left a foot beside the floor by more than rounding.
#[test]
fn a_braked_box_lands_on_both_feet() {
    let start = State::new(
        [0.0, 0.8, 0.214_480_763_481_646_96],
        [2.235_489_968_590_294, 0.0, -0.106_452_188_395_809_17],
    );
    let mut motion = Braked.simulate(start);
    let State { q, v, .. } = *motion.advance_to(0.94).unwrap();
    close_on(1.0, q[1] - 0.240_091_458_591_128_82, 0.0, 1e-15);
    close_on(1.0, q[2], 0.0, 1e-15);
    assert_eq!(v[2], 0.0);
    let told = motion.reactions();
    assert!(!told.are_unique());
    let weight = 1.015_665_597_474_73 * 9.81;
    close(told.floor[0] + told.floor[1], weight, 1e-12);
    close(told.slip[0] + told.slip[1], -0.15 * weight, 1e-12);
    let by_feet = 0.303_270_054_727_004 * (told.floor[1] - told.floor[0]);
    let by_friction = 0.240_091_458_591_128_82 * (told.slip[0] + told.slip[1]);
    close_on(1.0, by_feet + by_friction + told.brake, 0.0, 1e-12);
}
