//! `max`, `min`, `clamp`: stops that only push, ropes that only pull, motors with a largest force.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};
use crate::support::sample::Samples;

/// A block between a stop below, which only pushes, and a rope above, which only pulls; a motor with a
/// largest force.
#[derive(Clone, Copy)]
struct Lift<R> {
    mass: R,
    g: R,
    stop: R,
    rope: R,
    length: R,
    largest: R,
    speed: R,
}

#[lagrangian(coordinates = [x], inputs = [motor], jacobians)]
impl<R: Real> Lift<R> {
    #[kinetic]
    fn kinetic(&self, v: &Velocities<R>) -> R {
        0.5 * self.mass * v.x * v.x
    }

    #[potential]
    fn weight(&self, q: &Coordinates<R>) -> R {
        self.mass * self.g * q.x
    }

    #[potential]
    fn stop(&self, q: &Coordinates<R>) -> R {
        0.5 * self.stop * (-q.x).positive_part().powi(2)
    }

    #[potential]
    fn rope(&self, q: &Coordinates<R>) -> R {
        0.5 * self.rope * (q.x - q.x.min(self.length)).powi(2)
    }

    #[force(on = x)]
    fn motor(&self, v: &Velocities<R>, u: &Inputs<R>) -> R {
        u.motor.clamp(-self.largest, self.largest) - v.x.max(self.speed)
    }
}

fn lift<R: Real>() -> Lift<R> {
    let [mass, g, stop, rope, length, largest, speed] =
        [2.0, 9.81, 400.0, 50.0, 1.5, 7.0, 0.25].map(R::from_f64);
    Lift { mass, g, stop, rope, length, largest, speed }
}

fn force(x: f64, v: f64, u: f64) -> f64 {
    let Lift { mass, g, stop, rope, length, largest, speed } = lift::<f64>();
    let stop = if x < 0.0 { -stop * x } else { 0.0 };
    let rope = if x > length { -rope * (x - length) } else { 0.0 };
    -mass * g + stop + rope + u.clamp(-largest, largest) - v.max(speed)
}

#[test]
fn forces_are_those_of_each_side() {
    let mut samples = Samples::new(91);
    for _ in 0..200 {
        let state: State<f64, 1> = samples.state(-3.0, 3.0);
        let u = samples.number(-20.0, 20.0);
        let expected = force(state.q[0], state.v[0], u) / 2.0;
        all_close(lift().accelerations(&state, &[u]).unwrap(), [expected], 1e-14);
        let single = State::new([state.q[0] as f32], [state.v[0] as f32]);
        let [found] = lift::<f32>().accelerations(&single, &[u as f32]).unwrap();
        close(f64::from(found), expected, 1e-4);
    }
}

#[test]
fn a_bound_is_kept_to_the_last_bit() {
    let rest = State::at_rest([1.0]);
    let at = |u: f64| lift().accelerations(&rest, &[u]).unwrap()[0];
    for (far, bound) in [(1e20, 7.0), (-1e20, -7.0), (1e300, 7.0), (7.0, 7.0)] {
        assert_eq!(at(far), at(bound));
    }
    assert!(at(6.9) < at(7.0) && at(-6.9) > at(-7.0));
}

#[test]
fn derivatives_are_those_of_each_side() {
    let jacobians = |x: f64, v: f64, u: f64| lift().jacobians(&State::new([x], [v]), &[u]).unwrap();
    for (x, stiffness) in [(-0.5, 400.0), (0.5, 0.0), (2.5, 50.0)] {
        for (v, damping) in [(-1.0, 0.0), (0.2, 0.0), (0.3, 1.0)] {
            for (u, gain) in [(-8.0, 0.0), (1.0, 1.0), (8.0, 0.0)] {
                let found = jacobians(x, v, u);
                assert_eq!(
                    (found.by_q[0], found.by_v[0], found.by_u[0]),
                    (-stiffness / 2.0, -damping / 2.0, gain / 2.0)
                );
            }
        }
    }
}

/// A ball that falls on a spring that only pushes.
struct Ball;

#[lagrangian(coordinates = [height])]
impl Ball {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.height)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        10.0 * q.height
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * 1e4 * f64::min(q.height, 0.0).powi(2)
    }
}

#[test]
fn a_bouncing_ball_comes_back_after_its_period() {
    // A fall, and a little more than half a swing about the place where the spring carries the weight.
    let (height, rate): (f64, f64) = (0.8, 100.0);
    let fall = (2.0 * height / 10.0).sqrt();
    let contact = 2.0 / rate * (std::f64::consts::PI - (10.0 * fall * rate / 10.0).atan());
    let mut motion = Ball.simulate(State::at_rest([height])).with_tolerance(1e-12);
    for bounce in 1..=10 {
        let end = *motion.advance_to(f64::from(bounce) * (2.0 * fall + contact)).unwrap();
        close(end.q[0], height, 1e-10);
        close(motion.energy(), 8.0, 1e-11);
    }
    assert!(Ball::STRUCTURE.to_string().contains("switched at its zeros"), "{}", Ball::STRUCTURE);
    assert!(Ball::EQUATIONS.contains("max(0, −height)"), "{}", Ball::EQUATIONS);
}
