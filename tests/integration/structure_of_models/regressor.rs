//! Lumped parameters.

use lagrangian::prelude::*;

use super::CLOSED_FORM;
use crate::support::close::close_on;
use crate::support::sample::Samples;

/// A double pendulum of bars with motors at its joints and a spring at its elbow.
struct Arm {
    m: [f64; 2],
    l: [f64; 2],
    centre: [f64; 2],
    inertia: [f64; 2],
    stiffness: f64,
    g: f64,
}

#[lagrangian(coordinates = [theta: [2]], inputs = [torque: [2]], analysis)]
impl Arm {
    fn direction(angle: f64) -> Vector2<f64> {
        Vector2::new(angle.sin(), -angle.cos())
    }

    #[body(mass = self.m[0], inertia = self.inertia[0])]
    fn upper(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (self.centre[0] * Self::direction(q.theta[0]), q.theta[0])
    }

    #[body(mass = self.m[1], inertia = self.inertia[1])]
    fn lower(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        let elbow = self.l[0] * Self::direction(q.theta[0]);
        (elbow + self.centre[1] * Self::direction(q.theta[0] + q.theta[1]), q.theta[0] + q.theta[1])
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.g * (self.m[0] * self.upper(q).0.y + self.m[1] * self.lower(q).0.y)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.theta[1].powi(2)
    }

    #[force]
    fn motors(&self, u: &Inputs) -> [f64; 2] {
        u.torque
    }
}

const ARM: Arm =
    Arm { m: [1.2, 0.7], l: [0.9, 0.6], centre: [0.5, 0.3], inertia: [0.11, 0.05], stiffness: 3.0, g: 9.81 };

#[test]
fn the_regressor_times_the_lumped_parameters_is_the_equations() {
    let mut samples = Samples::new(12);
    for _ in 0..20 {
        let state: State<f64, 2> = samples.state(-1.5, 1.5);
        let a = [samples.number(-2.0, 2.0), samples.number(-2.0, 2.0)];
        let lumped = SVector::from(ARM.lumped_parameters());
        let found = ARM.regressor(&state, &a) * lumped;
        let expected = ARM.mass_matrix(&state) * SVector::from(a) + SVector::from(ARM.bias(&state));
        for i in 0..2 {
            close_on(20.0, found[i], expected[i], CLOSED_FORM);
        }
    }
}

#[test]
fn what_cannot_be_told_apart_is_lumped_together() {
    // Inertia about the shoulder, of both bars; about the elbow; their coupling; two weights; the spring.
    assert_eq!(Arm::REGRESSOR.len(), ARM.lumped_parameters().len());
    assert_eq!(Arm::REGRESSOR.len(), 6, "{:?}", Arm::REGRESSOR);
    for (name, value) in Arm::REGRESSOR.into_iter().zip(ARM.lumped_parameters()) {
        assert!(!name.is_empty() && value > 0.0);
    }
    assert!(Arm::REGRESSOR.contains(&"stiffness"), "{:?}", Arm::REGRESSOR);
}

/// A frequency within a sine is no factor.
struct Shaken {
    mass: f64,
    frequency: f64,
}

#[lagrangian(coordinates = [x], analysis)]
impl Shaken {
    #[point(mass = self.mass)]
    fn block(&self, q: &Coordinates, t: f64) -> Vector1<f64> {
        Vector1::new(q.x + (self.frequency * t).sin())
    }
}

#[test]
fn a_system_without_lumped_parameters_still_has_everything_else() {
    // `Shaken::REGRESSOR` does not exist: the frequency does not enter linearly.
    let shaken = Shaken { mass: 2.0, frequency: 3.0 };
    assert_eq!(Shaken::CONSERVED, ["momentum of x"]);
    shaken.verify().unwrap();
    assert_eq!(ARM.verify().map(|passed| passed.states), Ok(12));
}
