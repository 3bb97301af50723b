//! Planted mistakes.

extern crate std;
use std::string::ToString;

use super::*;
use nalgebra::{Isometry3, Rotation3, UnitQuaternion, Vector3};

/// A pendulum of unit mass and length with one number wrong, in any units. Its coordinate is a length.
#[derive(Clone, Copy)]
struct Pendulum {
    /// The units of mass, length and time.
    units: [f64; 3],
    inertia: f64,
    weight: f64,
    acceleration: f64,
    power: f64,
}

const RIGHT: Pendulum =
    Pendulum { units: [1.0; 3], inertia: 1.0, weight: 9.81, acceleration: -9.81, power: 0.0 };

impl Pendulum {
    /// The state in units of its own.
    fn state(&self, state: &State<f64, 1>) -> State<f64, 1> {
        let [_, length, time] = self.units;
        State { t: state.t / time, q: state.q.map(|q| q / length), v: state.v.map(|v| v / length * time) }
    }

    fn unit_of_energy(&self) -> f64 {
        let [mass, length, time] = self.units;
        mass * (length / time).powi(2)
    }

    fn kinetic(&self, state: &State<f64, 1>) -> f64 {
        0.5 * self.inertia * self.state(state).v[0].powi(2) * self.unit_of_energy()
    }

    fn potential(&self, state: &State<f64, 1>, weight: f64) -> f64 {
        -weight * self.state(state).q[0].cos() * self.unit_of_energy()
    }
}

impl System<1> for Pendulum {
    type Scalar = f64;
    type Method = crate::Dop853;
    type Constants = ();
    fn constants(&self) {}
    fn accelerations_at(&self, _: &(), _: f64, q: &[f64; 1], _: &[f64; 1], _: &[f64; 0]) -> [f64; 1] {
        let [_, length, time] = self.units;
        [self.acceleration * (q[0] / length).sin() * length / time / time]
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
        [[self.inertia * self.units[0]]]
    }
    fn coriolis_at(&self, _: &State<f64, 1>) -> Option<[[f64; 1]; 1]> {
        Some([[0.0]])
    }
    fn momenta_at(&self, state: &State<f64, 1>) -> [f64; 1] {
        [self.inertia * self.units[0] * state.v[0]]
    }
    fn integral_at(&self, state: &State<f64, 1>) -> f64 {
        self.kinetic(state) + self.potential(state, self.weight)
    }
    fn integral_rate_at(&self, _: &State<f64, 1>, _: &[f64; 0]) -> Option<f64> {
        Some(self.power * self.unit_of_energy() / self.units[2])
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
        Some([self.kinetic(state), self.potential(state, self.weight)])
    }
    fn described_at(&self, state: &State<f64, 1>, time: f64) -> Described<f64> {
        let bob = |x: f64| {
            let length = self.units[1];
            let (sin, cos) = ((state.q[0] + x * state.v[0]) / length).sin_cos();
            nalgebra::Vector2::new(sin, -cos) * length
        };
        let (kinetic, uncertainty) = kinetic(bob, time, self.units[0], [[0.0; 3]; 3]);
        Described { kinetic, potential: self.potential(state, 9.81), lagrangian: 0.0, uncertainty }
    }
}

#[test]
fn a_right_model_has_a_certificate() {
    let passed = verify(&RIGHT).unwrap();
    assert_eq!(passed.states, 12);
    assert!(passed.worst < 0.1 && passed.comparisons > 70, "{passed:?}");
}

/// A pendulum of everyday life, an atom in a bond, a moon.
const UNITS: [[f64; 3]; 3] = [[1.0; 3], [6.6e-26, 3e-10, 1e-12], [7e22, 4e8, 4e5]];

#[test]
fn a_wrong_number_is_found_and_named() {
    for units in UNITS {
        let right = Pendulum { units, ..RIGHT };
        for (wrong, identity) in [
            (Pendulum { inertia: -1.0, ..right }, Identity::PositiveInertia),
            (Pendulum { inertia: 1.00001, acceleration: -9.81 / 1.00001, ..right }, Identity::KineticEnergy),
            (Pendulum { weight: 9.8101, acceleration: -9.8101, ..right }, Identity::PotentialEnergy),
            (Pendulum { acceleration: -9.8101, ..right }, Identity::LagrangesEquation { coordinate: 0 }),
            (Pendulum { power: 1e-4, ..right }, Identity::PowerBalance),
        ] {
            let [_, length, time] = units;
            let states = [[0.3, -0.8], [-0.7, 0.4], [0.9, 0.6]]
                .map(|[q, v]| State::new([length * q], [length / time * v]).at_time(0.4 * time));
            verify_at(&right, &states).unwrap();
            let violation = verify_at(&wrong, &states).unwrap_err();
            assert_eq!(violation.identity, identity, "{violation} in {units:?}");
            assert!(violation.by > violation.allowed && violation.to_string().contains("violated"));
        }
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
        kinetic(|x| (place(x), turn(x)), 1.0, 3.0, inertia),
        kinetic(|x| (place(x), UnitQuaternion::from(turn(x))), 1.0, 3.0, inertia),
        kinetic(|x| Isometry3::from_parts(place(x).into(), turn(x).into()), 1.0, 3.0, inertia),
    ];
    for (energy, doubt) in found {
        assert!((energy - expected).abs() < 1e-9 && doubt < 1e-8, "{energy} ± {doubt}, not {expected}");
    }
    let planar = [[0.7, 0.0, 0.0], [0.0; 3], [0.0; 3]];
    let place = |x: f64| nalgebra::Vector2::new(0.0, x);
    for energy in [
        kinetic(|x| (place(x), 2.0 * x + 1.0), 1.0, 1.0, planar).0,
        kinetic(|x| nalgebra::Isometry2::new(place(x), 2.0 * x + 3.1), 1.0, 1.0, planar).0,
    ] {
        assert!((energy - 0.5 - 0.5 * 0.7 * 4.0).abs() < 1e-9, "{energy}");
    }
}
