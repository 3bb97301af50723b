//! A ball in a rough bowl: it rolls and slips by turns, and each slip begins under a load that grows slowly
//! while the ball carries it round. The bowl does no work, so the energy only falls.

use lagrangian::prelude::*;

use crate::support::sample::Samples;

const RADIUS: f64 = 0.1;
const BOWL: f64 = 1.0;

struct Bowl {
    friction: f64,
}

#[lagrangian(coordinates = [ball: Pose])]
impl Bowl {
    #[body(mass = 1.0, inertia = [0.4 * RADIUS * RADIUS, 0.4 * RADIUS * RADIUS, 0.4 * RADIUS * RADIUS])]
    fn ball(&self, q: &Coordinates) -> Isometry3<f64> {
        q.ball
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * self.ball(q).translation.z
    }

    #[unilateral]
    fn bowl(&self, q: &Coordinates) -> f64 {
        BOWL - RADIUS - self.ball(q).translation.vector.norm()
    }

    #[friction(coefficient = self.friction, normal = bowl)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let out = self.ball(q).translation.vector.normalize();
        let slip = self.ball_velocity(q, v).at(out * BOWL);
        let across = out.cross(&Vector3::new(0.0, 1.0, 0.0)).normalize();
        Vector2::new(slip.dot(&across), slip.dot(&out.cross(&across)))
    }
}

/// The end after three seconds, and the largest rise of the energy between two looks.
fn followed(bowl: &Bowl, start: State<f64, 6>, tolerance: f64) -> ([f64; 3], f64) {
    let mut motion = bowl.simulate(start).with_tolerance(tolerance);
    let (mut energy, mut rise) = (motion.energy(), 0.0_f64);
    for look in 1..=1500 {
        let state = *motion.advance_to(0.002 * f64::from(look)).unwrap();
        let now = bowl.energy(&state);
        (energy, rise) = (now, rise.max(now - energy));
    }
    let end = BowlCoordinates::from(motion.state().q).ball.translation;
    ([end.x, end.y, end.z], rise)
}

/// Balls that are thrown into the bowl with a spin.
fn thrown(number: usize) {
    let mut samples = Samples::new(11);
    for ball in 0..number {
        let bowl = Bowl { friction: samples.number(0.05, 0.55) };
        let mut within = |most: f64| samples.number(-most, most);
        let out = Vector3::new(within(0.6), within(0.6), -1.0).normalize();
        let thrown = Vector3::new(within(1.0), within(1.0), 0.0);
        let spin = Vector3::new(within(20.0), within(20.0), within(20.0));
        let place = Translation3::from(out * (BOWL - RADIUS));
        let start = bowl.state(
            BowlCoordinates { ball: Isometry3::from_parts(place, UnitQuaternion::identity()) },
            BowlVelocities { ball: PoseVelocity { linear: thrown - out * thrown.dot(&out), angular: spin } },
        );
        // About ten joules: a few hundred steps, each with the tolerance.
        let (end, rise) = followed(&bowl, start, 1e-8);
        assert!(rise < 1e-7, "{ball}: the energy rises by {rise:e}");
        let (closer, rise) = followed(&bowl, start, 1e-10);
        assert!(rise < 1e-9, "{ball}: the energy rises by {rise:e}");
        for (one, other) in end.iter().zip(closer) {
            assert!((one - other).abs() < 1e-6, "{ball}: {end:?} and {closer:?}");
        }
    }
}

#[test]
fn a_ball_in_a_bowl_gains_no_energy() {
    thrown(24);
}

#[test]
#[ignore = "a minute in release: one thousand balls"]
fn a_thousand_balls_in_a_bowl_gain_no_energy() {
    thrown(1000);
}
