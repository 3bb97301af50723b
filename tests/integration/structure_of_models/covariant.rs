//! Christoffel symbols and Coriolis matrices: S16, and identities of any system.

use lagrangian::Name;
use lagrangian::prelude::*;

use super::{CLOSED_FORM, DIFFERENCES};
use crate::support::close::{all_close, close_on};
use crate::support::difference::{STEP, slope};
use crate::support::sample::Samples;

/// S16: a particle of unit mass in spherical coordinates.
struct Spherical;

#[lagrangian(coordinates = [r, phi, theta], analysis)]
impl Spherical {
    #[point(mass = 1.0)]
    fn particle(&self, q: &Coordinates) -> Vector3<f64> {
        let ((sin_phi, cos_phi), (sin_theta, cos_theta)) = (q.phi.sin_cos(), q.theta.sin_cos());
        q.r * Vector3::new(sin_phi * cos_theta, sin_phi * sin_theta, cos_phi)
    }
}

/// S16: in parabolic coordinates, of any mass.
struct Parabolic {
    mass: f64,
}

#[lagrangian(coordinates = [u, v, theta], analysis)]
impl Parabolic {
    #[point(mass = self.mass)]
    fn particle(&self, q: &Coordinates) -> Vector3<f64> {
        let (sin, cos) = q.theta.sin_cos();
        Vector3::new(q.u * q.v * cos, q.u * q.v * sin, 0.5 * (q.u.powi(2) - q.v.powi(2)))
    }
}

fn compare(found: [[[f64; 3]; 3]; 3], listed: &[([usize; 3], f64)]) {
    let mut expected = [[[0.0; 3]; 3]; 3];
    for &([k, i, j], value) in listed {
        (expected[k][i][j], expected[k][j][i]) = (value, value);
    }
    all_close(found.as_flattened().as_flattened(), expected.as_flattened().as_flattened(), CLOSED_FORM);
}

#[test]
fn spherical_symbols_are_those_of_the_textbook() {
    let mut samples = Samples::new(1);
    for _ in 0..20 {
        let state: State<f64, 3> = samples.state(0.3, 1.3);
        let [r, phi, _] = state.q;
        let second = Spherical.christoffel_second(&state).unwrap();
        let (sin, cos) = phi.sin_cos();
        compare(
            second,
            &[
                ([0, 1, 1], -r),
                ([0, 2, 2], -r * sin * sin),
                ([1, 0, 1], 1.0 / r),
                ([1, 2, 2], -0.5 * (2.0 * phi).sin()),
                ([2, 0, 2], 1.0 / r),
                ([2, 1, 2], cos / sin),
            ],
        );
    }
}

#[test]
fn parabolic_symbols_are_those_of_the_textbook() {
    let mut samples = Samples::new(2);
    for _ in 0..20 {
        let state: State<f64, 3> = samples.state(0.3, 1.3);
        let [u, v, _] = state.q;
        let s = u * u + v * v;
        let expected = [
            ([0, 0, 0], u / s),
            ([0, 0, 1], v / s),
            ([0, 1, 1], -u / s),
            ([0, 2, 2], -u * v * v / s),
            ([1, 0, 0], -v / s),
            ([1, 0, 1], u / s),
            ([1, 1, 1], v / s),
            ([1, 2, 2], -u * u * v / s),
            ([2, 0, 2], 1.0 / u),
            ([2, 1, 2], 1.0 / v),
        ];
        let system = Parabolic { mass: 1.7 };
        compare(system.christoffel_second(&state).unwrap(), &expected);
        // The first kind has the metric in it: M = m (s, s, u² v²).
        let scales = [1.7 * s, 1.7 * s, 1.7 * (u * v).powi(2)];
        let first = expected.map(|([k, i, j], value)| ([k, i, j], scales[k] * value));
        compare(system.christoffel_first(&state), &first);
    }
}

#[test]
fn a_singular_metric_is_an_error() {
    let error = Spherical.christoffel_second(&State::at_rest([1.0, 0.0, 0.0]).at_time(2.0)).unwrap_err();
    let name = Name::new(&Spherical::NAMES.coordinates[2]);
    assert_eq!(error, MotionError { cause: Cause::SingularMassMatrix { pivot: 2, name }, t: 2.0 });
}

/// A double pendulum that a motor turns about the vertical, its support on a lift: M, T₁ and T₀ depend on
/// everything.
struct Carried {
    m: [f64; 2],
    l: [f64; 2],
    rate: f64,
    growth: f64,
}

#[lagrangian(coordinates = [theta: [2], x], analysis)]
impl Carried {
    fn arm(&self, q: &Coordinates, t: f64) -> f64 {
        q.x + self.l[0] * (1.0 + self.growth * t) * q.theta[0].sin()
    }

    fn in_space(&self, out: f64, up: f64, t: f64) -> Vector3<f64> {
        let (sin, cos) = (self.rate * t).sin_cos();
        Vector3::new(out * cos, out * sin, up + 0.3 * (2.0 * t).sin())
    }

    #[point(mass = self.m[0])]
    fn upper(&self, q: &Coordinates, t: f64) -> Vector3<f64> {
        self.in_space(self.arm(q, t), -self.l[0] * (1.0 + self.growth * t) * q.theta[0].cos(), t)
    }

    #[point(mass = self.m[1])]
    fn lower(&self, q: &Coordinates, t: f64) -> Vector3<f64> {
        let out = self.arm(q, t) + self.l[1] * q.theta[1].sin();
        let down = self.l[0] * (1.0 + self.growth * t) * q.theta[0].cos() + self.l[1] * q.theta[1].cos();
        self.in_space(out, -down, t)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        4.0 * q.x.powi(2)
    }

    #[lagrangian]
    fn field(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        (0.4 + t) * (q.theta[1].sin() * v.x - q.x * q.theta[0] * v.theta[1])
    }
}

const CARRIED: Carried = Carried { m: [1.1, 0.7], l: [0.9, 1.3], rate: 1.7, growth: 0.4 };

#[test]
fn the_coriolis_matrix_makes_a_skew_difference() {
    let mut samples = Samples::new(3);
    for _ in 0..20 {
        let state: State<f64, 3> = samples.state(-1.0, 1.0);
        let coriolis = CARRIED.coriolis_matrix(&state);
        let gyroscopic = CARRIED.gyroscopic_matrix(&state);
        for i in 0..3 {
            for j in 0..3 {
                let entry = |t: f64| {
                    let q = std::array::from_fn(|k| state.q[k] + t * state.v[k]);
                    CARRIED.mass_matrix(&State { q, ..state }.at_time(state.t + t))[(i, j)]
                };
                close_on(3.0, coriolis[(i, j)] + coriolis[(j, i)], slope(STEP, entry), DIFFERENCES);
                close_on(3.0, gyroscopic[(i, j)], -gyroscopic[(j, i)], CLOSED_FORM);
            }
        }
        // Without the change of M in time, the matrix is the contraction of the symbols.
        let first = CARRIED.christoffel_first(&state);
        for k in 0..3 {
            for j in 0..3 {
                let explicit = |t: f64| CARRIED.mass_matrix(&state.at_time(state.t + t))[(k, j)];
                let contracted: f64 = (0..3).map(|i| first[k][i][j] * state.v[i]).sum();
                let expected = contracted + 0.5 * slope(STEP, explicit);
                close_on(3.0, coriolis[(k, j)], expected, DIFFERENCES);
            }
        }
    }
}

#[test]
fn inertia_forces_add_up_to_the_bias() {
    let mut samples = Samples::new(4);
    for _ in 0..20 {
        let state: State<f64, 3> = samples.state(-1.0, 1.0);
        let a: [f64; 3] = std::array::from_fn(|_| samples.number(-2.0, 2.0));
        let forces = CARRIED.inertia_forces(&state, &a);
        let (mass, bias) = (CARRIED.mass_matrix(&state), CARRIED.bias(&state));
        let relative = mass * SVector::from(a);
        let spring = [0.0, 0.0, 8.0 * state.q[2]];
        for i in 0..3 {
            close_on(10.0, forces.relative[i], -relative[i], CLOSED_FORM);
            close_on(10.0, forces.total()[i], -relative[i] - bias[i] + spring[i], CLOSED_FORM);
        }
        let work: f64 = (0..3).map(|i| forces.gyroscopic[i] * state.v[i]).sum();
        close_on(10.0, work, 0.0, CLOSED_FORM);
        let gyroscopic = CARRIED.gyroscopic_matrix(&state) * state.velocities();
        for i in 0..3 {
            close_on(10.0, forces.gyroscopic[i], -gyroscopic[i], CLOSED_FORM);
        }
    }
}

#[test]
fn parts_of_the_kinetic_energy_are_homogeneous() {
    let mut samples = Samples::new(5);
    for _ in 0..20 {
        let state: State<f64, 3> = samples.state(-1.0, 1.0);
        let (t2, t1, t0) = CARRIED.kinetic_energy_parts(&state);
        let doubled = State { v: state.v.map(|v| 2.0 * v), ..state };
        let (d2, d1, d0) = CARRIED.kinetic_energy_parts(&doubled);
        all_close([d2, d1, d0], [4.0 * t2, 2.0 * t1, t0], CLOSED_FORM);
        let jacobi = CARRIED.jacobi_integral(&state);
        close_on(10.0, t2 - t0 + CARRIED.potential_energy(&state), jacobi, CLOSED_FORM);
    }
}

#[test]
fn certificates_are_given() {
    Spherical.verify().unwrap();
    Parabolic { mass: 1.7 }.verify().unwrap();
    CARRIED.verify().unwrap();
}
