//! Bodies on several rough feet: a stool in space falls, wobbles and comes to rest, and boxes slide on each
//! other.

use lagrangian::prelude::*;

use crate::support::sample::Samples;

/// A body of one kilogram with four feet.
struct Stool {
    feet: [[f64; 3]; 4],
    inertia: [f64; 3],
    restitution: f64,
    friction: f64,
}

#[lagrangian(coordinates = [body: Pose])]
impl Stool {
    #[body(mass = 1.0, inertia = self.inertia)]
    fn body(&self, q: &Coordinates) -> Isometry3<f64> {
        q.body
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.body.translation.vector.z
    }

    fn foot(&self, q: &Coordinates, index: usize) -> Vector3<f64> {
        let [x, y, z] = self.feet[index];
        (q.body * Point3::new(x, y, z)).coords
    }

    fn slip(&self, q: &Coordinates, v: &Velocities, index: usize) -> Vector2<f64> {
        let slip = self.body_velocity(q, v).at(self.foot(q, index));
        Vector2::new(slip.x, slip.y)
    }

    #[unilateral(restitution = self.restitution)]
    fn first(&self, q: &Coordinates) -> f64 {
        self.foot(q, 0).z
    }

    #[friction(coefficient = self.friction, normal = first)]
    fn first_slip(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 0)
    }

    #[unilateral(restitution = self.restitution)]
    fn second(&self, q: &Coordinates) -> f64 {
        self.foot(q, 1).z
    }

    #[friction(coefficient = self.friction, normal = second)]
    fn second_slip(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 1)
    }

    #[unilateral(restitution = self.restitution)]
    fn third(&self, q: &Coordinates) -> f64 {
        self.foot(q, 2).z
    }

    #[friction(coefficient = self.friction, normal = third)]
    fn third_slip(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 2)
    }

    #[unilateral(restitution = self.restitution)]
    fn fourth(&self, q: &Coordinates) -> f64 {
        self.foot(q, 3).z
    }

    #[friction(coefficient = self.friction, normal = fourth)]
    fn fourth_slip(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        self.slip(q, v, 3)
    }
}

/// Follows a stool of a number for one and a half seconds, or a thousand changes of its regime, and returns
/// how many there were, or the error that ended its motion.
fn follow(number: u64) -> Result<usize, MotionError<f64>> {
    let mut random = Samples::new(number);
    let mut pick = |low: f64, high: f64| random.number(low, high);
    let coefficient = |unit: f64, most: f64| ((3.0 * unit - 1.0).clamp(0.0, 1.0)) * most;
    let mut feet = [[0.3, 0.2, -0.1], [-0.3, 0.2, -0.1], [-0.3, -0.2, -0.1], [0.3, -0.2, -0.1]];
    // Every other one stands on three of them.
    if number % 2 == 1 {
        feet.iter_mut().flatten().for_each(|x| *x += pick(-0.05, 0.05));
    }
    let stool = Stool {
        feet,
        inertia: [pick(0.02, 0.05), pick(0.03, 0.06), pick(0.04, 0.06)],
        restitution: coefficient(pick(0.0, 1.0), 0.8),
        friction: coefficient(pick(0.0, 1.0), 1.0),
    };
    let tilt = if pick(0.0, 1.0) < 0.3 { 0.0 } else { 0.6 };
    let turn =
        UnitQuaternion::from_euler_angles(tilt * pick(-1.0, 1.0), tilt * pick(-1.0, 1.0), pick(-3.0, 3.0));
    let lowest = feet.iter().map(|&[x, y, z]| (turn * Vector3::new(x, y, z)).z).fold(0.0, f64::min);
    let height = pick(-0.2, 0.3).max(0.0) - lowest;
    let linear = Vector3::new(pick(-2.0, 2.0), pick(-2.0, 2.0), pick(-1.0, 0.5));
    let spin = if pick(0.0, 1.0) < 0.2 { 0.0 } else { 3.0 };
    let angular = spin * Vector3::new(pick(-1.0, 1.0), pick(-1.0, 1.0), pick(-1.0, 1.0));
    let body = Isometry3::from_parts(Translation3::new(0.0, 0.0, height), turn);
    let velocity = PoseVelocity { linear, angular };
    let start = stool.state(StoolCoordinates { body }, StoolVelocities { body: velocity });
    let mut motion = stool.simulate(start).with_tolerance(1e-10).with_max_steps(20_000);
    let mut energy = stool.energy(motion.state());
    for switches in 0..1000 {
        let switch = motion.advance_to_switch(1.5)?;
        let state = *motion.state();
        let now = stool.energy(&state);
        assert!(now <= energy + 1e-8 * (1.0 + energy.abs()), "{number}: E grows to {now} from {energy}");
        energy = now;
        let q = StoolCoordinates::from(state.q);
        let least = (0..4).map(|index| stool.foot(&q, index).z).fold(0.0, f64::min);
        assert!(least >= -1e-12, "{number}: penetration {least} at {}", state.t);
        if switch.is_none() {
            return Ok(switches);
        }
    }
    Ok(1000)
}

#[test]
fn stools_obey_the_laws_of_contact() {
    let switches: usize = [2, 5, 8].into_iter().map(|number| follow(number).unwrap()).sum();
    assert!(switches > 10);
}

#[test]
#[ignore = "hundreds of motions: scripts/check.sh runs them"]
fn hundreds_of_stools_come_to_rest() {
    let ends = (0..400).filter_map(|number| Some((number, follow(number).err()?)));
    let ends: Vec<(u64, MotionError<f64>)> = ends.collect();
    assert!(ends.is_empty(), "{ends:?}");
}

/// Two boxes in a plane, one on the other.
struct Boxes {
    half: [[f64; 2]; 2],
    masses: [f64; 2],
    friction: [f64; 2],
}

#[lagrangian(coordinates = [x0, y0, a0, x1, y1, a1])]
impl Boxes {
    fn inertia(&self, index: usize) -> f64 {
        let [x, y] = self.half[index];
        self.masses[index] * (x * x + y * y) / 3.0
    }

    #[body(mass = self.masses[0], inertia = self.inertia(0))]
    fn lower(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x0, q.y0), q.a0)
    }

    #[body(mass = self.masses[1], inertia = self.inertia(1))]
    fn upper(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x1, q.y1), q.a1)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (self.masses[0] * q.y0 + self.masses[1] * q.y1)
    }

    fn foot(&self, q: &Coordinates, side: f64) -> Vector2<f64> {
        (self.lower(q) * Point2::new(side * self.half[0][0], -self.half[0][1])).coords
    }

    fn corner(&self, q: &Coordinates, side: f64) -> Point2<f64> {
        self.upper(q) * Point2::new(side * self.half[1][0], -self.half[1][1])
    }

    fn above(&self, q: &Coordinates, side: f64) -> f64 {
        (self.lower(q).inverse() * self.corner(q, side)).y - self.half[0][1]
    }

    fn rub(&self, q: &Coordinates, v: &Velocities, side: f64) -> f64 {
        let at = self.corner(q, side).coords;
        let slip = self.upper_velocity(q, v).at(at) - self.lower_velocity(q, v).at(at);
        (self.lower(q).rotation.inverse() * slip).x
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> [f64; 2] {
        [self.foot(q, -1.0).y, self.foot(q, 1.0).y]
    }

    #[unilateral]
    fn top(&self, q: &Coordinates) -> [f64; 2] {
        [self.above(q, -1.0), self.above(q, 1.0)]
    }

    #[friction(coefficient = self.friction[0], normal = floor)]
    fn floor_slip(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        let of = |side: f64| self.lower_velocity(q, v).at(self.foot(q, side)).x;
        [of(-1.0), of(1.0)]
    }

    #[friction(coefficient = self.friction[1], normal = top)]
    fn top_slip(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        [self.rub(q, v, -1.0), self.rub(q, v, 1.0)]
    }
}

/// The series of boxes that slide hold for all times, and the time that is asked for is much longer than that
/// of the slip.
fn boxes_slide_to_rest(count: u8) {
    let mut random = Samples::new(1);
    for number in 0..count {
        let mut pick = |low: f64, high: f64| random.number(low, high);
        let half = [[pick(0.3, 0.6), pick(0.2, 0.4)], [pick(0.1, 0.3), pick(0.1, 0.4)]];
        let masses = [pick(0.2, 1.2), pick(0.2, 2.2)];
        let boxes = Boxes { half, masses, friction: [pick(0.1, 0.7), pick(0.1, 0.7)] };
        let speed = 10.0_f64.powf(pick(-12.0, -1.0));
        let q = [0.0, half[0][1], 0.0, pick(-0.1, 0.1), 2.0 * half[0][1] + half[1][1], 0.0];
        let start = State::new(q, [speed, 0.0, 0.0, f64::from(number % 3) * speed, 0.0, 0.0]);
        for until in [10.0, 1e3, 1e6] {
            let mut motion = boxes.simulate(start);
            let end = *motion.advance_to(until).unwrap_or_else(|error| panic!("{number}: {error}"));
            assert_eq!(end.v, [0.0; 6], "{number}");
            assert!(boxes.energy(&end) <= boxes.energy(&start), "{number}");
        }
    }
}

#[test]
fn boxes_that_slide_stay_where_they_come_to_rest() {
    boxes_slide_to_rest(6);
}

#[test]
#[ignore = "many boxes: scripts/check.sh runs them"]
fn many_boxes_that_slide_stay_where_they_come_to_rest() {
    boxes_slide_to_rest(20);
}
