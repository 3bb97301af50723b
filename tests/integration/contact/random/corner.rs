//! Balls that strike the corner between two rough walls.

use lagrangian::prelude::*;

use super::{MOST, Tally};
use crate::support::sample::Samples;

/// A ball in three dimensions in a corner of three rough walls.
struct Corner {
    radius: f64,
    restitution: f64,
    friction: f64,
}

#[lagrangian(coordinates = [ball: Pose])]
impl Corner {
    #[body(mass = 1.0, inertia = [0.4 * self.radius * self.radius; 3])]
    fn ball(&self, q: &Coordinates) -> Isometry3<f64> {
        q.ball
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.ball.translation.vector.z
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.ball.translation.vector.z - self.radius
    }

    #[unilateral(restitution = self.restitution)]
    fn wall(&self, q: &Coordinates) -> f64 {
        q.ball.translation.vector.x - self.radius
    }

    #[friction(coefficient = self.friction, normal = floor)]
    fn floor_slip(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let below = q.ball.translation.vector - Vector3::new(0.0, 0.0, self.radius);
        let slip = self.ball_velocity(q, v).at(below);
        Vector2::new(slip.x, slip.y)
    }

    #[friction(coefficient = self.friction, normal = wall)]
    fn wall_slip(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let beside = q.ball.translation.vector - Vector3::new(self.radius, 0.0, 0.0);
        let slip = self.ball_velocity(q, v).at(beside);
        Vector2::new(slip.y, slip.z)
    }
}

/// Follows a ball in a corner.
fn follow_in_corner(number: u64, tally: &mut Tally) {
    let mut random = Samples::new(number);
    let mut pick = |low: f64, high: f64| random.number(low, high);
    let coefficient = |unit: f64, most: f64| ((3.0 * unit - 1.0).clamp(0.0, 1.0)) * most;
    let radius = pick(0.05, 0.3);
    let corner = Corner {
        radius,
        restitution: coefficient(pick(0.0, 1.0), 1.0),
        friction: coefficient(pick(0.0, 1.0), 1.0),
    };
    let tilted = UnitQuaternion::from_euler_angles(pick(-1.0, 1.0), pick(-1.0, 1.0), pick(-1.0, 1.0));
    let place = [pick(-0.3, 0.3).max(0.0) + radius, 0.0, pick(-0.3, 0.3).max(0.0) + radius];
    let spins = pick(-1.0, 1.0) > 0.0;
    let mut turn = |most: f64| if spins { pick(-most, most) } else { 0.0 };
    let angular = Vector3::new(turn(20.0), turn(20.0), turn(20.0));
    let linear = Vector3::new(pick(-3.0, 1.0), pick(-2.0, 2.0), pick(-2.0, 1.0));
    let start = corner.state(
        CornerCoordinates {
            ball: Isometry3::from_parts(Translation3::new(place[0], place[1], place[2]), tilted),
        },
        CornerVelocities { ball: PoseVelocity { linear, angular } },
    );
    let gap = |corner: &Corner, state: &State<f64, 6>| {
        let place = CornerCoordinates::from(state.q).ball.translation.vector;
        place.x.min(place.z) - corner.radius
    };
    follow!(tally, number, corner, start, gap, true);
}

#[test]
#[ignore = "ten thousand motions: scripts/check.sh runs them"]
fn ten_thousand_balls_in_a_corner_have_one_motion() {
    let mut tally = Tally::default();
    (0..10_000).for_each(|number| follow_in_corner(number, &mut tally));
    assert!(tally.switches > 5 * tally.motions && tally.paradoxes == 0, "{tally:?}");
}

/// Balls whose reactions at a wall are nothing but rounding errors, with the friction that these drive; balls
/// that touch a wall at a velocity that is a rounding error; balls whose slips at two walls depend on each
/// other; balls that stick at both, where the equations do not tell the reactions; and a smooth one that a
/// wall presses with nothing at all.
#[test]
fn random_balls_in_a_corner_obey_their_laws() {
    let mut tally = Tally::default();
    let corners = (0..40)
        .chain([41, 80, 83, 84, 103, 110, 142, 218, 248, 364, 383, 406, 475, 493, 546, 688, 710, 957])
        .chain([1009, 1195, 1198, 1453, 1521, 1622, 1845, 6771, 8329]);
    corners.for_each(|number| follow_in_corner(number, &mut tally));
    assert!(tally.switches > 5 * tally.motions && tally.paradoxes == 0, "{tally:?}");
}

/// The radius of the ball in the references.
const RADIUS: f64 = 0.125;

/// The linear velocity of a ball after it has struck both, and its spin times its radius.
fn struck(friction: f64, linear: [f64; 3], spin: [f64; 3]) -> [f64; 6] {
    let corner = Corner { radius: RADIUS, restitution: 0.0, friction };
    let place = Translation3::new(RADIUS, 0.0, RADIUS);
    let body = Isometry3::from_parts(place, UnitQuaternion::identity());
    let velocity = PoseVelocity { linear: linear.into(), angular: Vector3::from(spin) / RADIUS };
    let start = corner.state(CornerCoordinates { ball: body }, CornerVelocities { ball: velocity });
    let mut motion = corner.simulate(start);
    // The weight changes nothing in this time.
    motion.advance_to(1e-17).unwrap();
    let state = *motion.state();
    let PoseVelocity { linear, angular } = corner.velocities(&state).ball;
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
