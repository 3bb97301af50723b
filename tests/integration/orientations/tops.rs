//! A free body and a heavy top against elliptic functions, through attitudes where Euler angles fail.

use lagrangian::prelude::*;

use super::elliptic::jacobi;
use crate::support::close::{all_close_on_largest, between, close_on};

struct Free {
    inertia: [f64; 3],
}

#[lagrangian(coordinates = [attitude: Rotation])]
impl Free {
    #[body(mass = 1.0, inertia = self.inertia)]
    fn body(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::identity(), q.attitude)
    }
}

/// Closed form of a free body with principal moments I₁ < I₂ < I₃ and L² > 2 E I₂ (Landau and Lifshitz,
/// *Mechanics*, § 37). The angular momentum points along z.
struct Euler {
    inertia: [f64; 3],
    momentum: f64,
    amplitudes: [f64; 3],
    rate: f64,
    parameter: f64,
}

impl Euler {
    fn new(inertia: [f64; 3], energy: f64, momentum: f64) -> Self {
        let ([a, b, c], square) = (inertia, momentum * momentum);
        let (low, high) = (2.0 * energy * c - square, square - 2.0 * energy * a);
        Self {
            inertia,
            momentum,
            amplitudes: [
                (low / (a * (c - a))).sqrt(),
                (low / (b * (c - b))).sqrt(),
                (high / (c * (c - a))).sqrt(),
            ],
            rate: ((c - b) * high / (a * b * c)).sqrt(),
            parameter: (b - a) * low / ((c - b) * high),
        }
    }

    /// Angular velocity in body axes.
    fn rates(&self, t: f64) -> Vector3<f64> {
        let [sn, cn, dn] = jacobi(self.rate * t, self.parameter);
        let [x, y, z] = self.amplitudes;
        Vector3::new(x * cn, y * sn, z * dn)
    }

    /// φ′ of the angles z, x, z.
    fn precession(&self, t: f64) -> f64 {
        let ([a, b, _], rates) = (self.inertia, self.rates(t));
        let (x, y) = (rates.x * rates.x, rates.y * rates.y);
        self.momentum * (a * x + b * y) / (a * a * x + b * b * y)
    }

    /// The orientation, with ∫ φ′ dt by Gauss–Legendre quadrature of order 10 on short intervals.
    fn orientation(&self, t: f64) -> UnitQuaternion<f64> {
        const NODES: [(f64, f64); 5] = [
            (0.0, 0.568_888_888_888_888_9),
            (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (0.906_179_845_938_664, 0.236_926_885_056_189_08),
            (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
        ];
        let (count, mut phi) = (4000, 0.0);
        let h = t / f64::from(count);
        for i in 0..count {
            let middle = h * (f64::from(i) + 0.5);
            phi +=
                NODES.map(|(x, w)| 0.5 * h * w * self.precession(middle + 0.5 * h * x)).iter().sum::<f64>();
        }
        let rates = self.rates(t);
        let l = Vector3::new(self.inertia[0] * rates.x, self.inertia[1] * rates.y, self.inertia[2] * rates.z);
        let (theta, psi) = (l.xy().norm().atan2(l.z), l.x.atan2(l.y));
        let about = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
        about(Vector3::z_axis(), phi) * about(Vector3::x_axis(), theta) * about(Vector3::z_axis(), psi)
    }
}

/// Euler's equations and nothing beside: three products of rates, and a mass matrix that never changes.
#[test]
fn a_free_body_is_solved_for_in_its_axes() {
    let series = "smooth: a Taylor series of the motion takes 3 convolutions and the recurrences of no functions an \
                  order, and 16 convolutions for each orientation";
    assert!(Free::STRUCTURE.facts.contains(&series), "{}", Free::STRUCTURE);
    assert_eq!(Free::STRUCTURE.mass_matrix, "constant and diagonal, solved by divisions");
}

#[test]
fn a_free_body_tumbles_about_its_unstable_axis_as_elliptic_functions_do() {
    let (inertia, energy) = ([1.0, 2.0, 3.0], 25.0);
    let exact = Euler::new(inertia, energy, (2.0 * energy * 2.0 * 1.02_f64).sqrt());
    let body = Free { inertia };
    let start = body.state(
        FreeCoordinates { attitude: exact.orientation(0.0) },
        FreeVelocities { attitude: exact.rates(0.0) },
    );
    let mut motion = body.simulate(start).with_tolerance(1e-15);
    for i in 1..=10 {
        let t = f64::from(i);
        let state = *motion.advance_to(t).unwrap();
        let found = FreeCoordinates::from(state.q).attitude;
        all_close_on_largest(body.velocities(&state).attitude, exact.rates(t), 1e-12);
        let expected = exact.orientation(t).to_rotation_matrix();
        all_close_on_largest(found.to_rotation_matrix().matrix(), expected.matrix(), 1e-12);
    }
    // It takes 127 steps. More would mean that the quaternion is not as smooth as the motion.
    between(30.0, motion.steps().accepted as f64, 160.0);
}

/// A symmetric top on its tip: A and C are moments about the tip.
struct Heavy {
    a: f64,
    c: f64,
    weight: f64,
}

#[lagrangian(coordinates = [attitude: Rotation])]
impl Heavy {
    #[body(mass = 1.0, inertia = [self.a, self.a, self.c])]
    fn body(&self, q: &Coordinates) -> (Vector3<f64>, Rotation3<f64>) {
        (Vector3::zeros(), q.attitude.to_rotation_matrix())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.weight * (q.attitude * Vector3::z()).z
    }
}

/// cos θ of a top released with a spin alone: of (cos θ)′² = β (u₀ − u)(u − u₁)(u₃ − u). (Goldstein,
/// *Classical Mechanics*, 3rd ed., section 5.7.)
fn height(top: &Heavy, u0: f64, spin: f64, t: f64) -> f64 {
    let (beta, b) = (2.0 * top.weight / top.a, top.c * spin / top.a);
    let root = (b.powi(4) - 4.0 * beta * (b * b * u0 - beta)).sqrt();
    let (u1, u3) = ((b * b - root) / (2.0 * beta), (b * b + root) / (2.0 * beta));
    let [_, cn, dn] = jacobi(0.5 * (beta * (u3 - u1)).sqrt() * t, (u0 - u1) / (u3 - u1));
    u1 + (u0 - u1) * (cn / dn).powi(2)
}

#[test]
fn a_heavy_top_nods_as_elliptic_functions_do() {
    let top = Heavy { a: 0.35, c: 0.05, weight: 4.9 };
    // A slow spin lets it fall past hanging, a fast one nod beside its start; upside down and askew.
    for (tilt, spin) in [(0.3, 0.5), (1.2, 3.0), (0.5, 60.0), (3.0, 10.0)] {
        let start = top.state(
            HeavyCoordinates {
                attitude: UnitQuaternion::from_euler_angles(0.0, tilt, 0.0)
                    * UnitQuaternion::from_euler_angles(0.0, 0.0, 2.0),
            },
            HeavyVelocities { attitude: Vector3::new(0.0, 0.0, spin) },
        );
        let mut motion = top.simulate(start).with_tolerance(1e-15);
        for i in 1..=8 {
            let t = 0.5 * f64::from(i);
            let state = *motion.advance_to(t).unwrap();
            let axis = HeavyCoordinates::from(state.q).attitude * Vector3::z();
            close_on(1.0, axis.z, height(&top, f64::cos(tilt), spin, t), 1e-12);
            close_on(spin, top.velocities(&state).attitude.z, spin, 1e-12);
        }
    }
}

#[test]
fn a_start_with_the_long_way_round_is_the_same_motion() {
    let body = Free { inertia: [1.0, 2.0, 3.0] };
    // The same orientation by 0.5 rad and by 0.5 − 2π about x, the same angular velocity.
    let rates = Vector3::new(0.3, 2.0, -0.4);
    let start = |angle: f64| {
        let rho = [4.0 * (angle / 4.0).tan(), 0.0, 0.0];
        State::new(rho, FreeVelocities { attitude: rates }.__rates(rho))
    };
    let [short, long] = [0.5, 0.5 - core::f64::consts::TAU].map(|angle| {
        let state = *body.simulate(start(angle)).with_tolerance(1e-14).advance_to(3.0).unwrap();
        FreeCoordinates::from(state.q).attitude
    });
    close_on(1.0, short.angle_to(&long), 0.0, 1e-12);
}
