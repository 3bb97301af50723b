//! Applied forces: on coordinates, at points and bodies, from inputs and velocities, and their power.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};
use crate::support::difference::derivative;
use crate::support::identities::model;
use crate::support::sample::Samples;

/// A chain of three links; every force below acts on it.
struct Chain {
    l: [f64; 3],
    drag: f64,
}

#[lagrangian(coordinates = [theta: [3]], inputs = [motor: [3], wind, brake])]
impl Chain {
    #[point(mass = 1.0)]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 3] {
        let mut joints = [Vector2::zeros(); 3];
        let mut end = Vector2::zeros();
        for i in 0..3 {
            end += self.l[i] * Vector2::new(q.theta[i].sin(), -q.theta[i].cos());
            joints[i] = end;
        }
        joints
    }

    #[force]
    fn generalized(&self, q: &Coordinates, v: &Velocities) -> [f64; 3] {
        [q.theta[1] * v.theta[0], 2.0, -q.theta[2]]
    }

    #[force(on = theta)]
    fn motors(&self, u: &Inputs) -> [f64; 3] {
        u.motor
    }

    #[force(on = theta[1])]
    fn brake(&self, v: &Velocities, u: &Inputs) -> f64 {
        -u.brake * v.theta[1]
    }

    #[force(at = joints)]
    fn wind(&self, u: &Inputs) -> [Vector2<f64>; 3] {
        [Vector2::new(u.wind, 0.0); 3]
    }

    #[force(at = joints[2])]
    fn kick(&self, t: f64) -> Vector2<f64> {
        Vector2::new(0.0, t)
    }

    #[dissipation]
    fn friction(&self, v: &Velocities) -> f64 {
        self.drag * (v.theta[0] - v.theta[1]).powi(4) / 4.0 + self.drag * v.theta[2].powi(2) / 2.0
    }
}

const CHAIN: Chain = Chain { l: [0.5, 0.8, 1.1], drag: 0.3 };
const INPUTS: [f64; 5] = [0.1, 0.2, 0.3, 1.5, 0.7];

#[test]
fn forces_of_every_kind_add_up() {
    let mut samples = Samples::new(1);
    for _ in 0..10 {
        let state: State<f64, 3> = samples.state(-2.0, 2.0);
        let (q, v) = (state.q, state.v);
        let [_, _, _, wind, brake] = INPUTS;
        // Turning angle i moves the joints from i on by l (cos, sin).
        let at_joints = |i: usize| {
            let wind = (3 - i) as f64 * wind * CHAIN.l[i] * q[i].cos();
            wind + state.t * CHAIN.l[i] * q[i].sin()
        };
        let stretch = CHAIN.drag * (v[0] - v[1]).powi(3);
        let expected = [
            q[1] * v[0] + INPUTS[0] + at_joints(0) - stretch,
            2.0 + INPUTS[1] - brake * v[1] + at_joints(1) + stretch,
            -q[2] + INPUTS[2] + at_joints(2) - CHAIN.drag * v[2],
        ];
        all_close(CHAIN.applied_forces(&state, &INPUTS), expected, 1e-13);
        let power: f64 = expected.iter().zip(v).map(|(force, rate)| force * rate).sum();
        close(CHAIN.power(&state, &INPUTS), power, 1e-13);
    }
    model!(CHAIN, inputs = INPUTS).holds(-1.0, 1.0);
}

#[test]
fn inputs_come_in_the_order_of_declaration() {
    let state = State::new([0.1, 0.2, 0.3], [0.4, 0.5, 0.6]);
    let response = |index: usize| {
        let with = |x: f64| {
            let mut u = INPUTS;
            u[index] += x;
            CHAIN.applied_forces(&state, &u)
        };
        derivative(0.5, with)
    };
    all_close(response(1), [0.0, 1.0, 0.0], 1e-13);
    all_close(response(4), [0.0, -0.5, 0.0], 1e-13);
    let named = ChainInputs { motor: [0.1, 0.2, 0.3], wind: 1.5, brake: 0.7 };
    assert_eq!(<[f64; 5]>::from(named), INPUTS);
    assert_eq!(CHAIN.motors(&INPUTS.into()), [0.1, 0.2, 0.3]);
}

/// Drag along the velocity of a projectile, quadratic in its speed.
struct Projectile {
    drag: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl Projectile {
    #[point(mass = 2.0)]
    fn shell(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[force(at = shell)]
    fn drag(&self, v: &Velocities) -> Vector3<f64> {
        let velocity = Vector3::new(v.x, v.y, v.z);
        -self.drag * velocity.norm() * velocity
    }

    #[force(at = shell)]
    fn weight(&self) -> Vector3<f64> {
        Vector3::new(0.0, 0.0, -2.0 * 9.81)
    }
}

#[test]
fn drag_reaches_the_terminal_speed() {
    let projectile = Projectile { drag: 0.05 };
    let state = State::new([0.0; 3], [3.0, 4.0, 12.0]);
    let a = projectile.accelerations(&state).unwrap();
    let drag = 0.05 * 13.0 / 2.0;
    all_close(a, [-3.0 * drag, -4.0 * drag, -12.0 * drag - 9.81], 1e-15);
    close(projectile.power(&state), -0.05 * 13.0_f64.powi(3) - 2.0 * 9.81 * 12.0, 1e-15);
    let mut motion = projectile.simulate(state);
    let end = motion.advance_to(100.0).unwrap();
    all_close(end.v, [0.0, 0.0, -(2.0 * 9.81_f64 / 0.05).sqrt()], 1e-9);
}

/// Forces and torques on bodies: a beam in the plane and a rotor in space.
struct Wrenches {
    arm: f64,
}

#[lagrangian(coordinates = [x, phi, a, b], inputs = [f: [2], m, torque: [3], push: [3]])]
impl Wrenches {
    #[body(mass = 1.0, inertia = 0.5)]
    fn beam(&self, q: &Coordinates) -> Isometry2<f64> {
        let centre = Vector2::new(q.x, 0.0) + self.arm * Vector2::new(q.phi.cos(), q.phi.sin());
        Isometry2::new(centre, 2.0 * q.phi)
    }

    #[body(mass = 1.0, inertia = [1.0, 2.0, 3.0])]
    fn rotor(&self, q: &Coordinates) -> Isometry3<f64> {
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), q.a)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.b);
        Isometry3::from_parts((turn * Vector3::new(0.0, 0.0, self.arm)).into(), turn.into())
    }

    #[force(at = beam)]
    fn on_beam(&self, u: &Inputs) -> (Vector2<f64>, f64) {
        (Vector2::new(u.f[0], u.f[1]), u.m)
    }

    #[force(at = rotor)]
    fn on_rotor(&self, u: &Inputs) -> (Vector3<f64>, Vector3<f64>) {
        (Vector3::from(u.push), Vector3::from(u.torque))
    }
}

#[test]
fn forces_and_torques_on_bodies_do_their_work() {
    let system = Wrenches { arm: 0.7 };
    let mut samples = Samples::new(9);
    for _ in 0..10 {
        let state: State<f64, 4> = samples.state(-2.0, 2.0);
        let u: [f64; 9] = std::array::from_fn(|_| samples.number(-1.0, 1.0));
        let [_, phi, a, b] = state.q;
        let arm = system.arm;
        let on_beam = [u[0], arm * (-u[0] * phi.sin() + u[1] * phi.cos()) + 2.0 * u[2]];
        let torque = Vector3::new(u[3], u[4], u[5]);
        let push = Vector3::new(u[6], u[7], u[8]);
        // Turning by a goes about the vertical, turning by b about the x axis turned by a.
        let axes = [Vector3::z(), Vector3::new(a.cos(), a.sin(), 0.0)];
        let centre = arm * Vector3::new(b.sin() * a.sin(), -b.sin() * a.cos(), b.cos());
        let on_rotor = axes.map(|axis| axis.dot(&torque) + axis.cross(&centre).dot(&push));
        let expected = [on_beam[0], on_beam[1], on_rotor[0], on_rotor[1]];
        all_close(system.applied_forces(&state, &u), expected, 1e-13);
        model!(system, inputs = u).holds(0.3, 1.3);
    }
}
