//! Constraints that move: where nothing rests, and where a gradient turns under what it holds.

use std::f64::consts::PI;

use lagrangian::{Cause, EquilibriumError, Name, Stability, prelude::*};

use crate::support::close::{all_close, close};

const G: f64 = 9.81;

/// A bead on a hoop in space, whose plane has turned by an angle rate t + gain t².
struct Whirled {
    rate: f64,
    gain: f64,
}

#[lagrangian(coordinates = [x, y, z], jacobians)]
impl Whirled {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * q.z
    }

    #[holonomic]
    fn sphere(&self, q: &Coordinates) -> f64 {
        self.bead(q).norm() - 0.5
    }

    #[holonomic]
    fn plane(&self, q: &Coordinates, t: f64) -> f64 {
        let angle = self.rate * t + self.gain * t.powi(2);
        q.y * angle.cos() - q.x * angle.sin()
    }
}

const BOTTOM: [f64; 3] = [0.0, 0.0, -0.5];

#[test]
fn where_a_gradient_turns_frozen_equations_are_refused() {
    let name = Name::new(&"plane");
    // A plane that stands at this moment and begins to turn is refused as well.
    for (rate, gain, t) in
        [(6.0, 0.0, 0.0), (6.0, 0.0, 0.37), (-2.0, 0.0, 5.0), (0.0, 3.0, 0.0), (0.1, 1.0, 2.0)]
    {
        let hoop = Whirled { rate, gain };
        let state = State::at_rest(BOTTOM).at_time(t);
        let refused = Cause::TurningConstraint { constraint: 1, name };
        assert_eq!(hoop.modes(&state, &[]).unwrap_err().cause, refused, "{rate} {gain} {t}");
        assert_eq!(hoop.linearize(&state, &[]).unwrap_err().cause, refused, "{rate} {gain} {t}");
        let guess =
            hoop.consistent(State::at_rest([0.3 * (rate * t).cos(), 0.3 * (rate * t).sin(), -0.4])).unwrap();
        let found = hoop.equilibrium(guess.at_time(t), &[]);
        assert_eq!(
            found,
            Err(EquilibriumError::TurningConstraint { constraint: 1, name }),
            "{rate} {gain} {t}"
        );
        // The forces are balanced there; what that is worth is another question.
        let rest = hoop.stationary_point(state, &[]).unwrap();
        all_close(rest.state.q, BOTTOM, 1e-13);
        assert_eq!(rest.stability, Stability::Undecided);
    }
    let message = Whirled { rate: 6.0, gain: 0.0 }.equilibrium(BOTTOM, &[]).unwrap_err().to_string();
    assert!(message.contains("`plane` turns") && message.contains("monodromy"), "{message}");
}

#[test]
fn the_motion_of_a_turning_gradient_is_told_by_its_monodromy() {
    // In the plane φ̈ = (W² − g/R) φ, unstable above 4.43 rad/s.
    for rate in [6.0, 3.0] {
        let period = 2.0 * PI / rate;
        let hoop = Whirled { rate, gain: 0.0 };
        let found = hoop.variational().monodromy(State::at_rest(BOTTOM), period).unwrap().multipliers;
        let square = rate * rate - G / 0.5;
        let trace =
            if square > 0.0 { (square.sqrt() * period).cosh() } else { ((-square).sqrt() * period).cos() };
        close(found.iter().map(|multiplier| multiplier.re).sum(), 2.0 * trace, 1e-8);
    }
}

#[test]
fn a_gradient_that_stands_still_is_none_that_turns() {
    // A rate whose square is lost beside g/R, too.
    for rate in [0.0, 1e-9] {
        let hoop = Whirled { rate, gain: 0.0 };
        let rest = hoop.equilibrium([0.3, 0.0, -0.2], &[]).unwrap();
        assert_eq!(rest.stability, Stability::Stable);
        close(hoop.modes(&rest.state, &[]).unwrap()[0].frequency(), (G / 0.5).sqrt(), 1e-12);
    }
}

/// A ball on a table that rises and is written with a factor, beside a spring.
struct Table {
    height: f64,
    swing: f64,
    factor: f64,
}

#[lagrangian(coordinates = [x, z], jacobians)]
impl Table {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.z)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        G * q.z + 2.0 * q.x.powi(2)
    }

    #[holonomic]
    fn table(&self, q: &Coordinates, t: f64) -> f64 {
        (1.0 + self.factor * t.sin()) * (q.z - self.height - self.swing * (3.0 * t).cos())
    }
}

#[test]
fn nothing_rests_on_a_table_at_the_turning_point_of_its_motion() {
    let name = Name::new(&"table");
    for factor in [0.0, 0.5] {
        let table = Table { height: 0.2, swing: 0.1, factor };
        let moving = EquilibriumError::MovingConstraint { constraint: 0, name };
        assert_eq!(table.equilibrium([0.3, 0.0], &[]).unwrap_err(), moving);
        assert_eq!(table.stationary_point([0.3, 0.0], &[]).unwrap_err(), moving);
    }
}

#[test]
fn a_factor_of_a_constraint_moves_nothing() {
    for t in [0.0, 0.7, 1.5] {
        let table = Table { height: 0.2, swing: 0.0, factor: 0.5 };
        let rest = table.equilibrium(State::at_rest([0.3, 0.0]).at_time(t), &[]).unwrap();
        all_close(rest.state.q, [0.0, 0.2], 1e-14);
        assert_eq!(rest.stability, Stability::Stable);
        close(table.modes(&rest.state, &[]).unwrap()[0].frequency(), 2.0, 1e-13);
    }
}

/// A blade on a plane, tied to a place by a spring, that is turned from outside.
struct Blade {
    rate: f64,
    drift: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Blade {
    #[point(mass = 2.0)]
    fn blade(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        4.0 * (q.x.powi(2) + q.y.powi(2))
    }

    #[nonholonomic]
    fn holds(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        v.y * (self.rate * t).cos() - v.x * (self.rate * t).sin() - self.drift * q.y
    }
}

#[test]
fn a_constraint_on_velocities_turns_as_well() {
    let blade = Blade { rate: 1.5, drift: 0.0 };
    let rest = blade.stationary_point([0.3, 0.2], &[]).unwrap();
    assert_eq!(rest.stability, Stability::Undecided);
    let name = Name::new(&"holds");
    let refused = Cause::TurningConstraint { constraint: 0, name };
    assert_eq!(blade.modes(&rest.state, &[]).unwrap_err().cause, refused);
    let found = blade.equilibrium([0.3, 0.2], &[]);
    assert_eq!(found.unwrap_err(), EquilibriumError::TurningConstraint { constraint: 0, name });
    // One that drags along with the place does not.
    let steady = Blade { rate: 0.0, drift: 0.5 };
    let modes = steady.modes(&State::at_rest([0.0, 0.0]), &[]).unwrap();
    close(modes.last().unwrap().frequency(), 2.0, 1e-13);
}
