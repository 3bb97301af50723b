//! Bad numbers from outside: parameters, starts, inputs, times and tolerances.

use lagrangian::prelude::*;

struct Pendulum {
    m: f64,
    l: f64,
    g: f64,
}

#[lagrangian(coordinates = [theta], inputs = [motor])]
impl Pendulum {
    #[point(mass = self.m)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta.sin(), -q.theta.cos()) * self.l
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * self.g * self.bob(q).y
    }

    #[force(on = theta)]
    fn motor(&self, u: &Inputs) -> f64 {
        u.motor
    }
}

const GOOD: Pendulum = Pendulum { m: 1.0, l: 1.0, g: 9.81 };

fn start() -> State<f64, 1> {
    State::at_rest([1.0]).at_time(3.0)
}

#[test]
fn bad_parameters_are_not_finite_at_the_start() {
    let expected = MotionError { cause: Cause::NotFinite, t: 3.0 };
    for bad in [f64::NAN, f64::INFINITY] {
        for pendulum in
            [Pendulum { m: bad, ..GOOD }, Pendulum { l: bad, ..GOOD }, Pendulum { g: bad, ..GOOD }]
        {
            let mut motion = pendulum.simulate(start());
            assert_eq!(motion.advance_to(4.0).unwrap_err(), expected);
            assert_eq!(motion.state(), &start());
            let mut stepper = pendulum.stepper::<Rk4>(start());
            assert_eq!(stepper.step(0.01, &[0.0]).unwrap_err(), expected);
            assert_eq!(stepper.state(), &start());
        }
    }
}

#[test]
fn a_massless_pendulum_is_singular() {
    let massless = Pendulum { m: 0.0, ..GOOD };
    let error = massless.simulate(start()).advance_to(4.0).unwrap_err();
    assert_eq!(error, MotionError { cause: Cause::SingularMassMatrix { pivot: 0 }, t: 3.0 });
}

#[test]
fn bad_starts_and_inputs_are_not_finite() {
    for start in [State::at_rest([f64::NAN]), State::new([0.0], [f64::INFINITY])] {
        let error = GOOD.simulate(start).advance_to(1.0).unwrap_err();
        assert_eq!(error.cause, Cause::NotFinite);
    }
    let mut motion = GOOD.simulate(start()).with_inputs([f64::NAN]);
    assert_eq!(motion.advance_to(4.0).unwrap_err(), MotionError { cause: Cause::NotFinite, t: 3.0 });
    // Good inputs mend it.
    motion.set_inputs([0.0]);
    assert!(motion.advance_to(4.0).is_ok());
}

#[test]
fn bad_times_and_tolerances_are_named() {
    let cause = |tolerance: f64, t: f64| {
        let mut motion = GOOD.simulate(start()).with_tolerance(tolerance);
        let error = motion.advance_to(t).unwrap_err();
        assert_eq!(motion.state(), &start());
        error.cause
    };
    assert_eq!(cause(1e-9, f64::NAN), Cause::InvalidTime);
    assert_eq!(cause(1e-9, f64::INFINITY), Cause::InvalidTime);
    assert_eq!(cause(-1e-9, 4.0), Cause::InvalidTolerance);
    assert_eq!(cause(f64::NAN, 4.0), Cause::InvalidTolerance);
    let mut motion = GOOD.simulate(start()).with_max_steps(2);
    assert_eq!(motion.advance_to(1e3).unwrap_err().cause, Cause::TooManySteps);
}

#[test]
fn feedback_that_fails_stops_the_motion_there() {
    let failing = |state: &State<f64, 1>| [if state.t > 3.5 { f64::NAN } else { 0.0 }];
    let mut motion = GOOD.simulate(start()).with_control(failing);
    let error = motion.advance_to(5.0).unwrap_err();
    assert_eq!(error.cause, Cause::NotFinite);
    assert!((error.t - 3.5).abs() < 1e-6, "{error}");
    assert!(motion.state().is_finite());
}
