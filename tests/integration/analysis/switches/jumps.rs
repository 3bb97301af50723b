//! Impacts that carry velocities over a kink, plastic ones that begin to bounce, and joints that come to rest.

use lagrangian::Dual;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close_on_largest, close, close_on};

/// A body with the drag of air that hits a wall.
struct Drag {
    restitution: f64,
}

#[lagrangian(coordinates = [x], sensitivities = [self.restitution])]
impl Drag {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[force(on = x)]
    fn air(&self, v: &Velocities) -> f64 {
        -0.5 * v.x * v.x.abs()
    }

    #[unilateral(restitution = self.restitution)]
    fn wall(&self, q: &Coordinates) -> f64 {
        1.0 - q.x
    }
}

/// Place and speed some time after the impact of a body that starts towards the wall.
fn returned<R: Ordered>(x: R, v: R, e: R, t: R) -> [R; 2] {
    let (one, c) = (R::one(), R::from_f64(0.5));
    let growth = (c * (one - x)).exp();
    let hit = (growth - one) / (c * v);
    let left = e * v / growth;
    let slowed = one + c * left * (t - hit);
    [one - slowed.ln() / c, -left / slowed]
}

#[test]
fn an_impact_over_a_kink_of_the_velocity_has_the_derivatives_of_the_closed_form() {
    for step in 1..=20 {
        let part = |k: f64| (k * f64::from(step) * 0.618).fract();
        let (x, v, e, t) = (0.6 * part(1.0), 2.0 + 2.0 * part(2.0), 0.2 + 0.8 * part(3.0), 1.5);
        let drag = Drag { restitution: e };
        let varied = drag.variational();
        let mut motion = varied.motion(State::new([x], [v])).unwrap().with_tolerance(TIGHT);
        let found = motion.advance_to(t).unwrap();
        let number = |value, direction| Dual::<f64, 3>::variable(value, direction);
        let [place, speed] = returned(number(x, 0), number(v, 1), number(e, 2), Dual::constant(t));
        close(found.state.q[0], place.value, 1e-11);
        for ([by_q, by_v, by_p], exact) in [
            ([found.q_by_q[(0, 0)], found.q_by_v[(0, 0)], found.q_by_p[(0, 0)]], place),
            ([found.v_by_q[(0, 0)], found.v_by_v[(0, 0)], found.v_by_p[(0, 0)]], speed),
        ] {
            all_close_on_largest([by_q, by_v, by_p], exact.slopes, 1e-10);
        }
    }
}

/// A ball that is heavier on its way up.
struct Ball {
    restitution: f64,
    radius: f64,
}

#[lagrangian(coordinates = [y], sensitivities = [self.restitution])]
impl Ball {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.y * v.y
    }

    #[force(on = y)]
    fn weight(&self, v: &Velocities) -> f64 {
        if v.y > 0.0 { -11.81 } else { -9.81 }
    }

    #[unilateral(restitution = self.restitution)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y - self.radius
    }
}

#[test]
fn an_impact_over_a_jump_of_the_force_has_derivatives() {
    let ball = Ball { restitution: 0.8, radius: 0.0 };
    let found = ball.variational().motion(State::at_rest([0.5])).unwrap().advance_to(0.4).unwrap();
    // v = e √(2 g y) − (g + c) (t − √(2 y / g)).
    let fall = (2.0 * 9.81 * 0.5_f64).sqrt();
    close(found.v_by_q[(0, 0)], 0.8 * 9.81 / fall + 11.81 / fall, 1e-9);
    close(found.v_by_p[(0, 0)], fall, 1e-9);
}

#[test]
fn impacts_without_end_have_no_derivatives_beside_a_kink_either() {
    for start in [0.1, 0.25, 0.5, 1.0] {
        let ball = Ball { restitution: 0.6, radius: 0.0 };
        let varied = ball.variational();
        let error = varied.motion(State::at_rest([start])).unwrap().advance_to(10.0).unwrap_err();
        assert!(matches!(error.cause, Cause::ImpactsAccumulate { .. }), "{start}: {error}");
    }
}

/// A ball of this radius.
struct Round {
    radius: f64,
}

#[lagrangian(coordinates = [y], jacobians)]
impl Round {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.y * v.y
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral(restitution = 0.6)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y - self.radius
    }
}

#[test]
fn impacts_without_end_are_named_wherever_the_floor_is() {
    for radius in [0.0, 1e-6, 0.2, 10.0] {
        for start in [0.1, 0.25, 0.5, 1.0] {
            let ball = Round { radius };
            let varied = ball.variational();
            let mut motion = varied.motion(State::at_rest([radius + start])).unwrap();
            let error = motion.advance_to(10.0).unwrap_err();
            assert!(matches!(error.cause, Cause::ImpactsAccumulate { .. }), "{radius} {start}: {error}");
        }
    }
}

/// Where a plastic contact begins to bounce, infinitely many impacts follow, with friction between them.
#[test]
fn a_restitution_of_zero_has_no_derivative() {
    let ball = Ball { restitution: 0.0, radius: 0.0 };
    let varied = ball.variational();
    let mut motion = varied.motion(State::at_rest([0.5])).unwrap();
    let error = motion.advance_to(1.0).unwrap_err();
    assert!(matches!(error.cause, Cause::ImpactsAccumulate { .. }), "{error}");
}

/// A pendulum on a pin with dry friction.
struct Pendulum;

#[lagrangian(coordinates = [x, y, phi], jacobians)]
impl Pendulum {
    #[point(mass = 2.0)]
    fn centre(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        0.05 * v.phi * v.phi
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * self.centre(q).y
    }

    #[holonomic]
    fn pin(&self, q: &Coordinates) -> [f64; 2] {
        let centre = self.centre(q);
        [centre.x - 0.5 * q.phi.sin(), centre.y + 0.5 * q.phi.cos()]
    }

    #[friction(coefficient = 0.3, normal = [pin])]
    fn slip(&self, v: &Velocities) -> f64 {
        0.008 * v.phi
    }
}

/// At rest one of the two reactions is exactly zero, and the size of both has derivatives all the same.
#[test]
fn a_pin_that_comes_to_rest_has_derivatives() {
    for step in 1..=40 {
        let phi = 0.1 * (f64::from(step) * 0.618).fract() - 0.05;
        let start = State::at_rest([0.5 * phi.sin(), -0.5 * phi.cos(), phi]);
        let found = Pendulum.variational().motion(start).unwrap().advance_to(10.0).unwrap();
        assert_eq!(found.state.v, [0.0; 3]);
        // It stays where it stands: no velocity at the end has a derivative.
        close_on(1.0, found.v_by_q.norm() + found.v_by_v.norm(), 0.0, 1e-12);
    }
}
