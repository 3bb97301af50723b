//! Constraints that no state satisfies together, from the start or from some time on, and other ends of
//! motions, each by its right name.

use std::f64::consts::PI;

use lagrangian::prelude::*;

/// A particle on a circle whose radius is asked for twice; the second one grows apart from the first.
struct Growing {
    rate: f64,
}

#[lagrangian(coordinates = [x, y], allow(redundant))]
impl Growing {
    #[point(mass = 1.0)]
    fn place(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.place(q).norm() - 1.0
    }

    #[holonomic]
    fn again(&self, q: &Coordinates, t: f64) -> f64 {
        self.place(q).norm() - 1.0 - self.rate * t * t
    }
}

/// A pendulum whose length is asked for twice.
struct Twice {
    length: f64,
    again: f64,
}

#[lagrangian(coordinates = [x, y], allow(redundant))]
impl Twice {
    #[point(mass = 1.0)]
    fn place(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.place(q).norm() - self.length
    }

    #[holonomic]
    fn again(&self, q: &Coordinates) -> f64 {
        self.place(q).norm_squared() - self.again * self.again
    }
}

/// A pendulum.
struct Once {
    length: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Once {
    #[point(mass = 1.0)]
    fn place(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.place(q).norm() - self.length
    }
}

/// A triangle of bars 1, 1 and 2 about a hinge: it is flat, and turns as a whole.
struct Flat;

#[lagrangian(coordinates = [a, b, c])]
impl Flat {
    #[point(mass = 1.0)]
    fn knee(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.a.cos(), q.a.sin())
    }

    #[point(mass = 1.0)]
    fn end(&self, q: &Coordinates) -> Vector2<f64> {
        self.knee(q) + Vector2::new(q.b.cos(), q.b.sin())
    }

    #[holonomic]
    fn closed(&self, q: &Coordinates) -> Vector2<f64> {
        self.end(q) + 2.0 * Vector2::new(q.c.cos(), q.c.sin())
    }
}

/// The errors that end a motion by each method.
macro_rules! ends {
    ($system:expr, $start:expr, $end:expr) => {{
        let (system, start, end): (_, _, f64) = (&$system, $start, $end);
        let fixed = |cause: Option<MotionError<f64>>| cause.expect("no motion");
        [
            system.simulate(start).advance_to(end).expect_err("no motion"),
            system.simulate_with::<Dop853>(start).advance_to(end).expect_err("no motion"),
            fixed({
                let mut motion = system.stepper::<Jet<6>>(start);
                (0..200).find_map(|_| motion.step(end / 200.0, &[]).err())
            }),
            fixed({
                let mut motion = system.stepper::<Rk4>(start);
                (0..200).find_map(|_| motion.step(end / 200.0, &[]).err())
            }),
        ]
    }};
}

#[track_caller]
fn is_contradictory(cause: Cause) {
    assert!(matches!(cause, Cause::Contradictory { constraint: 1, .. }), "{cause:?}");
    assert!(cause.to_string().contains("again"), "{cause}");
}

#[test]
fn constraints_that_come_to_contradict_each_other_end_a_motion() {
    for rate in [1e-1, 1e-5, 1e-9] {
        for error in ends!(Growing { rate }, State::new([1.0, 0.0], [0.0, 0.5]), 2.0) {
            // A state half way between the two circles violates both constraints alike.
            assert!(matches!(error.cause, Cause::Contradictory { .. }), "{:?}", error.cause);
            // By this time the violation is so large that a start would be refused.
            assert!(error.t < 1e-9 / rate, "{} at {rate}", error.t);
        }
    }
}

#[test]
fn constraints_that_contradict_each_other_are_no_fault_of_the_start() {
    let system = Twice { length: 1.0, again: 1.1 };
    for place in [[1.0, 0.0], [0.0, -1.1], [0.63, 0.84]] {
        let start = State::new(place, [-0.5 * place[1], 0.5 * place[0]]);
        for error in ends!(system, start, 1.0) {
            is_contradictory(error.cause);
        }
        is_contradictory(system.accelerations(&start).unwrap_err().cause);
        is_contradictory(system.reactions(&start).unwrap_err().cause);
        is_contradictory(system.consistent(start).unwrap_err().cause);
    }
}

#[test]
fn a_start_beside_redundant_constraints_is_the_fault_of_the_start() {
    let system = Twice { length: 1.0, again: 1.0 };
    let start = State::at_rest([0.8, -0.7]);
    for error in ends!(system, start, 1.0) {
        assert!(matches!(error.cause, Cause::PositionViolated { .. }), "{error}");
    }
    system.accelerations(&start).unwrap();
}

#[test]
fn lengths_of_ten_digits_contradict_nothing() {
    let system = Twice { length: 1.0, again: 1.0 + 1e-10 };
    let start = State::new([0.8, -0.6], [0.6, 0.8]);
    system.simulate(start).advance_to(2.0).unwrap();
    system.accelerations(&start).unwrap();
}

#[test]
fn a_parameter_that_is_no_number_is_named_by_all_functions() {
    let state = State::new([0.8, -0.6], [0.6, 0.8]);
    for length in [f64::NAN, f64::INFINITY] {
        let once = Once { length };
        assert_eq!(once.accelerations(&state).unwrap_err().cause, Cause::NotFinite);
        assert_eq!(once.reactions(&state).unwrap_err().cause, Cause::NotFinite);
        let twice = Twice { length, again: 1.0 };
        assert_eq!(twice.accelerations(&state).unwrap_err().cause, Cause::NotFinite);
        assert_eq!(twice.reaction_power(&state).unwrap_err().cause, Cause::NotFinite);
        for error in ends!(twice, state, 1.0) {
            assert_eq!(error.cause, Cause::NotFinite);
        }
    }
}

#[test]
fn a_step_from_which_nothing_leads_back_is_too_long() {
    let system = Twice { length: 1.0, again: 1.0 };
    let mut motion = system.stepper::<Rk4>(State::new([0.8, -0.6], [0.6, 0.8]));
    assert_eq!(motion.step(1e3, &[]).unwrap_err().cause, Cause::StepTooLong);
}

#[test]
fn a_velocity_that_no_motion_has_determines_none() {
    let start = State::new([0.3, 0.3, 0.3 + PI], [2.0, 0.0, 1.0]);
    for error in ends!(Flat, start, 0.3) {
        assert!(matches!(error.cause, Cause::Undetermined { .. }), "{error}");
        assert!(error.t < 1e-6);
    }
    let turning = State::new([0.3, 0.3, 0.3 + PI], [1.0, 1.0, 1.0]);
    Flat.simulate(turning).advance_to(0.3).unwrap();
    Flat.simulate_with::<Dop853>(turning).advance_to(0.3).unwrap();
}
