//! Bad numbers from outside: parameters, starts, inputs, times and tolerances.

use lagrangian::prelude::*;
use lagrangian::{EquilibriumError, Name};

use crate::support::close::close;

struct Pendulum {
    m: f64,
    l: f64,
    g: f64,
}

#[lagrangian(coordinates = [theta], inputs = [motor], jacobians)]
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
    assert_eq!(
        error,
        MotionError { cause: Cause::SingularMassMatrix { pivot: 0, name: Name::new(&"theta") }, t: 3.0 }
    );
}

#[test]
fn a_negative_mass_names_its_coordinate() {
    // The torque of the motor does not contain the mass, so that the mass does not cancel. It would be an
    // error in any case, since the energy is that of another system.
    let expected =
        MotionError { cause: Cause::SingularMassMatrix { pivot: 0, name: Name::new(&"theta") }, t: 3.0 };
    let negative = Pendulum { m: -1.0, ..GOOD };
    let mut motion = negative.simulate(start());
    assert_eq!(motion.advance_to(4.0).unwrap_err(), expected);
    assert_eq!(motion.state(), &start());
    assert_eq!(negative.simulate(start()).every(0.1).next(), Some(Err(expected)));
    let mut stepper = negative.stepper::<Rk4>(start());
    assert_eq!(stepper.step(0.01, &[0.0]).unwrap_err(), expected);
    assert_eq!(stepper.state(), &start());
    // No other function computes with it.
    let (at, u) = (start(), [0.0]);
    assert_eq!(negative.accelerations(&at, &u).unwrap_err(), expected);
    assert_eq!(negative.jacobians(&at, &u).unwrap_err(), expected);
    assert_eq!(negative.response(&at, &u).unwrap_err(), expected);
    assert_eq!(negative.linearize(&at, &u).unwrap_err(), expected);
    assert_eq!(negative.modes(&at, &u).unwrap_err(), expected);
    let none = EquilibriumError::Constraints(expected.cause);
    assert_eq!(negative.equilibrium(at, &u).unwrap_err(), none);
    assert_eq!(negative.stationary_point(at, &u).unwrap_err(), none);
    // Without mass, forces can still be in balance.
    assert!(Pendulum { m: 0.0, ..GOOD }.stationary_point(at, &u).is_ok());
}

/// A bead on a circle, beside a mass that no constraint reaches.
struct Beside {
    m: [f64; 2],
}

#[lagrangian(coordinates = [x, y, z], jacobians)]
impl Beside {
    #[point(mass = self.m[0])]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[kinetic]
    fn other(&self, v: &Velocities) -> f64 {
        0.5 * self.m[1] * v.z.powi(2)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        q.y + 0.5 * q.z.powi(2)
    }

    #[holonomic]
    fn circle(&self, q: &Coordinates) -> f64 {
        self.bead(q).norm() - 1.0
    }
}

#[test]
fn a_negative_mass_beside_constraints_is_named_as_well() {
    let at = State::at_rest([0.6, -0.8, 0.1]);
    assert!(Beside { m: [1.0; 2] }.simulate(at).advance_to(0.1).is_ok());
    for (m, pivot) in [([-1.0, 1.0], 0), ([1.0, -1.0], 2)] {
        let system = Beside { m };
        let name = Name::new(&Beside::NAMES.coordinates[pivot]);
        let expected = Cause::SingularMassMatrix { pivot, name };
        assert_eq!(system.simulate(at).advance_to(0.1).unwrap_err().cause, expected);
        assert_eq!(system.accelerations(&at).unwrap_err().cause, expected);
        assert_eq!(system.consistent(at).unwrap_err().cause, expected);
        assert_eq!(system.linearize(&at, &[]).unwrap_err().cause, expected);
        let none = EquilibriumError::Constraints(expected);
        assert_eq!(system.equilibrium(at, &[]).unwrap_err(), none);
    }
}

#[test]
fn a_lagrangian_of_any_signature_needs_no_positive_masses() {
    let at = State::at_rest([0.3, 0.1]);
    assert_eq!(Hyperbolic.accelerations(&at).unwrap(), [-0.3, -0.1]);
    assert!(Hyperbolic.linearize(&at, &[]).is_ok());
    assert_eq!(Hyperbolic.stationary_point(at, &[]).unwrap().state.q, [0.0; 2]);
}

/// L = ẋ ẏ − x y: two oscillators whose kinetic energy has both signs.
struct Hyperbolic;

#[lagrangian(coordinates = [x, y], jacobians)]
impl Hyperbolic {
    #[lagrangian]
    fn difference(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.x * v.y - q.x * q.y
    }
}

/// T that is negative for some parameters.
struct Backwards {
    m: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Backwards {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2) + self.m * v.x * v.y + 0.5 * v.y.powi(2)
    }
}

#[test]
fn a_kinetic_energy_that_is_not_positive_names_its_coordinate() {
    let state = State::new([0.0; 2], [1.0, 0.5]);
    for (m, is_positive) in [(0.9, true), (-0.9, true), (1.0, false), (1.1, false), (-3.0, false)] {
        let found = Backwards { m }.simulate(state).advance_to(1.0).map(|_| ()).map_err(|error| error.cause);
        let name = Name::new(&"y");
        let expected = if is_positive { Ok(()) } else { Err(Cause::SingularMassMatrix { pivot: 1, name }) };
        assert_eq!(found, expected, "{m}");
    }
}

#[test]
fn bad_starts_and_inputs_are_not_finite() {
    for start in [State::at_rest([f64::NAN]), State::new([0.0], [f64::INFINITY])] {
        let error = GOOD.simulate(start).advance_to(1.0).unwrap_err();
        assert_eq!(error.cause, Cause::NotFinite);
        // Not even where it is asked for itself.
        assert_eq!(GOOD.simulate(start).advance_to(start.t).unwrap_err().cause, Cause::NotFinite);
        let mut motion = GOOD.simulate(start);
        let samples: Vec<_> = motion.every(0.1).take(3).collect();
        assert_eq!(samples, [Err(MotionError { cause: Cause::NotFinite, t: start.t })]);
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

/// A pendulum in any precision.
struct Precise<R> {
    l: R,
}

#[lagrangian(coordinates = [theta])]
impl<R: Real> Precise<R> {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(self.l * q.theta.sin(), -self.l * q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        9.81 * self.bob(q).y
    }
}

#[test]
fn a_tolerance_of_zero_means_rounding_in_any_precision() {
    let exact = *Precise { l: 1.0_f64 }.simulate(State::at_rest([1.0])).advance_to(10.0).unwrap();
    let mut double =
        Precise { l: 1.0_f64 }.simulate_with::<Dop853>(State::at_rest([1.0])).with_tolerance(0.0);
    close(double.advance_to(10.0).unwrap().q[0], exact.q[0], 1e-9);
    let single = Precise { l: 1.0_f32 };
    let mut motion = single.simulate_with::<Dop853>(State::at_rest([1.0_f32])).with_tolerance(0.0);
    close(f64::from(motion.advance_to(10.0).unwrap().q[0]), exact.q[0], 1e-3);
    let mut motion = single.simulate(State::at_rest([1.0_f32])).with_tolerance(0.0);
    close(f64::from(motion.advance_to(10.0).unwrap().q[0]), exact.q[0], 1e-3);
}

/// Two masses on a rod and a thread.
struct Linkage {
    masses: [f64; 2],
}

#[lagrangian(coordinates = [x, y, z, w], jacobians)]
impl Linkage {
    #[point(mass = self.masses[0])]
    fn first(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[point(mass = self.masses[1])]
    fn second(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.z, q.w)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * (q.y + q.w)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.first(q).norm() - 1.0
    }

    #[holonomic]
    fn thread(&self, q: &Coordinates) -> f64 {
        (self.second(q) - self.first(q)).norm() - 1.0
    }
}

#[test]
fn masses_beside_constraints_are_named_or_no_numbers() {
    let start = State::at_rest([0.6, 0.8, 1.6, 0.8]);
    for (masses, expected) in [
        ([0.0, 1.0], Cause::SingularMassMatrix { pivot: 0, name: Name::new(&"x") }),
        ([1.0, 0.0], Cause::SingularMassMatrix { pivot: 2, name: Name::new(&"z") }),
        ([f64::INFINITY, 1.0], Cause::NotFinite),
        ([f64::NAN, 1.0], Cause::NotFinite),
    ] {
        let linkage = Linkage { masses };
        assert_eq!(linkage.accelerations(&start).unwrap_err().cause, expected, "{masses:?}");
        assert_eq!(linkage.consistent(start).unwrap_err().cause, expected, "{masses:?}");
        assert_eq!(linkage.simulate(start).advance_to(1.0).unwrap_err().cause, expected, "{masses:?}");
        assert_eq!(linkage.linearize(&start, &[]).unwrap_err().cause, expected, "{masses:?}");
    }
}

struct Pushed;

#[lagrangian(coordinates = [x], inputs = [push, rise])]
impl Pushed {
    #[point(mass = 2.0)]
    fn block(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[force(at = block)]
    fn push(&self, u: &Inputs, t: f64) -> Vector1<f64> {
        Vector1::new(u.push + u.rise * t)
    }
}

#[test]
fn an_infinite_force_that_does_not_change_is_not_finite() {
    for inputs in [[f64::INFINITY, 0.0], [0.0, f64::NEG_INFINITY], [f64::NAN, 0.0]] {
        let error = Pushed.simulate(State::at_rest([1.0])).with_inputs(inputs).advance_to(1.0).unwrap_err();
        assert_eq!(error, MotionError { cause: Cause::NotFinite, t: 0.0 }, "{inputs:?}");
    }
}
