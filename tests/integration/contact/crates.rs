//! A crate flat on four feet, whose frictions in two directions share what holds it.

use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

struct Crate {
    inertia: [f64; 3],
    half: [f64; 3],
    friction: f64,
    /// The floor is at amplitude sin(rate t) along x.
    amplitude: f64,
    rate: f64,
}

#[lagrangian(coordinates = [hull: Pose])]
impl Crate {
    #[body(mass = 1.0, inertia = self.inertia)]
    fn hull(&self, q: &Coordinates) -> Isometry3<f64> {
        q.hull
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.hull.translation.z
    }

    fn feet(&self, q: &Coordinates) -> [Vector3<f64>; 4] {
        let [x, y, z]: [f64; 3] = self.half;
        [(-x, -y), (x, -y), (x, y), (-x, y)]
            .map(|(x, y)| q.hull.translation.vector + q.hull.rotation * Vector3::new(x, y, -z))
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> [f64; 4] {
        self.feet(q).map(|foot| foot.z)
    }

    fn slip(&self, q: &Coordinates, v: &Velocities, t: f64, foot: usize) -> Vector2<f64> {
        let velocity = self.hull_velocity(q, v).at(self.feet(q)[foot]);
        Vector2::new(velocity.x - self.amplitude * self.rate * (self.rate * t).cos(), velocity.y)
    }

    #[friction(coefficient = self.friction, normal = floor[0])]
    fn first(&self, q: &Coordinates, v: &Velocities, t: f64) -> Vector2<f64> {
        self.slip(q, v, t, 0)
    }

    #[friction(coefficient = self.friction, normal = floor[1])]
    fn second(&self, q: &Coordinates, v: &Velocities, t: f64) -> Vector2<f64> {
        self.slip(q, v, t, 1)
    }

    #[friction(coefficient = self.friction, normal = floor[2])]
    fn third(&self, q: &Coordinates, v: &Velocities, t: f64) -> Vector2<f64> {
        self.slip(q, v, t, 2)
    }

    #[friction(coefficient = self.friction, normal = floor[3])]
    fn fourth(&self, q: &Coordinates, v: &Velocities, t: f64) -> Vector2<f64> {
        self.slip(q, v, t, 3)
    }
}

impl Crate {
    /// At rest in height, turned by a yaw, with velocities along the floor.
    fn start(&self, yaw: f64, [x, y]: [f64; 2], spin: f64) -> State<f64, 6> {
        let turned = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw);
        let hull = Isometry3::from_parts(Translation3::new(0.0, 0.0, self.half[2]), turned);
        let velocity =
            PoseVelocity { linear: Vector3::new(x, y, 0.0), angular: Vector3::new(0.0, 0.0, spin) };
        self.state(CrateCoordinates { hull }, CrateVelocities { hull: velocity })
    }
}

#[test]
fn a_crate_on_a_shaken_floor_lets_go_when_all_its_feet_do() {
    let mut samples = Samples::new(83);
    for round in 0..4 {
        let rate = samples.number(8.0, 12.0);
        let scene = Crate {
            inertia: [0.012, 0.02, 0.025],
            half: [samples.number(0.1, 0.2), samples.number(0.1, 0.2), samples.number(0.03, 0.08)],
            friction: samples.number(0.2, 0.4),
            amplitude: 0.6 * 9.81 / (rate * rate),
            rate,
        };
        // It begins with the speed of the floor and holds until the floor accelerates by more than friction.
        let speed = scene.amplitude * rate;
        let start = scene.start(samples.number(-0.7, 0.7), [speed, 0.0], 0.0);
        let lets_go = (scene.friction * 9.81 / (speed * rate)).asin() / rate;
        let end = lets_go + 0.04;
        let tolerance = [1e-8, 1e-9, 1e-10, 1e-9][round];
        let mut motion = scene.simulate(start).with_tolerance(tolerance).with_max_steps(3000);
        let state = *motion.advance_to(end).unwrap();
        let velocity = scene.velocities(&state).hull;
        let expected = speed * (rate * lets_go).cos() - scene.friction * 9.81 * 0.04;
        close_on(1.0, velocity.linear.x, expected, 1e-7);
        close_on(1.0, velocity.linear.y.hypot(velocity.angular.norm()), 0.0, 1e-7);
    }
}

#[test]
fn a_crate_pivots_about_a_foot_that_has_come_to_rest() {
    let scene = Crate {
        inertia: [0.021_460_687_850_018_242; 3],
        half: [0.138_007_786_071_874_2, 0.110_796_344_773_786_22, 0.088_673_890_787_848_06],
        friction: 0.221_969_658_009_556_65,
        amplitude: 0.0,
        rate: 1.0,
    };
    for part in [0.0, 0.03, 0.0995] {
        let spin = 1.663_651_025_162_980_8 * (1.0 + part);
        let start =
            scene.start(-0.929_379_377_512_108_2, [0.044_953_903_406_673_49, 0.296_470_357_324_484_46], spin);
        let mut motion = scene.simulate(start).with_tolerance(1e-10).with_max_steps(5000);
        if part == 0.0995 {
            // By friction that is rounded off within 1e-5 m/s.
            let state = *motion.advance_to(0.12).unwrap();
            let velocity = scene.velocities(&state).hull;
            close_on(1.0, velocity.linear.x, 0.01288, 3e-5);
            close_on(1.0, velocity.linear.y, 0.12080, 3e-5);
            close_on(1.0, velocity.angular.z, 0.68638, 3e-5);
        }
        let state = *motion.advance_to(1.0).unwrap();
        assert!(state.v.iter().all(|v| v.abs() < 1e-12), "{state:?}");
    }
}

#[test]
fn a_foot_comes_to_rest_at_tolerances_near_rounding() {
    // Before it rests, its slip has a direction with few digits, and so have the reactions of the others.
    let mut samples = Samples::new(11);
    for _ in 0..12 {
        let scene = Crate {
            inertia: [samples.number(0.01, 0.03); 3],
            half: [samples.number(0.1, 0.2), samples.number(0.1, 0.2), samples.number(0.03, 0.1)],
            friction: samples.number(0.2, 0.4),
            amplitude: 0.0,
            rate: 1.0,
        };
        let speeds = [samples.number(-0.5, 0.5), samples.number(-0.5, 0.5)];
        let start = scene.start(samples.number(-1.0, 1.0), speeds, samples.number(-3.0, 3.0));
        let run = |tolerance: f64| {
            let mut motion = scene.simulate(start).with_tolerance(tolerance).with_max_steps(5000);
            let state = *motion.advance_to(1.0).unwrap();
            let pose = scene.coordinates(&state).hull;
            [pose.translation.x, pose.translation.y, pose.rotation.euler_angles().2]
        };
        let (found, expected) = (run(2e-13), run(1e-9));
        for (found, expected) in found.into_iter().zip(expected) {
            close_on(1.0, found, expected, 1e-7);
        }
    }
}
