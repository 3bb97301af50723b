//! A body on four feet in space, each rough in two directions: it falls, wobbles and comes to rest.

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
    let ends = (0..400).filter_map(|number| follow(number).err());
    let ends: Vec<Cause> = ends.map(|error| error.cause).collect();
    // Two feet that stick have shares of the friction along the line between them that no law tells.
    assert!(ends.iter().all(|cause| matches!(cause, Cause::EndlessSwitching { .. })), "{ends:?}");
    assert!(ends.len() <= 4, "{ends:?}");
}

/// A ball of radius 1/8 that strikes the corner between a floor and a wall, both rough.
struct Ball {
    friction: f64,
}

const RADIUS: f64 = 0.125;

#[lagrangian(coordinates = [ball: Pose])]
impl Ball {
    #[body(mass = 1.0, inertia = [0.4 * RADIUS * RADIUS; 3])]
    fn ball(&self, q: &Coordinates) -> Isometry3<f64> {
        q.ball
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.ball.translation.vector.z - RADIUS
    }

    #[unilateral]
    fn wall(&self, q: &Coordinates) -> f64 {
        q.ball.translation.vector.x - RADIUS
    }

    #[friction(coefficient = self.friction, normal = floor)]
    fn floor_slip(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let below = q.ball.translation.vector - Vector3::new(0.0, 0.0, RADIUS);
        let slip = self.ball_velocity(q, v).at(below);
        Vector2::new(slip.x, slip.y)
    }

    #[friction(coefficient = self.friction, normal = wall)]
    fn wall_slip(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let beside = q.ball.translation.vector - Vector3::new(RADIUS, 0.0, 0.0);
        let slip = self.ball_velocity(q, v).at(beside);
        Vector2::new(slip.y, slip.z)
    }
}

/// The linear velocity of a ball after it has struck both, and its spin times its radius.
fn struck(friction: f64, linear: [f64; 3], spin: [f64; 3]) -> [f64; 6] {
    let ball = Ball { friction };
    let place = Translation3::new(RADIUS, 0.0, RADIUS);
    let body = Isometry3::from_parts(place, UnitQuaternion::identity());
    let velocity = PoseVelocity { linear: linear.into(), angular: Vector3::from(spin) / RADIUS };
    let start = ball.state(BallCoordinates { ball: body }, BallVelocities { ball: velocity });
    let mut motion = ball.simulate(start);
    motion.advance_to(1e-12).unwrap();
    let state = *motion.state();
    let PoseVelocity { linear, angular } = ball.velocities(&state).ball;
    let spin = RADIUS * angular;
    [linear.x, linear.y, linear.z, spin.x, spin.y, spin.z]
}

/// References by hand: where a slip remains, friction takes µ Λ of it; where both stick, nothing is left but
/// a motion along the edge, and here no such motion is possible without spin.
#[test]
fn a_ball_strikes_two_walls_at_once() {
    // Both stick.
    let still = struck(1.0, [-1.25, 0.0, -0.75], [0.0; 3]);
    assert!(still.iter().all(|v| v.abs() < 1e-14), "{still:?}");
    // The floor sticks, and the ball slips along the wall.
    let slips = struck(0.4, [-0.25, 1.65, -1.7], [-2.375, -1.5, -0.5]);
    let wanted = [0.0, 113.0 / 70.0, 0.0, -113.0 / 70.0, 0.0, 0.35];
    assert!(slips.iter().zip(wanted).all(|(v, wanted)| (v - wanted).abs() < 4e-15), "{slips:?}");
    // Both slip: from the same equations, solved with thirty digits.
    let slips = struck(0.4, [-0.24, 1.65, -1.7], [-2.4, -1.6, -0.5]);
    let rolls = [-1.644_131_902_421_084, -0.056_609_569_454_318_61, 0.341_569_824_774_532_25];
    let wanted = [0.0, 1.615_719_309_121_753_4, 0.0, rolls[0], rolls[1], rolls[2]];
    assert!(slips.iter().zip(wanted).all(|(v, wanted)| (v - wanted).abs() < 4e-15), "{slips:?}");
}
