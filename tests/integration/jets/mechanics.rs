//! Mass matrices of every kind in which they are solved, bodies, gyroscopes, linear systems, both precisions.

use lagrangian::prelude::*;

use super::oracle::{agrees, obeys, series};
use crate::support::close::{all_close, close};
use crate::support::motion::drift;
use crate::support::sample::Samples;

/// A gyroscope and a wheel that share an angle; generic, by poses.
#[derive(Clone, Copy)]
struct Gyroscope<R> {
    mass: R,
    arm: R,
    moments: Vector3<R>,
}

#[lagrangian(coordinates = [phi, theta, psi, x], inputs = [motor])]
impl<R: Real> Gyroscope<R> {
    #[body(mass = self.mass, inertia = self.moments)]
    fn top(&self, q: &Coordinates<R>) -> (Vector3<R>, Rotation3<R>) {
        let attitude = Rotation3::from_axis_angle(&Vector3::z_axis(), q.phi)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.theta)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.psi);
        (attitude * Vector3::new(R::zero(), R::zero(), self.arm), attitude)
    }

    #[body(mass = 2.0, inertia = 0.5)]
    fn wheel(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        (Rotation2::new(q.x) * Vector2::new(R::from_f64(0.3), R::one()), q.x + 0.5 * q.phi)
    }

    #[potential]
    fn weight(&self, q: &Coordinates<R>) -> R {
        self.mass * 9.81 * self.top(q).0.z + 2.0 * 9.81 * self.wheel(q).0.y
    }

    #[force(on = psi)]
    fn motor(&self, v: &Velocities<R>, u: &Inputs<R>) -> R {
        u.motor - v.psi * 0.01
    }
}

const GYROSCOPE: Gyroscope<f64> = Gyroscope { mass: 1.5, arm: 0.4, moments: Vector3::new(0.3, 0.25, 0.1) };

fn spinning() -> State<f64, 4> {
    State::new([0.1, 0.9, -0.3, 0.4], [0.2, -0.3, 9.0, 0.5])
}

#[test]
fn bodies_in_space_and_in_the_plane() {
    agrees(&GYROSCOPE, spinning(), [0.4], 2.0, 2e-11);
}

#[test]
fn single_precision_is_double_precision_rounded() {
    let Gyroscope { mass, arm, moments } = GYROSCOPE;
    let single = Gyroscope { mass: mass as f32, arm: arm as f32, moments: moments.map(|x| x as f32) };
    let start = spinning();
    let begin = State::new(start.q.map(|x| x as f32), start.v.map(|x| x as f32));
    let mut fine = GYROSCOPE.simulate(start).with_inputs([0.4]);
    let mut coarse = single.simulate(begin).with_inputs([0.4_f32]);
    let mut stepper = single.stepper::<Jet<6>>(begin);
    for k in 1..=100 {
        let t = 0.01 * f64::from(k);
        fine.advance_to(t).unwrap();
        coarse.advance_to(t as f32).unwrap();
        stepper.step(0.01, &[0.4]).unwrap();
    }
    for found in [coarse.state(), stepper.state()] {
        all_close(found.q.map(f64::from), fine.state().q, 1e-4);
        all_close(found.v.map(f64::from), fine.state().v, 1e-4);
    }
    assert!(coarse.steps().evaluations < 200, "{:?}", coarse.steps());
}

/// Every form of a mass matrix at once: a constant dense block of parameters, a dense block of 2 and one of 4
/// that move, single entries that are one, a number, a parameter, and a function.
struct Blocks {
    m: [f64; 4],
    k: f64,
}

#[lagrangian(coordinates = [a: [4], b: [2], c: [4], one, number, parameter, function])]
impl Blocks {
    #[kinetic]
    fn constant(&self, v: &Velocities) -> f64 {
        let mut sum = 0.5 * self.m[0] * v.a[0].powi(2);
        for i in 1..4 {
            sum += 0.5 * self.m[i] * (v.a[i] - 0.7 * v.a[i - 1]).powi(2);
        }
        sum
    }

    #[point(mass = self.m[1])]
    fn pendulum(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        let upper = Vector2::new(q.b[0].sin(), -q.b[0].cos());
        [upper, upper + Vector2::new(q.b[1].sin(), -q.b[1].cos())]
    }

    #[point(mass = self.m[..])]
    fn chain(&self, q: &Coordinates) -> [Vector2<f64>; 4] {
        let mut joints = [Vector2::zeros(); 4];
        let mut end = Vector2::zeros();
        for i in 0..4 {
            end += Vector2::new(q.c[i].sin(), -q.c[i].cos());
            joints[i] = end;
        }
        joints
    }

    #[kinetic]
    fn single(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let moving = (1.0 + q.function * q.function) * v.function.powi(2);
        0.5 * (v.one.powi(2) + 3.0 * v.number.powi(2) + self.m[3] * v.parameter.powi(2) + moving)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        let springs = q.a.iter().map(|x| x * x).sum::<f64>();
        let weights = self.pendulum(q)[1].y + self.chain(q).iter().map(|r| r.y).sum::<f64>();
        let singles = q.one.powi(2) + q.number.powi(2) + q.parameter.powi(2) + q.function.powi(2);
        let coupling = (q.a[0] * q.b[1] - q.c[3] * q.one).sin() + (q.number * q.function - q.parameter).cos();
        0.5 * self.k * (springs + singles) + 9.81 * weights + coupling
    }
}

#[test]
fn mass_matrices_in_blocks_of_every_kind() {
    let blocks = Blocks { m: [1.1, 0.9, 1.3, 0.7], k: 2.0 };
    let start = State { t: 0.0, ..Samples::new(6).state::<14>(-0.7, 0.7) };
    agrees(&blocks, start, [], 1.5, 1e-11);
    let mut motion = blocks.simulate(start).with_tolerance(1e-15);
    let energy = motion.energy();
    assert!(drift(&mut motion, 0.5, 20, |s| blocks.energy(s)) < 1e-13 * energy.abs());
}

/// Lagrangians given whole: M of indefinite signature, and of a size that is factored with pivoting.
struct Whole {
    field: f64,
}

#[lagrangian(coordinates = [x: [3], y: [2]])]
impl Whole {
    #[lagrangian]
    fn lagrangian(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        let [x, y, z] = q.x;
        let [vx, vy, vz] = v.x;
        let dense = 0.5 * (2.0 + x.sin()) * vx * vx - 0.5 * vy * vy + (vx * vz + 0.2 * vy * vz) * y.cos();
        let gyroscopic = self.field * (x * vy - y * vx) + (t + z).sin() * vz;
        let quartic = 1.5 * vz * vz + 0.01 * vz.powi(4) + 0.1 * (1.0 + vx * vx).sqrt();
        let saddle = v.y[0] * v.y[1] * (1.0 + q.y[0].powi(2)) - q.y[0] * q.y[1] - 0.3 * q.y[0] * x;
        dense + gyroscopic + quartic + saddle - 0.5 * (x * x + y * y + z * z)
    }
}

#[test]
fn lagrangians_given_whole() {
    let whole = Whole { field: 0.6 };
    let mut samples = Samples::new(7);
    for _ in 0..3 {
        agrees(&whole, samples.state::<5>(-0.4, 0.4), [], 1.0, 2e-11);
    }
}

/// Coupled oscillators with forces and friction: linear, no products at all.
struct Linear {
    k: [f64; 3],
    c: f64,
}

#[lagrangian(coordinates = [x: [3], free, falling], inputs = [push])]
impl Linear {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        let [a, b, c] = v.x;
        a * a + b * b + c * c + 0.5 * (a + b) * c + 0.5 * (v.free * v.free + v.falling * v.falling)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        let [a, b, c] = q.x;
        0.5 * (self.k[0] * a * a + self.k[1] * (a - b).powi(2) + self.k[2] * (b - c).powi(2))
            + 9.81 * q.falling
    }

    #[dissipation]
    fn friction(&self, v: &Velocities) -> f64 {
        0.5 * self.c * (v.x[0] - v.x[2]).powi(2)
    }

    #[force(on = x)]
    fn push(&self, t: f64, u: &Inputs) -> [f64; 3] {
        [u.push, 0.5 * u.push + t, -0.1]
    }
}

#[test]
fn a_linear_system_has_no_products() {
    let linear = Linear { k: [3.0, 2.0, 5.0], c: 0.4 };
    let start = State::new([0.3, -0.2, 0.1, 2.0, 5.0], [0.0, 0.4, -0.3, 1.5, 1.0]);
    agrees(&linear, start, [0.7], 6.0, 1e-12);
    let mut motion = linear.simulate(start).with_inputs([0.7]);
    let state = motion.advance_to(4.0).unwrap();
    close(state.q[3], 2.0 + 1.5 * 4.0, 1e-15);
    close(state.q[4], 5.0 + 4.0 - 9.81 * 8.0, 1e-15);
}

#[test]
fn without_springs_and_friction_it_moves_by_a_polynomial() {
    let linear = Linear { k: [0.0; 3], c: 0.0 };
    let start = State::new([0.1, 0.2, 0.3, 0.4, 0.5], [1.0, 2.0, 3.0, 4.0, 5.0]).at_time(1.0);
    let found = series(&linear, &start, &[0.3], 1.0);
    for k in 3..12 {
        assert_eq!((found.q[k], found.v[k]), ([0.0; 5], [0.0; 5]), "order {}", k + 1);
    }
    obeys(&linear, &start, &[0.3]);
    let mut motion = linear.simulate(start).with_inputs([0.3]);
    motion.advance_to(1001.0).unwrap();
    assert_eq!(motion.steps().accepted, 1);
    let (q, v) = found.gain(1000.0, 12);
    all_close(motion.state().q, std::array::from_fn::<f64, 5, _>(|i| start.q[i] + q[i]), 1e-14);
    all_close(motion.state().v, std::array::from_fn::<f64, 5, _>(|i| start.v[i] + v[i]), 1e-14);
}

/// A chain of many links, whose M is factored in the runtime and whose tables are wide.
struct Chain {
    m: f64,
}

#[lagrangian(coordinates = [theta: [18]])]
impl Chain {
    #[point(mass = self.m)]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 18] {
        let mut joints = [Vector2::zeros(); 18];
        let mut end = Vector2::zeros();
        for i in 0..18 {
            end += Vector2::new(q.theta[i].sin(), -q.theta[i].cos());
            joints[i] = end;
        }
        joints
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        self.m * 9.81 * self.joints(q).iter().map(|r| r.y).sum::<f64>()
    }
}

#[test]
fn a_long_chain() {
    let chain = Chain { m: 0.5 };
    let start = State { t: 0.0, ..Samples::new(8).state::<18>(0.2, 0.6) };
    agrees(&chain, start, [], 0.5, 1e-11);
    let mut motion = chain.simulate(start).with_tolerance(1e-15);
    let energy = motion.energy();
    assert!(drift(&mut motion, 0.5, 4, |s| chain.energy(s)) < 1e-13 * energy.abs());
}
