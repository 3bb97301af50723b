//! Constraints in single precision.

use lagrangian::prelude::*;

use crate::support::close::{all_close_on_largest, close, close_on};

/// A generic pendulum whose pivot slides and whose bob is a body that a fin turns as it moves.
#[derive(Clone, Copy)]
struct Slider<R> {
    m: [R; 2],
    length: R,
    g: R,
}

#[lagrangian(coordinates = [pivot, x, y, heading], inputs = [motor])]
impl<R: Real> Slider<R> {
    #[point(mass = self.m[0])]
    fn pivot(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.pivot, R::zero())
    }

    #[body(mass = self.m[1], inertia = 0.05)]
    fn bob(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        (Vector2::new(q.x, q.y), q.heading)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        self.m[1] * self.g * q.y
    }

    #[force(on = pivot)]
    fn motor(&self, u: &Inputs<R>) -> R {
        u.motor
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates<R>) -> R {
        (self.bob(q).0 - self.pivot(q)).norm() - self.length
    }

    #[nonholonomic]
    fn fin(&self, q: &Coordinates<R>, v: &Velocities<R>) -> R {
        v.heading - 0.5 * (v.x * q.heading.cos() + v.y * q.heading.sin())
    }
}

fn slider<R: Real>() -> Slider<R> {
    Slider { m: [2.0, 0.5].map(R::from_f64), length: R::from_f64(1.25), g: R::from_f64(9.81) }
}

fn start<R: Real>() -> State<R, 4> {
    let number = R::from_f64;
    // The bob moves across the rod (3/5, −4/5). The last rate is that which the fin then has at heading zero.
    State::new(
        [number(0.0), number(0.75), number(-1.0), number(0.0)],
        [number(0.0), number(0.8), number(0.6), number(0.4)],
    )
}

fn wide(state: &State<f32, 4>) -> State<f64, 4> {
    State::new(state.q.map(f64::from), state.v.map(f64::from)).at_time(f64::from(state.t))
}

#[test]
fn single_precision_is_double_precision_rounded() {
    let (double, single) = (slider::<f64>(), slider::<f32>());
    let mut fine = double.simulate(start()).with_inputs([0.7]);
    let mut jets = single.simulate(start()).with_inputs([0.7]);
    let mut dop853 = single.simulate_with::<Dop853>(start()).with_inputs([0.7]);
    let mut jet = single.stepper::<Jet<6>>(start());
    let mut rk4 = single.stepper::<Rk4>(start());
    for k in 1..=100 {
        let t = 0.01 * f64::from(k);
        let expected = *fine.advance_to(t).unwrap();
        jet.step(0.01, &[0.7]).unwrap();
        rk4.step(0.01, &[0.7]).unwrap();
        for state in [
            *jets.advance_to(t as f32).unwrap(),
            *dop853.advance_to(t as f32).unwrap(),
            *jet.state(),
            *rk4.state(),
        ] {
            let state = wide(&state);
            all_close_on_largest(state.q, expected.q, 1e-4);
            all_close_on_largest(state.v, expected.v, 1e-4);
            for residual in double.constraint_residuals(&state) {
                close_on(1.0, residual, 0.0, 1e-6);
            }
            for rate in double.constraint_rates(&state) {
                close_on(1.0, rate, 0.0, 2e-6);
            }
        }
        close(f64::from(jets.reactions().rod), fine.reactions().rod, 1e-3);
        close(f64::from(jet.reactions(&[0.7]).fin), fine.reactions().fin, 1e-2);
    }
    assert!(jets.steps().evaluations < 100, "{:?}", jets.steps());
}

#[test]
fn starts_are_judged_by_the_digits_of_the_scalar() {
    let single = slider::<f32>();
    let mut rough = start::<f32>();
    rough.q[1] += 2e-6;
    assert!(single.simulate(rough).advance_to(0.1).is_ok());
    rough.q[1] += 1e-3;
    let cause = single.simulate(rough).advance_to(0.1).unwrap_err().cause;
    assert!(matches!(cause, Cause::PositionViolated { constraint: 0, .. }), "{cause:?}");
    let mended = single.consistent(rough).unwrap();
    for residual in single.constraint_residuals(&mended) {
        close_on(1.0, f64::from(residual), 0.0, 2e-7);
    }
    assert!(single.simulate(mended).advance_to(0.1).is_ok());
    assert_eq!(single.consistent(mended).unwrap(), mended);
}
