//! Constraints that cannot be met, or that restrict nothing at a state: every function gives the same error.

use lagrangian::{EquilibriumError, Name, prelude::*};

/// A circle twice, the second time of another radius.
struct Twice {
    square: f64,
}

#[lagrangian(coordinates = [x, y], jacobians, allow(redundant))]
impl Twice {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[holonomic]
    fn circle(&self, q: &Coordinates) -> f64 {
        q.x.powi(2) + q.y.powi(2) - 1.0
    }

    #[holonomic]
    fn again(&self, q: &Coordinates) -> f64 {
        q.x.powi(2) + q.y.powi(2) - self.square
    }
}

#[test]
fn contradictory_constraints_are_named_by_all_that_look_for_a_state() {
    let (system, guess) = (Twice { square: 2.0 }, State::at_rest([0.6, 0.9]));
    let expected = Cause::Contradictory { constraint: 1, name: Name::new(&"again") };
    assert_eq!(system.consistent(guess).unwrap_err().cause, expected);
    assert_eq!(system.equilibrium(guess, &[]).unwrap_err(), EquilibriumError::Constraints(expected));
    assert_eq!(system.stationary_point(guess, &[]).unwrap_err(), EquilibriumError::Constraints(expected));
    // With the same radius they are no contradiction.
    let rest = Twice { square: 1.0 }.equilibrium(guess, &[]).unwrap();
    assert!((rest.state.q[1] + 1.0).abs() < 1e-12 && !rest.are_unique);
}

#[test]
fn a_constraint_with_a_parameter_that_is_no_number_is_not_finite() {
    let (system, start) = (Twice { square: f64::NAN }, State::new([0.6, 0.8], [0.8, -0.6]));
    assert_eq!(system.consistent(start).unwrap_err().cause, Cause::NotFinite);
    assert_eq!(system.simulate(start).advance_to(1.0).unwrap_err().cause, Cause::NotFinite);
    let mut dop853 = system.simulate_with::<Dop853>(start);
    assert_eq!(dop853.advance_to(1.0).unwrap_err().cause, Cause::NotFinite);
    assert_eq!(system.stepper::<Rk4>(start).step(0.1, &[]).unwrap_err().cause, Cause::NotFinite);
    let nowhere = EquilibriumError::Constraints(Cause::NotFinite);
    assert_eq!(system.equilibrium(start, &[]).unwrap_err(), nowhere);
}

/// Two lines that cross, as one constraint.
struct Cross;

#[lagrangian(coordinates = [x, y], jacobians)]
impl Cross {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[holonomic]
    fn lines(&self, q: &Coordinates) -> f64 {
        (q.x - q.y) * q.x
    }
}

#[test]
fn vanishing_gradients_are_named_by_everything() {
    let state = State::at_rest([0.0, 0.0]);
    let expected = Cause::VanishingGradient { constraint: 0, name: Name::new(&"lines") };
    assert_eq!(Cross.accelerations(&state).unwrap_err().cause, expected);
    assert_eq!(Cross.reactions(&state).unwrap_err().cause, expected);
    assert_eq!(Cross.consistent(state).unwrap_err().cause, expected);
    assert_eq!(Cross.simulate(state).advance_to(1.0).unwrap_err().cause, expected);
    assert_eq!(Cross.simulate(state).every(0.1).next().unwrap().unwrap_err().cause, expected);
    assert_eq!(Cross.stepper::<Rk4>(state).step(0.1, &[]).unwrap_err().cause, expected);
    assert_eq!(Cross.jacobians(&state, &[]).unwrap_err().cause, expected);
    assert_eq!(Cross.response(&state, &[]).unwrap_err().cause, expected);
    assert_eq!(Cross.linearize(&state, &[]).unwrap_err().cause, expected);
    assert_eq!(Cross.modes(&state, &[]).unwrap_err().cause, expected);
    assert_eq!(Cross.inverse_dynamics(&state, &[0.0; 2]).unwrap_err().cause, expected);
    assert_eq!(Cross.equilibrium(state, &[]).unwrap_err(), EquilibriumError::Constraints(expected));
    assert_eq!(Cross.stationary_point(state, &[]).unwrap_err(), EquilibriumError::Constraints(expected));
}

/// A rod by the distance to its pivot, where that distance has no gradient.
struct Rod;

#[lagrangian(coordinates = [x, y], jacobians)]
impl Rod {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - 1.0
    }
}

#[test]
fn the_centre_of_a_distance_is_named_by_everything() {
    let state = State::at_rest([0.0, 0.0]);
    let expected = Cause::VanishingGradient { constraint: 0, name: Name::new(&"rod") };
    assert_eq!(Rod.accelerations(&state).unwrap_err().cause, expected);
    assert_eq!(Rod.reactions(&state).unwrap_err().cause, expected);
    assert_eq!(Rod.consistent(state).unwrap_err().cause, expected);
    assert_eq!(Rod.simulate(state).advance_to(1.0).unwrap_err().cause, expected);
    assert_eq!(Rod.simulate_with::<Dop853>(state).advance_to(1.0).unwrap_err().cause, expected);
    assert_eq!(Rod.stepper::<Rk4>(state).step(0.1, &[]).unwrap_err().cause, expected);
    assert_eq!(Rod.linearize(&state, &[]).unwrap_err().cause, expected);
    assert_eq!(Rod.equilibrium(state, &[]).unwrap_err(), EquilibriumError::Constraints(expected));
    // Where a number of the state is none, that is what is wrong.
    let bad = State::at_rest([f64::NAN, 0.0]);
    assert_eq!(Rod.simulate(bad).advance_to(1.0).unwrap_err().cause, Cause::NotFinite);
}

/// A bead at a distance, and one at a square of a distance, that may be below zero.
struct Negative {
    length: f64,
    square: f64,
}

#[lagrangian(coordinates = [x, y, s], jacobians)]
impl Negative {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[point(mass = 1.0)]
    fn slider(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.s, 0.0)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - self.length
    }

    #[holonomic]
    fn parabola(&self, q: &Coordinates) -> f64 {
        q.s.powi(2) - self.square
    }
}

#[test]
fn a_constraint_that_no_state_meets_is_named_where_a_search_ends_without_a_gradient() {
    let (rod, parabola) = (Name::new(&"rod"), Name::new(&"parabola"));
    let bad = [((-1.0, 1.0), 0, rod), ((1.0, -1.0), 1, parabola), ((-0.1, 1.0), 0, rod)];
    for ((length, square), index, which) in bad {
        let system = Negative { length, square };
        for guess in [[0.6, -0.8, 1.0], [0.3, 0.1, 0.4], [-2.0, 0.0, -3.0], [0.0, 1e-3, 1e-3]] {
            let guess = State::at_rest(guess);
            let is_named = |cause: &Cause| {
                matches!(*cause, Cause::NoConsistentState { constraint, name, .. }
                    if constraint == index && name == which)
            };
            let error = system.consistent(guess).unwrap_err();
            assert!(is_named(&error.cause), "{which:?} {guess:?}: {error:?}");
            for found in [system.equilibrium(guess, &[]), system.stationary_point(guess, &[])] {
                let error = found.unwrap_err();
                let is_right = matches!(&error, EquilibriumError::Constraints(cause) if is_named(cause));
                assert!(is_right, "{which:?} {guess:?}: {error:?}");
            }
        }
    }
}
