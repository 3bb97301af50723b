//! Bodies on several feet, rough in two directions, that a load pulls loose.

use lagrangian::Contact;
use lagrangian::prelude::*;

use crate::support::close::{close, close_on};
use crate::support::sample::Samples;

/// A mass that sticks until it is pushed by more than a newton.
struct Pushed;

#[lagrangian(coordinates = [x, y], inputs = [fx, fy])]
impl Pushed {
    #[point(mass = 1.0)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[friction(limit = 1.0)]
    fn slip(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x, v.y)
    }

    #[force(at = puck)]
    fn load(&self, u: &Inputs) -> Vector2<f64> {
        Vector2::new(u.fx, u.fy)
    }
}

/// A slip that begins has no speed that friction could turn in a step of any length. Its direction is that of
/// the load, and so its speed is known.
#[test]
fn fixed_steps_begin_to_slip_in_two_directions() {
    for h in [0.1, 0.01, 1e-3] {
        for force in [[1.5, 0.0], [1.0, 0.9], [3.0, -4.0]] {
            let mut stepper = Pushed.stepper::<Jet<6>>(State::at_rest([0.0; 2]));
            for step in 1..=10 {
                let state = *stepper.step(h, &force).unwrap();
                let size = force[0].hypot(force[1]);
                let speed = (size - 1.0) * h * f64::from(step);
                close(state.v[0], speed * force[0] / size, 1e-14);
                close(state.v[1], speed * force[1] / size, 1e-14);
            }
        }
    }
}

/// A bar on two feet with limits of one newton, pulled at its centre by a load that grows by 1 N/s.
struct Bar {
    direction: f64,
}

#[lagrangian(coordinates = [x, y, angle])]
impl Bar {
    #[body(mass = 1.0, inertia = 0.1)]
    fn bar(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.angle)
    }

    fn slip(&self, q: &Coordinates, v: &Velocities, along: f64) -> Vector2<f64> {
        self.bar_velocity(q, v).at((self.bar(q) * Point2::new(along, 0.0)).coords)
    }

    #[friction(limit = 1.0)]
    fn left(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, -0.5)
    }

    #[friction(limit = 1.0)]
    fn right(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 0.5)
    }

    #[force(at = bar)]
    fn pull(&self, t: f64) -> Vector2<f64> {
        t * Vector2::new(self.direction.cos(), self.direction.sin())
    }
}

/// Both feet let go at 2 s. From then on v = t²/2 − 2 t + 2, along the load.
fn feet_let_go_together(numbers: impl Iterator<Item = u8>) {
    for number in numbers {
        let bar = Bar { direction: 0.2512 * f64::from(number) };
        for tolerance in [1e-6, 1e-10, 1e-14] {
            let mut motion = bar.simulate(State::at_rest([0.0; 3])).with_tolerance(tolerance);
            let end = *motion.advance_to(4.0).unwrap_or_else(|error| panic!("{number}: {error}"));
            let error = (end.v[0] - 2.0 * bar.direction.cos()).hypot(end.v[1] - 2.0 * bar.direction.sin());
            assert!(error < tolerance + 1e-12, "{number}, {tolerance:e}: {error:e}");
        }
    }
}

#[test]
fn two_feet_let_go_together() {
    feet_let_go_together((0..25).step_by(4));
}

#[test]
#[ignore = "all directions: scripts/check.sh runs them"]
fn two_feet_let_go_together_in_all_directions() {
    feet_let_go_together(0..25);
}

/// A bar on two feet that hold unlike loads, pulled anywhere along it by a load that grows by 1 N/s.
struct Unlike {
    limits: [f64; 2],
    hook: f64,
    direction: f64,
}

#[lagrangian(coordinates = [x, y, angle])]
impl Unlike {
    #[body(mass = 1.0, inertia = 0.1)]
    fn bar(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.angle)
    }

    fn place(&self, q: &Coordinates, along: f64) -> Vector2<f64> {
        (self.bar(q) * Point2::new(along, 0.0)).coords
    }

    #[friction(limit = self.limits[0])]
    fn left(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.bar_velocity(q, v).at(self.place(q, -0.5))
    }

    #[friction(limit = self.limits[1])]
    fn right(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.bar_velocity(q, v).at(self.place(q, 0.5))
    }

    fn hook(&self, q: &Coordinates) -> Vector2<f64> {
        self.place(q, self.hook)
    }

    #[force(at = hook)]
    fn pull(&self, t: f64) -> Vector2<f64> {
        t * Vector2::new(self.direction.cos(), self.direction.sin())
    }
}

impl Unlike {
    /// Whether the feet can bear a load. What they bear across the bar follows from it; what they bear along
    /// the bar is shared in any way.
    fn can_bear(&self, load: f64) -> bool {
        let [along, across] = [load * self.direction.cos(), load * self.direction.sin()];
        let left = [across * (0.5 - self.hook), across * (0.5 + self.hook)];
        let rest = [0, 1].map(|foot| self.limits[foot].powi(2) - left[foot].powi(2));
        rest.iter().all(|&rest| rest >= 0.0) && along.abs() <= rest[0].sqrt() + rest[1].sqrt()
    }

    /// The largest load.
    fn limit(&self) -> f64 {
        let [mut low, mut high] = [0.0, 100.0];
        for _ in 0..64 {
            let middle = 0.5 * (low + high);
            *(if self.can_bear(middle) { &mut low } else { &mut high }) = middle;
        }
        low
    }
}

/// A foot that bears all it can leaves the rest to the other, until both bear no more. Then one foot may
/// stay, as the pivot of the other, or both slip, at speeds that grow from nothing.
#[test]
fn feet_that_hold_unlike_loads_let_go_at_the_largest() {
    let mut pivots = 0;
    for number in 0..6 {
        let mut random = Samples::new(number);
        let mut pick = |low: f64, high: f64| random.number(low, high);
        let limits = [pick(0.3, 3.0), pick(0.3, 3.0)];
        let bar = Unlike { limits, hook: pick(-1.0, 1.0), direction: pick(-3.1, 3.1) };
        let run = |tolerance: f64| {
            let mut motion = bar.simulate(State::at_rest([0.0; 3])).with_tolerance(tolerance);
            let freed = loop {
                let switch =
                    motion.advance_to_switch(100.0).unwrap_or_else(|error| panic!("{number}: {error}"));
                let contacts = motion.contacts();
                let stick = [contacts.left, contacts.right].map(|foot| foot == [Contact::Sticks; 2]);
                if stick != [true; 2] {
                    break (switch.unwrap().state.t, stick);
                }
            };
            let end = *motion.advance_to(6.0).unwrap_or_else(|error| panic!("{number}: {error}"));
            (freed, end.v)
        };
        let ((time, stick), v) = run(1e-9);
        close(time, bar.limit(), 1e-11);
        pivots += usize::from(stick.contains(&true));
        // A slip that has just begun is followed in up to a thousand steps, each with its tolerance.
        let (_, tight) = run(1e-12);
        (0..3)
            .for_each(|i| close_on(tight.iter().fold(1.0, |a: f64, b| a.max(b.abs())), v[i], tight[i], 1e-6));
    }
    assert!((1..6).contains(&pivots), "{pivots}");
}

/// A crate on four feet, in space, pulled at the floor by a load that grows by 20 N/s.
struct Crate {
    direction: f64,
}

#[lagrangian(coordinates = [hull: Pose])]
impl Crate {
    #[body(mass = 5.0, inertia = [0.05, 0.08, 0.1])]
    fn hull(&self, q: &Coordinates) -> Isometry3<f64> {
        q.hull
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        5.0 * 9.81 * self.hull(q).translation.z
    }

    fn foot(&self, q: &Coordinates, x: f64, y: f64) -> Vector3<f64> {
        (self.hull(q) * Point3::new(0.2 * x, 0.15 * y, -0.1)).coords
    }

    fn rub(&self, q: &Coordinates, v: &Velocities, x: f64, y: f64) -> Vector2<f64> {
        self.hull_velocity(q, v).at(self.foot(q, x, y)).xy()
    }

    fn hook(&self, q: &Coordinates) -> Vector3<f64> {
        self.foot(q, 0.0, 0.0)
    }

    #[unilateral]
    fn first(&self, q: &Coordinates) -> f64 {
        self.foot(q, 1.0, 1.0).z
    }

    #[unilateral]
    fn second(&self, q: &Coordinates) -> f64 {
        self.foot(q, -1.0, 1.0).z
    }

    #[unilateral]
    fn third(&self, q: &Coordinates) -> f64 {
        self.foot(q, -1.0, -1.0).z
    }

    #[unilateral]
    fn fourth(&self, q: &Coordinates) -> f64 {
        self.foot(q, 1.0, -1.0).z
    }

    #[friction(coefficient = 0.4, normal = first)]
    fn rub_first(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.rub(q, v, 1.0, 1.0)
    }

    #[friction(coefficient = 0.4, normal = second)]
    fn rub_second(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.rub(q, v, -1.0, 1.0)
    }

    #[friction(coefficient = 0.4, normal = third)]
    fn rub_third(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.rub(q, v, -1.0, -1.0)
    }

    #[friction(coefficient = 0.4, normal = fourth)]
    fn rub_fourth(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.rub(q, v, 1.0, -1.0)
    }

    #[force(at = hook)]
    fn pull(&self, t: f64) -> Vector3<f64> {
        20.0 * t * Vector3::new(self.direction.cos(), self.direction.sin(), 0.0)
    }
}

/// Follows a crate that is pulled in a direction. It lets go at µ m g / 20 N/s, and its speed is known.
fn pull(direction: f64) {
    let start = State::at_rest(CrateCoordinates { hull: Isometry3::translation(0.0, 0.0, 0.1) });
    let held = 0.4 * 5.0 * 9.81;
    let (freed, end) = (held / 20.0, 3.0_f64);
    let speed = (10.0 * (end.powi(2) - freed.powi(2)) - held * (end - freed)) / 5.0;
    let motion = Crate { direction };
    let state =
        *motion.simulate(start).advance_to(end).unwrap_or_else(|error| panic!("{direction}: {error}"));
    // The tolerance of the motion.
    close_on(speed, state.v[0], speed * direction.cos(), 1e-10);
    close_on(speed, state.v[1], speed * direction.sin(), 1e-10);
}

#[test]
#[ignore = "each motion takes a second: scripts/check.sh runs them"]
fn crates_let_go_in_all_directions() {
    (-19..20).for_each(|number| pull(0.157 * f64::from(number)));
}

/// A body on three feet, on a slope in whatever direction.
struct Tripod {
    feet: [Vector2<f64>; 3],
    friction: f64,
    weight: Vector3<f64>,
}

#[lagrangian(coordinates = [hull: Pose])]
impl Tripod {
    #[body(mass = 2.0, inertia = [0.2, 0.3, 0.4])]
    fn hull(&self, q: &Coordinates) -> Isometry3<f64> {
        q.hull
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        -2.0 * self.weight.dot(&q.hull.translation.vector)
    }

    fn tips(&self, q: &Coordinates) -> [Vector3<f64>; 3] {
        let feet: [Vector2<f64>; 3] = self.feet;
        feet.map(|foot| (q.hull * Point3::new(foot.x, foot.y, -0.2)).coords)
    }

    #[unilateral]
    fn gaps(&self, q: &Coordinates) -> [f64; 3] {
        self.tips(q).map(|tip| tip.z)
    }

    #[friction(coefficient = self.friction, normal = gaps[0])]
    fn first(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.tips_velocity(q, v)[0].xy()
    }

    #[friction(coefficient = self.friction, normal = gaps[1])]
    fn second(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.tips_velocity(q, v)[1].xy()
    }

    #[friction(coefficient = self.friction, normal = gaps[2])]
    fn third(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.tips_velocity(q, v)[2].xy()
    }
}

/// There is one possible share of the load, in which each foot is at its limit.
#[test]
fn three_feet_rest_on_the_steepest_slope() {
    let mut samples = Samples::new(21);
    for _ in 0..60 {
        let (slope, direction) = (samples.number(0.05, 0.6), samples.number(0.0, core::f64::consts::TAU));
        let (down, reach) = (9.81 * slope.sin(), samples.number(0.5, 1.0));
        let tripod = Tripod {
            feet: [0.3, 2.2, 4.4].map(|angle: f64| reach * Vector2::new(angle.cos(), angle.sin())),
            friction: slope.tan(),
            weight: Vector3::new(down * direction.cos(), down * direction.sin(), -9.81 * slope.cos()),
        };
        let turn = UnitQuaternion::from_euler_angles(0.0, 0.0, samples.number(-3.0, 3.0));
        let start = tripod.state(
            TripodCoordinates { hull: Isometry3::from_parts(Translation3::new(0.0, 0.0, 0.2), turn) },
            TripodVelocities { hull: PoseVelocity { linear: Vector3::zeros(), angular: Vector3::zeros() } },
        );
        let mut motion = tripod.simulate(start).with_max_steps(1000);
        assert_eq!(motion.advance_to(10.0).unwrap().v, [0.0; 6], "{:?}", tripod.weight);
    }
}
