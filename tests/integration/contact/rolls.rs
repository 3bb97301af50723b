//! A ball that slides and spins until it rolls, in fixed steps.

use lagrangian::prelude::*;

use crate::support::sample::Samples;

struct Ball {
    mass: f64,
    radius: f64,
    friction: f64,
}

#[lagrangian(coordinates = [ball: Pose])]
impl Ball {
    #[body(mass = self.mass, inertia = [0.4 * self.mass * self.radius.powi(2); 3])]
    fn ball(&self, q: &Coordinates) -> Isometry3<f64> {
        q.ball
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * self.mass * q.ball.translation.z
    }

    #[unilateral]
    fn table(&self, q: &Coordinates) -> f64 {
        q.ball.translation.z - self.radius
    }

    #[friction(coefficient = self.friction, normal = table)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> Vector2<f64> {
        let lowest = q.ball.translation.vector - Vector3::new(0.0, 0.0, self.radius);
        let slip = self.ball_velocity(q, v).at(lowest);
        Vector2::new(slip.x, slip.y)
    }
}

#[test]
fn a_sliding_ball_comes_to_roll_in_fixed_steps() {
    let mut samples = Samples::new(41);
    for (h, tolerance) in [(1e-2, 1e-3), (3e-3, 1e-6)] {
        for _ in 0..16 {
            let (mass, radius) = (samples.number(0.1, 0.5), samples.number(0.02, 0.05));
            let ball = Ball { mass, radius, friction: samples.number(0.1, 0.4) };
            let [vx, vy] = [(); 2].map(|()| samples.number(-2.0, 2.0));
            let [wx, wy, wz] = [(); 3].map(|()| samples.number(-60.0, 60.0));
            let turned = UnitQuaternion::from_euler_angles(samples.number(-3.0, 3.0), 0.4, -1.0);
            let place = Isometry3::from_parts(Translation3::new(0.0, 0.0, radius), turned);
            let angular = turned.inverse() * Vector3::new(wx, wy, wz);
            let velocity = PoseVelocity { linear: Vector3::new(vx, vy, 0.0), angular };
            let start = ball.state(BallCoordinates { ball: place }, BallVelocities { ball: velocity });

            // The slip keeps its direction. When the ball rolls, the velocity has lost 2/7 of the slip.
            let [x, y] = [vx - radius * wy, vy + radius * wx];
            let rolls = x.hypot(y) * 2.0 / 7.0 / (ball.friction * 9.81);
            let mut motion = ball.stepper::<Jet<6>>(start);
            while motion.state().t < rolls + 0.05 {
                motion.step(h, &[]).unwrap();
            }
            let reached = ball.velocities(motion.state()).ball.linear;
            let expected = Vector3::new(vx - 2.0 / 7.0 * x, vy - 2.0 / 7.0 * y, 0.0);
            assert!((reached - expected).norm() < tolerance, "{reached} {expected} in steps of {h}");
        }
    }
}
