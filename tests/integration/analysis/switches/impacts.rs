//! A ball that bounces, and where its motion has no derivatives.

use lagrangian::Dual;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close_on_largest, close, close_on};
use crate::support::sample::Samples;

/// A ball over a floor, and under a ceiling that is far away unless a test says otherwise.
struct Ball {
    gravity: f64,
    restitution: f64,
    ceiling: f64,
}

#[lagrangian(coordinates = [x, y], sensitivities = [self.restitution, self.gravity])]
impl Ball {
    #[point(mass = 0.3)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        0.3 * self.gravity * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[unilateral(restitution = 0.5)]
    fn ceiling(&self, q: &Coordinates) -> f64 {
        self.ceiling - q.y
    }
}

const BALL: Ball = Ball { gravity: 9.81, restitution: 0.8, ceiling: 100.0 };

/// Height and speed of a ball at a time.
fn bounced<R: Ordered>(y: R, v: R, e: R, g: R, t: R) -> [R; 2] {
    let [half, two] = [0.5, 2.0].map(R::from_f64);
    let mut speed = (v * v + two * g * y).sqrt();
    let mut hit = (v + speed) / g;
    if t < hit {
        return [y + t * (v - half * g * t), v - g * t];
    }
    loop {
        speed = e * speed;
        let flight = two * speed / g;
        if t < hit + flight {
            let s = t - hit;
            return [s * (speed - half * g * s), speed - g * s];
        }
        hit += flight;
    }
}

#[test]
fn a_bouncing_ball_has_the_derivatives_of_its_closed_form() {
    bounces_as_in_closed_form(0.8);
}

#[test]
fn a_ball_that_loses_nothing_has_derivatives_by_its_restitution() {
    bounces_as_in_closed_form(1.0);
}

fn bounces_as_in_closed_form(restitution: f64) {
    let ball = Ball { restitution, ..BALL };
    let varied = ball.variational();
    let mut motion = varied.motion(State::new([0.0, 1.0], [0.7, 0.3])).unwrap().with_tolerance(TIGHT);
    let number = |value, direction| Dual::<f64, 4>::variable(value, direction);
    for tenth in 1..=30 {
        let t = 0.1 * f64::from(tenth);
        let found = motion.advance_to(t).unwrap();
        let [y, v] = bounced(
            number(1.0, 0),
            number(0.3, 1),
            number(restitution, 2),
            number(9.81, 3),
            Dual::constant(t),
        );
        close_on(1.0, found.state.q[1], y.value, 1e-13);
        for (rows, exact) in
            [((found.q_by_q, found.q_by_v, found.q_by_p), y), ((found.v_by_q, found.v_by_v, found.v_by_p), v)]
        {
            let (by_q, by_v, by_p) = rows;
            let row = [by_q[(1, 1)], by_v[(1, 1)], by_p[(1, 0)], by_p[(1, 1)]];
            all_close_on_largest(row, exact.slopes, 1e-12);
            // The motion along the floor is not disturbed.
            close_on(1.0, by_q[(1, 0)], 0.0, 1e-15);
        }
        close(found.q_by_v[(0, 0)], t, 1e-14);
    }
}

#[test]
fn impacts_without_end_have_no_derivatives() {
    let varied = BALL.variational();
    let mut motion = varied.motion(State::new([0.0, 1.0], [0.7, 0.0])).unwrap();
    let error = motion.advance_to(10.0).unwrap_err();
    assert!(
        matches!(error.cause, Cause::ImpactsAccumulate { name, .. } if name.as_str() == "floor"),
        "{error}"
    );
    // The impacts accumulate at 4.0637127687715781 s. Flights below the rounding of heights are not followed.
    close_on(1.0, error.t, 4.063_712_768_771_578, 1e-6);
    assert_eq!(motion.transition().state.t, 0.0);
    // On the floor it has derivatives again, along the floor.
    let rest = varied.motion(State::new([1.0, 0.0], [0.7, 0.0])).unwrap().advance_to(1.0).unwrap();
    close(rest.q_by_v[(0, 0)], 1.0, 1e-14);
    assert_eq!(
        [rest.q_by_q[(1, 1)], rest.q_by_v[(1, 1)], rest.v_by_v[(1, 1)], rest.v_by_p[(1, 1)]],
        [0.0; 4]
    );
}

#[test]
fn a_ball_that_grazes_has_no_derivatives() {
    let speed = 6.0_f64;
    let top = speed * speed / (2.0 * 9.81);
    for (ceiling, grazes) in [(top * (1.0 - 1e-14), true), (top * (1.0 - 1e-4), false)] {
        let ball = Ball { ceiling, ..BALL };
        let mut motion = ball.simulate(State::new([0.0, 0.0], [0.0, speed])).with_tolerance(1e-12);
        let hits = motion.advance_to_switch(1.0).unwrap().is_some();
        let varied = ball.variational();
        let mut motion = varied.motion(State::new([0.0, 0.0], [0.0, speed])).unwrap().with_tolerance(1e-12);
        let found = motion.advance_to(1.0);
        match found {
            Err(error) => {
                assert!(grazes, "{error}");
                assert!(
                    matches!(error.cause, Cause::Grazes { name, .. } if name.as_str() == "ceiling"),
                    "{error}"
                );
                assert!(error.to_string().contains("grazes `ceiling`"), "{error}");
            }
            Ok(_) => assert!(!grazes || !hits),
        }
    }
}

/// The highest point of a flight is at the ceiling, up to rounding errors of either sign.
#[test]
fn a_ball_that_just_reaches_the_ceiling_has_no_derivatives() {
    let mut random = Samples::new(17);
    let mut draws = vec![(2.0, 2.0, 1.0)];
    draws.extend((0..40).map(|_| {
        let (gravity, speed) = (random.number(1.0, 10.0), random.number(1.0, 5.0));
        (gravity, speed, speed * speed / (2.0 * gravity))
    }));
    for (gravity, speed, ceiling) in draws {
        let ball = Ball { gravity, restitution: 0.8, ceiling };
        let variational = ball.variational();
        let start = State::new([0.0, 1e-3], [1.0, (speed * speed - 2e-3 * gravity).sqrt()]);
        for start in [State::new([0.0, 0.0], [0.5, speed]), start] {
            let mut motion = variational.motion(start).unwrap().with_tolerance(1e-12);
            let top = start.v[1] / gravity;
            motion.advance_to(0.9 * top).unwrap();
            let error = motion.advance_to(1.5 * top).unwrap_err();
            assert!(
                matches!(error.cause, Cause::Grazes { name, .. } if name.as_str() == "ceiling"),
                "{error}"
            );
            close_on(1.0, error.t, top, 1e-5);
        }
    }
}

#[test]
fn a_start_in_an_impact_has_no_derivatives() {
    let varied = BALL.variational();
    let error = varied.motion(State::new([0.0, 0.0], [0.0, -1.0])).err().unwrap();
    assert!(error.to_string().contains("begins in an impact at `floor`"), "{error}");
    // A motion that begins right after an impact has derivatives.
    let mut motion = varied.motion(State::new([0.0, 0.0], [0.0, 1.0])).unwrap();
    close(motion.advance_to(0.1).unwrap().q_by_v[(1, 1)], 0.1, 1e-13);
}

/// Two balls over the same floor.
struct Balls;

#[lagrangian(coordinates = [left, right], jacobians)]
impl Balls {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * (v.left * v.left + v.right * v.right)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (q.left + q.right)
    }

    #[unilateral(restitution = 0.9)]
    fn floors(&self, q: &Coordinates) -> [f64; 2] {
        [q.left, q.right]
    }
}

#[test]
fn switches_that_coincide_are_named() {
    let varied = Balls.variational();
    let mut motion = varied.motion(State::at_rest([1.0, 1.0])).unwrap();
    let error = motion.advance_to(1.0).unwrap_err();
    assert!(error.to_string().contains("`floors[0]` and `floors[1]` switch at once"), "{error}");
    let mut motion = varied.motion(State::at_rest([1.0, 1.0 + 1e-6])).unwrap();
    assert!(motion.advance_to(1.0).is_ok());
}
