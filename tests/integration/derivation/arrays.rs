//! Arrays of coordinates, points and masses: order, sharing, and the chain whose M and b are known.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};
use crate::support::difference::slope;
use crate::support::identities::model;
use crate::support::sample::Samples;

const LINKS: usize = 5;

struct Chain {
    m: [f64; LINKS],
    l: [f64; LINKS],
    g: f64,
}

#[lagrangian(coordinates = [theta: [5]])]
impl Chain {
    #[point(mass = self.m[..])]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 5] {
        let mut joints = [Vector2::zeros(); 5];
        let mut end = Vector2::zeros();
        for i in 0..5 {
            end += self.l[i] * Vector2::new(q.theta[i].sin(), -q.theta[i].cos());
            joints[i] = end;
        }
        joints
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.joints(q).iter().enumerate().map(|(i, joint)| self.m[i] * self.g * joint.y).sum()
    }
}

const CHAIN: Chain = Chain { m: [1.0, 0.5, 2.0, 0.3, 0.7], l: [0.4, 1.1, 0.6, 0.9, 0.5], g: 9.81 };

/// The mass that link `i` and those after it carry.
fn carried(i: usize) -> f64 {
    CHAIN.m[i..].iter().sum()
}

#[test]
fn the_mass_matrix_of_a_chain_is_the_textbooks() {
    let state: State<f64, LINKS> = Samples::new(1).state(-3.0, 3.0);
    let mass = CHAIN.mass_matrix(&state);
    for i in 0..LINKS {
        for j in 0..LINKS {
            let expected = CHAIN.l[i] * CHAIN.l[j] * carried(i.max(j)) * (state.q[i] - state.q[j]).cos();
            close(mass[(i, j)], expected, 1e-14);
        }
    }
}

#[test]
fn the_bias_of_a_chain_is_the_textbooks() {
    let state: State<f64, LINKS> = Samples::new(2).state(-3.0, 3.0);
    let expected: [f64; LINKS] = std::array::from_fn(|i| {
        let inertia = |j: usize| {
            CHAIN.l[i] * CHAIN.l[j] * carried(i.max(j)) * (state.q[i] - state.q[j]).sin() * state.v[j].powi(2)
        };
        (0..LINKS).map(inertia).sum::<f64>() + CHAIN.g * CHAIN.l[i] * carried(i) * state.q[i].sin()
    });
    all_close(CHAIN.bias(&state), expected, 1e-13);
}

#[test]
fn the_identities_hold_for_a_chain() {
    model!(CHAIN).holds(-1.0, 1.0);
}

#[test]
fn the_energies_are_the_users_own_functions() {
    let mut samples = Samples::new(3);
    for _ in 0..10 {
        let state: State<f64, LINKS> = samples.state(-3.0, 3.0);
        let joints = |x: f64| {
            CHAIN.joints(&ChainCoordinates::from(std::array::from_fn(|i| state.q[i] + x * state.v[i])))
        };
        close(CHAIN.potential_energy(&state), CHAIN.gravity(&state.q.into()), 1e-14);
        let speeds = |i: usize, axis: usize| slope(0.005, |x| joints(x)[i][axis]);
        let kinetic: f64 =
            (0..LINKS).map(|i| 0.5 * CHAIN.m[i] * (speeds(i, 0).powi(2) + speeds(i, 1).powi(2))).sum();
        close(CHAIN.kinetic_energy(&state), kinetic, 1e-11);
        close(CHAIN.energy(&state), CHAIN.kinetic_energy(&state) + CHAIN.potential_energy(&state), 1e-14);
    }
}

/// Scalars before, between and after arrays.
struct Mixed;

#[lagrangian(coordinates = [x, theta: [3], y, z: [1]])]
impl Mixed {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        let [a, b, c] = v.theta;
        0.5 * (v.x.powi(2)
            + 2.0 * a * a
            + 3.0 * b * b
            + 4.0 * c * c
            + 5.0 * v.y.powi(2)
            + 6.0 * v.z[0].powi(2))
    }

    #[potential]
    fn slope(&self, q: &Coordinates) -> f64 {
        10.0 * q.x + 20.0 * q.theta[0] + 30.0 * q.theta[1] + 40.0 * q.theta[2] + 50.0 * q.y + 60.0 * q.z[0]
    }
}

#[test]
fn arrays_are_flattened_in_the_order_of_declaration() {
    let state = State::new([0.0; 6], [1.0; 6]);
    assert_eq!(Mixed.momenta(&state), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!(Mixed.bias(&state), [10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
    all_close(Mixed.accelerations(&state).unwrap(), [-10.0; 6], 1e-15);
}

#[test]
fn records_and_arrays_convert_into_each_other() {
    let record = MixedCoordinates::from([1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!((record.x, record.theta, record.y, record.z), (1.0, [2.0, 3.0, 4.0], 5.0, [6.0]));
    assert_eq!(<[f64; 6]>::from(record), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    let velocities = MixedVelocities { x: 1.0, theta: [0.0; 3], y: 0.0, z: [2.0] };
    let state = State::new(record, velocities);
    assert_eq!(state, State::new([1.0, 2.0, 3.0, 4.0, 5.0, 6.0], [1.0, 0.0, 0.0, 0.0, 0.0, 2.0]));
    assert_eq!(
        format!("{record:?}"),
        "MixedCoordinates { x: 1.0, theta: [2.0, 3.0, 4.0], y: 5.0, z: [6.0] }"
    );
}

/// Particles on lines, in planes and in space; one function for several.
struct Dimensions {
    m: [f64; 2],
}

#[lagrangian(coordinates = [x, y])]
impl Dimensions {
    #[point(mass = 3.0)]
    fn number(&self, q: &Coordinates) -> f64 {
        q.x
    }

    #[point(mass = 4.0)]
    fn line(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(2.0 * q.y)
    }

    #[point(mass = self.m[..])]
    fn plane(&self, q: &Coordinates) -> [Point2<f64>; 2] {
        [Point2::new(q.x, q.y), Point2::new(q.x + q.y, 0.0)]
    }

    #[point(mass = 1.0)]
    fn space(&self, q: &Coordinates) -> [Vector3<f64>; 2] {
        [Vector3::new(q.x, q.x, q.x), Vector3::z() * q.y]
    }
}

#[test]
fn particles_of_any_dimension_add_their_inertia() {
    let system = Dimensions { m: [10.0, 100.0] };
    let state = State::new([0.3, 0.4], [1.0, 2.0]);
    let expected = [[3.0 + 10.0 + 100.0 + 3.0, 100.0], [100.0, 16.0 + 10.0 + 100.0 + 1.0]];
    assert_eq!(system.mass_matrix(&state), expected.into());
    assert_eq!(system.accelerations(&state).unwrap(), [0.0, 0.0]);
}
