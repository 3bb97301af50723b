//! Planted mistakes.

extern crate std;
use std::string::ToString;

use super::*;
use nalgebra::{Isometry3, Rotation3, UnitQuaternion, Vector3};

/// A pendulum of unit mass and length with one number wrong.
#[derive(Clone, Copy)]
struct Pendulum {
    inertia: f64,
    weight: f64,
    acceleration: f64,
    power: f64,
}

const RIGHT: Pendulum = Pendulum { inertia: 1.0, weight: 9.81, acceleration: -9.81, power: 0.0 };

impl System<1> for Pendulum {
    type Scalar = f64;
    type Method = crate::Dop853;
    type Constants = ();
    fn constants(&self) {}
    fn accelerations_at(&self, _: &(), _: f64, q: &[f64; 1], _: &[f64; 1], _: &[f64; 0]) -> [f64; 1] {
        [self.acceleration * q[0].sin()]
    }
    fn energy_at(&self, _: &(), t: f64, q: &[f64; 1], v: &[f64; 1]) -> f64 {
        self.integral_at(&State { t, q: *q, v: *v })
    }
}

impl Verifiable<1> for Pendulum {
    const CONSERVED: usize = 1;
    const CONSTRAINTS: usize = 0;
    const DEFINITE: bool = true;
    fn nearest_at(&self, state: &State<f64, 1>) -> Option<State<f64, 1>> {
        Some(*state)
    }
    fn mass_at(&self, _: &State<f64, 1>) -> [[f64; 1]; 1] {
        [[self.inertia]]
    }
    fn coriolis_at(&self, _: &State<f64, 1>) -> Option<[[f64; 1]; 1]> {
        Some([[0.0]])
    }
    fn momenta_at(&self, state: &State<f64, 1>) -> [f64; 1] {
        [self.inertia * state.v[0]]
    }
    fn integral_at(&self, state: &State<f64, 1>) -> f64 {
        0.5 * self.inertia * state.v[0].powi(2) - self.weight * state.q[0].cos()
    }
    fn integral_rate_at(&self, _: &State<f64, 1>, _: &[f64; 0]) -> Option<f64> {
        Some(self.power)
    }
    fn driven_at(&self, state: &State<f64, 1>, u: &[f64; 0]) -> Option<Driven<f64, 1>> {
        let accelerations = self.accelerations_at(&(), 0.0, &state.q, &state.v, u);
        Some(Driven { accelerations, loads: [0.0] })
    }
    fn conserved_at(&self, state: &State<f64, 1>, _: usize) -> f64 {
        self.integral_at(state)
    }
    fn constraint_at(&self, _: &State<f64, 1>, _: usize) -> f64 {
        0.0
    }
    fn gradient_at(&self, _: &State<f64, 1>, _: usize) -> [f64; 1] {
        [0.0]
    }
    fn is_holonomic(_: usize) -> bool {
        true
    }
    fn energies_at(&self, state: &State<f64, 1>) -> Option<[f64; 2]> {
        Some([0.5 * self.inertia * state.v[0].powi(2), -self.weight * state.q[0].cos()])
    }
    fn described_at(&self, state: &State<f64, 1>) -> Described<f64> {
        let bob = |x: f64| {
            let (sin, cos) = (state.q[0] + x * state.v[0]).sin_cos();
            nalgebra::Vector2::new(sin, -cos)
        };
        let (kinetic, uncertainty) = kinetic(bob, 1.0, [[0.0; 3]; 3]);
        Described { kinetic, potential: -9.81 * state.q[0].cos(), lagrangian: 0.0, uncertainty }
    }
}

#[test]
fn a_right_model_has_a_certificate() {
    let passed = verify(&RIGHT).unwrap();
    assert_eq!(passed.states, 12);
    assert!(passed.worst < 0.1 && passed.comparisons > 70, "{passed:?}");
}

#[test]
fn a_wrong_number_is_found_and_named() {
    for (wrong, identity) in [
        (Pendulum { inertia: -1.0, ..RIGHT }, Identity::PositiveInertia),
        (Pendulum { inertia: 1.00001, acceleration: -9.81 / 1.00001, ..RIGHT }, Identity::KineticEnergy),
        (Pendulum { weight: 9.8101, acceleration: -9.8101, ..RIGHT }, Identity::PotentialEnergy),
        (Pendulum { acceleration: -9.8101, ..RIGHT }, Identity::LagrangesEquation { coordinate: 0 }),
        (Pendulum { power: 1e-4, ..RIGHT }, Identity::PowerBalance),
    ] {
        let violation = verify(&wrong).unwrap_err();
        assert_eq!(violation.identity, identity, "{violation}");
        assert!(violation.by > violation.allowed && violation.to_string().contains("violated"));
    }
}

#[test]
fn states_outside_the_domain_are_no_evidence() {
    let violation = verify_at(&RIGHT, &[State::new([f64::NAN], [0.0])]).unwrap_err();
    assert_eq!(violation.identity, Identity::Domain);
    assert_eq!(verify_at(&RIGHT, &[]).unwrap_err().identity, Identity::Domain);
}

#[test]
fn poses_of_any_type_have_the_energy_of_the_textbook() {
    let inertia = [[1.0, 0.1, 0.0], [0.1, 2.0, 0.2], [0.0, 0.2, 2.5]];
    let axis = Vector3::new(0.3, -0.5, 0.8);
    let turn = |x: f64| Rotation3::new(Vector3::new(0.4, 0.2, -0.1)) * Rotation3::new(axis * x);
    let place = |x: f64| Vector3::new(x, 2.0 * x, 0.5);
    let tensor = nalgebra::Matrix3::from_fn(|i, j| inertia[i][j]);
    let expected = 0.5 * 3.0 * 5.0 + 0.5 * (axis.transpose() * tensor * axis)[0];
    let found = [
        kinetic(|x| (place(x), turn(x)), 3.0, inertia),
        kinetic(|x| (place(x), UnitQuaternion::from(turn(x))), 3.0, inertia),
        kinetic(|x| Isometry3::from_parts(place(x).into(), turn(x).into()), 3.0, inertia),
    ];
    for (energy, doubt) in found {
        assert!((energy - expected).abs() < 1e-9 && doubt < 1e-8, "{energy} ± {doubt}, not {expected}");
    }
    let planar = [[0.7, 0.0, 0.0], [0.0; 3], [0.0; 3]];
    let place = |x: f64| nalgebra::Vector2::new(0.0, x);
    for energy in [
        kinetic(|x| (place(x), 2.0 * x + 1.0), 1.0, planar).0,
        kinetic(|x| nalgebra::Isometry2::new(place(x), 2.0 * x + 3.1), 1.0, planar).0,
    ] {
        assert!((energy - 0.5 - 0.5 * 0.7 * 4.0).abs() < 1e-9, "{energy}");
    }
}
