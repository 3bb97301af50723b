//! Stabilisation by Baumgarte's method instead of projection: f″ + 2 α f′ + α² f = 0 and g′ + α g = 0.

use lagrangian::prelude::*;

use crate::support::close::{all_close, between, close, close_on};
use crate::support::motion::numbers;

const G: f64 = 9.81;

/// A pendulum whose pivot drags a skate: one holonomic and one nonholonomic constraint.
struct Stabilised {
    rate: f64,
}

#[lagrangian(coordinates = [x, y, u, w, heading], baumgarte = self.rate)]
impl Stabilised {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[body(mass = 1.5, inertia = 0.2)]
    fn skate(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.u, q.w), q.heading)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * (q.y + 0.3 * 1.5 * q.u)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - 1.0
    }

    #[nonholonomic]
    fn blade(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.u * q.heading.sin() - v.w * q.heading.cos()
    }
}

/// The same with projection.
struct Projected;

#[lagrangian(coordinates = [x, y, u, w, heading])]
impl Projected {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[body(mass = 1.5, inertia = 0.2)]
    fn skate(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.u, q.w), q.heading)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * (q.y + 0.3 * 1.5 * q.u)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - 1.0
    }

    #[nonholonomic]
    fn blade(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.u * q.heading.sin() - v.w * q.heading.cos()
    }
}

fn start() -> State<f64, 5> {
    State::new([0.6, -0.8, 0.0, 0.0, 0.0], [0.8, 0.6, 1.0, 0.0, 1.2])
}

#[test]
fn on_the_constraints_it_is_the_same_motion() {
    let stabilised = Stabilised { rate: 5.0 };
    let expected = numbers(Projected.simulate(start()).with_tolerance(1e-15).advance_to(3.0).unwrap());
    let mut jets = stabilised.simulate(start()).with_tolerance(1e-15);
    all_close(numbers(jets.advance_to(3.0).unwrap()), &expected, 1e-11);
    let mut dop853 = stabilised.simulate_with::<Dop853>(start()).with_tolerance(1e-15);
    all_close(numbers(dop853.advance_to(3.0).unwrap()), &expected, 1e-11);
    let (found, projected) =
        (stabilised.reactions(&start()).unwrap(), Projected.reactions(&start()).unwrap());
    close(found.rod, projected.rod, 1e-13);
    close(found.blade, projected.blade, 1e-13);
}

/// The violation of a start that nine digits allow, which decays; the rate shows in the violation's second
/// derivative.
fn violated(by: f64) -> State<f64, 5> {
    let mut state = start();
    (state.q[0], state.q[1]) = (0.6 * (1.0 + by), -0.8 * (1.0 + by));
    state.v[3] = -by;
    state
}

#[test]
fn a_small_violation_decays_at_the_given_rate() {
    let stabilised = Stabilised { rate: 4.0 };
    let by = 4e-10;
    let check = |state: &State<f64, 5>| {
        let decay = (-4.0 * state.t).exp();
        let [rod, blade] = stabilised.constraint_residuals(state);
        close_on(by, rod, by * (1.0 + 4.0 * state.t) * decay, 1e-5);
        close_on(by, blade, by * decay, 1e-5);
    };
    let mut jets = stabilised.simulate(violated(by)).with_tolerance(1e-15);
    let mut dop853 = stabilised.simulate_with::<Dop853>(violated(by)).with_tolerance(1e-15);
    let mut jet = stabilised.stepper::<Jet<10>>(violated(by));
    for k in 1..=20 {
        let t = 0.1 * f64::from(k);
        check(jets.advance_to(t).unwrap());
        check(dop853.advance_to(t).unwrap());
        for _ in 0..10 {
            jet.step(0.01, &[]).unwrap();
        }
        check(jet.state());
    }
}

#[test]
fn without_a_rate_a_violation_grows_and_with_one_it_stays_small() {
    // A method of low order, so that there is something to see.
    let largest = |rate: f64| {
        let stabilised = Stabilised { rate };
        let mut motion = stabilised.stepper::<Rk4>(start());
        let mut largest = 0.0_f64;
        for _ in 0..2000 {
            let state = motion.step(0.02, &[]).unwrap();
            largest = largest.max(stabilised.constraint_residuals(state)[0].abs());
        }
        largest
    };
    let (free, held) = (largest(0.0), largest(10.0));
    between(1e-6, free, 1.0);
    between(1e-12, held, free / 30.0);
}

#[test]
fn starts_are_checked_all_the_same() {
    let stabilised = Stabilised { rate: 4.0 };
    let error = stabilised.simulate(violated(1e-3)).advance_to(1.0).unwrap_err();
    assert!(matches!(error.cause, Cause::PositionViolated { constraint: 0, .. }), "{error:?}");
    let mut fast = start();
    fast.v[3] = 0.25;
    let error = stabilised.stepper::<Rk4>(fast).step(0.01, &[]).unwrap_err();
    assert!(matches!(error.cause, Cause::VelocityViolated { constraint: 1, .. }), "{error:?}");
    let mended = stabilised.consistent(violated(1e-3)).unwrap();
    assert!(stabilised.simulate(mended).advance_to(1.0).is_ok());
}
