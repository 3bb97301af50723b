//! C03: a free rigid body, by T in z-x-z Euler angles and as a spatial body.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, EASY};
use crate::support::close::{all_close, between, close, close_on};
use crate::support::difference::rate;
use crate::support::motion::{TIGHT, drift, root, state_at};
use crate::support::reference::classical;
use crate::support::sample::Samples;

/// T from the body rates.
struct ByRates {
    inertia: [f64; 3],
}

#[lagrangian(coordinates = [phi, theta, psi])]
impl ByRates {
    fn rates(q: &Coordinates, v: &Velocities) -> [f64; 3] {
        let ((sin_theta, cos_theta), (sin_psi, cos_psi)) = (q.theta.sin_cos(), q.psi.sin_cos());
        [
            v.phi * sin_theta * sin_psi + v.theta * cos_psi,
            v.phi * sin_theta * cos_psi - v.theta * sin_psi,
            v.phi * cos_theta + v.psi,
        ]
    }

    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let [p, q, r] = Self::rates(q, v);
        let [a, b, c] = self.inertia;
        0.5 * (a * p * p + b * q * q + c * r * r)
    }
}

/// A body that turns about its fixed centre of mass.
struct Turning {
    inertia: [f64; 3],
}

#[lagrangian(coordinates = [phi, theta, psi])]
impl Turning {
    #[body(mass = 1.0, inertia = self.inertia)]
    fn top(&self, q: &Coordinates) -> (Vector3<f64>, Rotation3<f64>) {
        let attitude = Rotation3::from_axis_angle(&Vector3::z_axis(), q.phi)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.theta)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.psi);
        (Vector3::zeros(), attitude)
    }
}

const MOMENTS: [f64; 3] = [1.0, 2.0, 3.0];
const RATES: ByRates = ByRates { inertia: MOMENTS };
const TURNING: Turning = Turning { inertia: MOMENTS };

/// At φ = ψ = 0 and θ = 1 the body rates are (θ′, φ′ sin θ, ψ′ + φ′ cos θ) = (1, 0, 1.2).
fn start() -> State<f64, 3> {
    State::new([0.0, 1.0, 0.0], [0.0, 1.0, 1.2])
}

fn rates(state: &State<f64, 3>) -> [f64; 3] {
    ByRates::rates(&state.q.into(), &state.v.into())
}

/// The square of the angular momentum.
fn momentum_squared(state: &State<f64, 3>) -> f64 {
    rates(state).iter().zip(MOMENTS).map(|(rate, moment)| (rate * moment).powi(2)).sum()
}

#[test]
fn rates_and_angles_agree_in_both_forms() {
    let reference = classical("C03_euler_top");
    for end in [state_at(&RATES, start(), 7.0), state_at(&TURNING, start(), 7.0)] {
        all_close(rates(&end), reference.numbers::<3>("w(7)"), EASY);
        all_close(end.q, reference.numbers::<3>("euler_angles(7)"), EASY);
    }
    all_close(rates(&start()), reference.numbers::<3>("w0"), 1e-15);
}

#[test]
fn the_body_rates_are_periodic() {
    let expected = classical("C03_euler_top").number("period_of_w");
    // Euler's equation for the middle axis: 2 q′ = (3 − 1) r p.
    let middle = |state: &State<f64, 3>| {
        let [p, q, r] = rates(state);
        (q, p * r)
    };
    close(root(&RATES, start(), 5.5, middle), expected, EASY);
    close(root(&TURNING, start(), 5.5, middle), expected, EASY);
    let end = state_at(&TURNING, start(), expected);
    all_close(rates(&end), rates(&start()), EASY);
}

#[test]
fn energy_and_angular_momentum_have_the_given_values_and_stay() {
    let reference = classical("C03_euler_top");
    let energy = reference.number("E");
    for found in [RATES.energy(&start()), TURNING.energy(&start())] {
        close(found, energy, CLOSED_FORM);
    }
    close(momentum_squared(&start()), reference.number("L2"), CLOSED_FORM);
    let quantities = [&momentum_squared as &dyn Fn(&State<f64, 3>) -> f64, &|s| TURNING.energy(s)];
    for quantity in quantities {
        let mut motion = TURNING.simulate(start()).with_tolerance(TIGHT);
        between(-1.0, drift(&mut motion, 0.5, 40, quantity), 1e-11);
    }
}

#[test]
fn the_accelerations_satisfy_eulers_equations() {
    let mut samples = Samples::new(33);
    for _ in 0..20 {
        let state = samples.state(0.5, 2.5);
        let [p, q, r] = rates(&state);
        let [a, b, c] = MOMENTS;
        let expected = [(b - c) * q * r / a, (c - a) * r * p / b, (a - b) * p * q / c];
        for found in [RATES.accelerations(&state).unwrap(), TURNING.accelerations(&state).unwrap()] {
            let h = 0.002;
            for i in 0..3 {
                let slope = rate(h, &state, &found, |s| rates(s)[i]);
                // The terms of a slope are of order one.
                close_on(1.0, slope, expected[i], 1e-11);
            }
        }
    }
}

#[test]
fn both_forms_are_the_same_system() {
    let mut samples = Samples::new(34);
    for _ in 0..20 {
        let state = samples.state(0.5, 2.5);
        let found = RATES.accelerations(&state).unwrap();
        all_close(found, TURNING.accelerations(&state).unwrap(), 1e-11);
        all_close(RATES.momenta(&state), TURNING.momenta(&state), 1e-12);
        all_close(RATES.bias(&state), TURNING.bias(&state), 1e-12);
        all_close(RATES.mass_matrix(&state).as_slice(), TURNING.mass_matrix(&state).as_slice(), 1e-12);
    }
}
