//! Bodies on three rough points of a level floor. Their normal forces are unique. They come to rest, or begin
//! to roll, with several points at once.

use lagrangian::prelude::*;

use crate::support::sample::Samples;

/// A body on three feet.
struct Tripod {
    friction: f64,
    feet: [[f64; 2]; 3],
}

const HEIGHT: f64 = 0.2;

#[lagrangian(coordinates = [hull: Pose])]
impl Tripod {
    #[body(mass = 4.65, inertia = [0.39, 0.16, 0.52])]
    fn hull(&self, q: &Coordinates) -> Isometry3<f64> {
        q.hull
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * 4.65 * q.hull.translation.vector.z
    }

    fn foot(&self, q: &Coordinates, index: usize) -> Vector3<f64> {
        let feet: [[f64; 2]; 3] = self.feet;
        (q.hull * Point3::new(feet[index][0], feet[index][1], -HEIGHT)).coords
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> [f64; 3] {
        [0, 1, 2].map(|index| self.foot(q, index).z)
    }

    fn slip(&self, q: &Coordinates, v: &Velocities, index: usize) -> Vector2<f64> {
        let slip = self.hull_velocity(q, v).at(self.foot(q, index));
        Vector2::new(slip.x, slip.y)
    }

    #[friction(coefficient = self.friction, normal = floor[0])]
    fn first(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 0)
    }

    #[friction(coefficient = self.friction, normal = floor[1])]
    fn second(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 1)
    }

    #[friction(coefficient = self.friction, normal = floor[2])]
    fn third(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 2)
    }
}

/// All feet slow down together, the last of them within the tolerance: three frictions that end at once, each
/// in two directions.
#[test]
fn three_feet_come_to_rest_at_one_place_at_any_tolerance() {
    let mut samples = Samples::new(11);
    for friction in [0.4165, 0.8] {
        for _ in 0..10 {
            let feet = if friction < 0.5 {
                [[0.3048, -0.0801], [-0.5354, 0.5767], [-0.0585, -0.3727]]
            } else {
                [[0.7, 0.1], [-0.2, 0.4], [-0.3, -0.6]]
            };
            let tripod = Tripod { friction, feet };
            let linear = Vector3::new(samples.number(-2.0, 2.0), samples.number(-2.0, 2.0), 0.0);
            let angular = Vector3::new(0.0, 0.0, samples.number(-6.0, 6.0));
            let hull = Isometry3::translation(0.0, 0.0, HEIGHT);
            let start = tripod.state(
                TripodCoordinates { hull },
                TripodVelocities { hull: PoseVelocity { linear, angular } },
            );
            let mut ends = [[0.0; 6]; 3];
            for (end, tolerance) in ends.iter_mut().zip([1e-6, 1e-9, 1e-12]) {
                let mut motion = tripod.simulate(start).with_tolerance(tolerance).with_max_steps(3000);
                let state = motion.advance_to(10.0).unwrap_or_else(|error| {
                    panic!("{friction} {linear:?} {angular:?} at {tolerance}: {error}");
                });
                assert_eq!(state.v, [0.0; 6]);
                *end = state.q;
            }
            for (end, error) in ends.iter().zip([1e-5, 1e-8]) {
                let off = end.iter().zip(&ends[2]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(off < error, "{friction} {linear:?} {angular:?}: {off}");
            }
        }
    }
}

/// A rover on two driven wheels and a caster that slides.
struct Rover {
    torque: [f64; 2],
    /// The rate at which both torques grow \[N m/s].
    rise: f64,
    friction: f64,
    /// The friction of the caster.
    drag: f64,
}

const MASS: f64 = 5.117;
const WHEEL: f64 = 0.485;
const SPIN: f64 = 0.02;
const AXLE: f64 = 0.1;
const CASTER: f64 = 0.2622;
const RADIUS: f64 = 0.0874;
const HUB: f64 = 0.1353;

#[lagrangian(coordinates = [hull: Pose, turn: [2]])]
impl Rover {
    #[body(mass = MASS, inertia = [0.2, 0.3, 0.4])]
    fn hull(&self, q: &Coordinates) -> Isometry3<f64> {
        q.hull
    }

    fn hub(&self, q: &Coordinates, wheel: usize) -> Vector3<f64> {
        let side = if wheel == 0 { 0.1743 } else { -0.1743 };
        (q.hull * Point3::new(AXLE, side, RADIUS - HUB)).coords
    }

    #[body(mass = WHEEL, inertia = [0.5 * SPIN, SPIN, 0.5 * SPIN])]
    fn wheels(&self, q: &Coordinates) -> [(Vector3<f64>, UnitQuaternion<f64>); 2] {
        [0, 1].map(|wheel| {
            let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), q.turn[wheel]);
            (self.hub(q, wheel), q.hull.rotation * turn)
        })
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        let wheels = self.hub(q, 0).z + self.hub(q, 1).z;
        9.81 * (MASS * q.hull.translation.vector.z + WHEEL * wheels)
    }

    #[force(on = turn)]
    fn drive(&self, t: f64) -> [f64; 2] {
        let torque: [f64; 2] = self.torque;
        torque.map(|torque| torque + self.rise * t)
    }

    #[unilateral]
    fn tyre(&self, q: &Coordinates) -> [f64; 2] {
        [self.hub(q, 0).z - RADIUS, self.hub(q, 1).z - RADIUS]
    }

    fn slip(&self, q: &Coordinates, v: &Velocities, wheel: usize) -> Vector2<f64> {
        let below = self.hub(q, wheel) - Vector3::new(0.0, 0.0, RADIUS);
        let slip = self.wheels_velocity(q, v)[wheel].at(below);
        Vector2::new(slip.x, slip.y)
    }

    #[friction(coefficient = self.friction, normal = tyre[0])]
    fn left(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 0)
    }

    #[friction(coefficient = self.friction, normal = tyre[1])]
    fn right(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 1)
    }

    fn caster(&self, q: &Coordinates) -> Vector3<f64> {
        (q.hull * Point3::new(-CASTER, 0.0, -HUB)).coords
    }

    #[unilateral]
    fn ball(&self, q: &Coordinates) -> f64 {
        self.caster(q).z
    }

    #[friction(coefficient = self.drag, normal = ball)]
    fn slide(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let slip = self.hull_velocity(q, v).at(self.caster(q));
        Vector2::new(slip.x, slip.y)
    }
}

/// When one wheel rolls, the other one cannot slip along the axle any more, and begins to roll soon after.
#[test]
fn both_wheels_of_an_axle_begin_to_roll() {
    let rover = Rover { torque: [-0.0114, -0.0235], rise: 0.0, friction: 0.481, drag: 0.262 };
    for spin in [3.0, 3.02, 3.04, 3.06, 3.1, 3.16] {
        let rotation = UnitQuaternion::from_euler_angles(0.0, 0.0, 2.13);
        let hull = Isometry3::from_parts(Translation3::new(0.0, 0.0, HUB), rotation);
        let velocity =
            PoseVelocity { linear: Vector3::new(-1.18, -0.22, 0.0), angular: Vector3::new(0.0, 0.0, spin) };
        let start = rover.state(
            RoverCoordinates { hull, turn: [0.3, 1.0] },
            RoverVelocities { hull: velocity, turn: [-14.76, 10.61] },
        );
        let ends = [1e-6, 1e-8, 1e-10, 1e-12].map(|tolerance| {
            let mut motion = rover.simulate(start).with_tolerance(tolerance).with_max_steps(2000);
            let end = *motion.advance_to(2.0).unwrap_or_else(|error| panic!("{spin} {tolerance}: {error}"));
            let (q, v) = (rover.coordinates(&end), rover.velocities(&end));
            assert!(rover.left(&q, &v).norm() + rover.right(&q, &v).norm() < 1e-12, "{spin} {tolerance}");
            q.hull.translation.vector
        });
        for (end, error) in ends.iter().zip([1e-5, 1e-7, 1e-9]) {
            assert!((end - ends[3]).norm() < error, "{spin}: {ends:?}");
        }
    }
}

/// Both wheels drive straight on until their torques are more than the road can hold. They share what is
/// across, which is nothing, or nearly so where the rover turns a little: shares cannot help them, since all
/// of the limit is needed along the road.
///
/// With the traction f of each wheel and the normal force n, m a = 2 f, f r = τ − J a/r and the balance of
/// moments about the road below the axle, n = n₀ − n₁ a. All grow like the torque, so that f = μ n at one time.
#[test]
fn wheels_that_drive_straight_on_begin_to_slip_where_the_road_gives_no_more() {
    for (rise, friction, spin, tolerance, error) in [
        (1.2, 0.27, 0.0, 1e-9, 1e-12),
        (1.2, 0.27, 0.0, 1e-12, 1e-12),
        (1.4, 0.5, 1e-12, 1e-12, 1e-11),
        (2.2, 0.8, 1e-9, 1e-9, 1e-8),
        (2.2, 0.8, 1e-6, 1e-9, 1e-5),
    ] {
        let rover = Rover { torque: [0.0; 2], rise, friction, drag: 0.0 };
        let (mass, base) = (MASS + 2.0 * WHEEL, AXLE + CASTER);
        let rate = 2.0 * rise / (RADIUS * (mass + 2.0 * SPIN / (RADIUS * RADIUS)));
        let moment = MASS * HUB + 2.0 * WHEEL * RADIUS + 2.0 * SPIN / RADIUS;
        let [rest, shift] = [mass * 9.81 - MASS * 9.81 * AXLE / base, moment * rate / base].map(|n| 0.5 * n);
        let expected = friction * rest / (0.5 * mass * rate + friction * shift);
        let velocity = PoseVelocity { linear: Vector3::zeros(), angular: Vector3::new(0.0, 0.0, spin) };
        let start = rover.state(
            RoverCoordinates { hull: Isometry3::translation(0.0, 0.0, HUB), turn: [0.0; 2] },
            RoverVelocities { hull: velocity, turn: [0.0; 2] },
        );
        let mut motion = rover.simulate(start).with_tolerance(tolerance);
        // Wheels that turn begin to roll at once.
        motion.advance_to(0.9 * expected).unwrap();
        let slips = motion.advance_to_switch(2.0 * expected).unwrap().unwrap().state;
        // An error of the motion turns the rover as well.
        let error = error + 100.0 * tolerance;
        assert!((slips.t - expected).abs() < error, "{rise} {friction} {spin}: {} {expected}", slips.t);
        assert!(slips.q[3..6].iter().all(|angle| angle.abs() < 1e-5));
    }
}
