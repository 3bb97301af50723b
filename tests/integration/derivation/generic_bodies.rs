//! Bodies, rotations and vectors in a generic scalar: poses as pairs, since nalgebra's isometries know only
//! their own scalars.

use lagrangian::prelude::*;

use crate::support::close::{all_close, between, close};
use crate::support::difference::{derivative, moved};
use crate::support::dual::Dual;
use crate::support::identities::model;
use crate::support::sample::Samples;

#[derive(Clone, Copy)]
struct Machine<R> {
    mass: R,
    arm: R,
    inertia: [R; 3],
    moments: Vector3<R>,
    axis: Unit<Vector3<R>>,
}

#[lagrangian(coordinates = [phi, theta, psi, x], inputs = [motor])]
impl<R: Real> Machine<R> {
    #[body(mass = self.mass, inertia = self.inertia)]
    fn top(&self, q: &Coordinates<R>) -> (Vector3<R>, Rotation3<R>) {
        let attitude = Rotation3::from_axis_angle(&Vector3::z_axis(), q.phi)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.theta)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.psi);
        (attitude * Vector3::new(R::zero(), R::zero(), self.arm), attitude)
    }

    #[body(mass = 2.0, inertia = self.moments)]
    fn rotor(&self, q: &Coordinates<R>) -> (Vector3<R>, Rotation3<R>) {
        let axis: Unit<Vector3<R>> = self.axis;
        let tilt = Rotation3::from_axis_angle(&axis, q.x).inverse();
        (
            Vector3::new(q.x, q.x * 0.5, R::one()),
            Rotation3::from_euler_angles(q.phi, q.x, 0.25 * q.psi) * tilt,
        )
    }

    #[body(mass = 3.0, inertia = 0.5)]
    fn plate(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        (Rotation2::new(q.x) * Vector2::new(q.phi, R::one()), q.x + q.phi)
    }

    #[potential]
    fn field(&self, q: &Coordinates<R>) -> R {
        let ((r, _), (s, _)) = (self.top(q), self.rotor(q));
        9.81 * r.z + (r - s).norm() + r.cross(&s).norm_squared().powf(0.75) + r.dot(&s.normalize())
    }

    #[force(at = plate)]
    fn motor(&self, u: &Inputs<R>, v: &Velocities<R>, t: R) -> (Vector2<R>, R) {
        (Vector2::new(u.motor, v.x * 3.0), t * u.motor.sin())
    }
}

fn machine<R: Real>() -> Machine<R> {
    let number = R::from_f64;
    Machine {
        mass: number(1.2),
        arm: number(0.7),
        inertia: [0.1, 0.2, 0.3].map(number),
        moments: Vector3::new(number(0.5), number(0.25), number(0.75)),
        axis: Unit::new_unchecked(Vector3::new(number(0.6), R::zero(), number(0.8))),
    }
}

fn state() -> State<f64, 4> {
    Samples::new(4).state(0.4, 1.2)
}

#[test]
fn generic_bodies_are_those_of_double_precision() {
    model!(machine::<f64>(), inputs = [0.4]).holds(0.4, 1.2);
    let (machine, state) = (machine::<f64>(), state());
    close(machine.potential_energy(&state), machine.field(&state.q.into()), 1e-14);
}

#[test]
fn single_precision_keeps_six_digits() {
    let state = state();
    let single = State::new(state.q.map(|x| x as f32), state.v.map(|x| x as f32)).at_time(state.t as f32);
    let found = machine::<f32>().accelerations(&single, &[0.4]).unwrap();
    let exact = machine::<f64>().accelerations(&state, &[0.4]).unwrap();
    for (found, exact) in found.into_iter().zip(exact) {
        between(1e-9, (f64::from(found) / exact - 1.0).abs(), 1e-5);
    }
}

#[test]
fn dual_numbers_pass_through_rotations() {
    let state = state();
    let constant = |numbers: [f64; 4]| numbers.map(Dual::constant);
    let mut dual = State::new(constant(state.q), constant(state.v)).at_time(Dual::constant(state.t));
    dual.q[1].slope = 1.0;
    let found = machine::<Dual>().accelerations(&dual, &[Dual::constant(0.4)]).unwrap();
    let plain = machine::<f64>();
    let expected = derivative(0.004, |x| plain.accelerations(&moved(&state, 1, x), &[0.4]).unwrap());
    all_close(found.map(|a| a.slope), expected, 1e-10);
}
