//! Inputs, dissipation and moving constraints together: a cart with a pendulum on a rod, and a bead on a
//! turning arm.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close, close_on};
use crate::support::constrained::bound;
use crate::support::motion::TIGHT;
use crate::support::sample::Samples;

const G: f64 = 9.81;

#[derive(Clone, Copy)]
struct Parts {
    cart: f64,
    bob: f64,
    length: f64,
    damping: f64,
}

/// The bob in Cartesian coordinates, held by a rod; a motor pushes the cart, a fan the bob.
struct Tied(Parts);

#[lagrangian(coordinates = [cart, x, y], inputs = [motor, fan])]
impl Tied {
    #[point(mass = self.0.cart)]
    fn cart(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.cart, 0.0)
    }

    #[point(mass = self.0.bob)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.0.bob * G * q.y
    }

    #[dissipation]
    fn drag(&self, v: &Velocities) -> f64 {
        0.5 * self.0.damping * (v.x.powi(2) + v.y.powi(2))
    }

    #[force(on = cart)]
    fn motor(&self, u: &Inputs) -> f64 {
        u.motor
    }

    #[force(at = bob)]
    fn fan(&self, u: &Inputs) -> Vector2<f64> {
        Vector2::new(u.fan, 0.0)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        (self.bob(q) - self.cart(q)).norm() - self.0.length
    }
}

/// The same by the angle of the rod.
struct ByAngle(Parts);

#[lagrangian(coordinates = [cart, theta], inputs = [motor, fan])]
impl ByAngle {
    #[point(mass = self.0.cart)]
    fn cart(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.cart, 0.0)
    }

    #[point(mass = self.0.bob)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        self.cart(q) + self.0.length * Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.0.bob * G * self.bob(q).y
    }

    #[dissipation]
    fn drag(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let (along, up) =
            (v.cart + self.0.length * v.theta * q.theta.cos(), self.0.length * v.theta * q.theta.sin());
        0.5 * self.0.damping * (along.powi(2) + up.powi(2))
    }

    #[force(on = cart)]
    fn motor(&self, u: &Inputs) -> f64 {
        u.motor
    }

    #[force(at = bob)]
    fn fan(&self, u: &Inputs) -> Vector2<f64> {
        Vector2::new(u.fan, 0.0)
    }
}

/// A bead on an arm that turns at a given rate in the plane, pushed along the arm.
struct Arm {
    m: f64,
    rate: f64,
}

#[lagrangian(coordinates = [x, y], inputs = [push])]
impl Arm {
    #[point(mass = self.m)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[force(at = bead)]
    fn push(&self, t: f64, u: &Inputs) -> Vector2<f64> {
        u.push * Vector2::new((self.rate * t).cos(), (self.rate * t).sin())
    }

    #[holonomic]
    fn arm(&self, q: &Coordinates, t: f64) -> f64 {
        q.y * (self.rate * t).cos() - q.x * (self.rate * t).sin()
    }
}

const PARTS: Parts = Parts { cart: 1.5, bob: 0.7, length: 0.6, damping: 0.3 };
const TIED: Tied = Tied(PARTS);
const BY_ANGLE: ByAngle = ByAngle(PARTS);
const ARM: Arm = Arm { m: 0.4, rate: 3.0 };

fn tied(state: &State<f64, 2>) -> State<f64, 3> {
    let ([cart, theta], [speed, turn]) = (state.q, state.v);
    let (sin, cos) = theta.sin_cos();
    let l = PARTS.length;
    State::new([cart, cart + l * sin, -l * cos], [speed, speed + l * turn * cos, l * turn * sin])
        .at_time(state.t)
}

#[track_caller]
fn same(found: &State<f64, 3>, expected: &State<f64, 2>, tolerance: f64) {
    let expected = tied(expected);
    all_close(found.q, expected.q, tolerance);
    all_close(found.v, expected.v, tolerance);
}

/// The tension of the rod by Newton's law for the bob along it.
fn tension(state: &State<f64, 2>, u: [f64; 2]) -> f64 {
    let ([_, theta], [_, turn]) = (state.q, state.v);
    let (sin, cos) = theta.sin_cos();
    let [cart, _] = BY_ANGLE.accelerations(state, &u).unwrap();
    let velocity = [state.v[0] + PARTS.length * turn * cos, PARTS.length * turn * sin];
    let applied = [u[1] - PARTS.damping * velocity[0], -PARTS.bob * G - PARTS.damping * velocity[1]];
    let outward = PARTS.bob * (cart * sin - PARTS.length * turn * turn);
    applied[0] * sin - applied[1] * cos - outward
}

#[test]
fn held_inputs_move_both_forms_alike() {
    let start = State::new([0.2, 0.4], [-0.3, 1.0]);
    let mut by_angle = BY_ANGLE.simulate(start).with_tolerance(TIGHT);
    let mut jets = TIED.simulate(tied(&start)).with_tolerance(TIGHT);
    let mut dop853 = TIED.simulate_with::<Dop853>(tied(&start)).with_tolerance(TIGHT);
    for (k, u) in [[0.0, 0.0], [3.0, 0.0], [-2.0, 1.5], [0.0, -4.0]].into_iter().enumerate() {
        by_angle.set_inputs(u);
        jets.set_inputs(u);
        dop853.set_inputs(u);
        let t = 0.7 * (k + 1) as f64;
        let expected = *by_angle.advance_to(t).unwrap();
        same(jets.advance_to(t).unwrap(), &expected, 1e-11);
        same(dop853.advance_to(t).unwrap(), &expected, 1e-11);
        close(jets.reactions().rod, -tension(&expected, u), 1e-10);
        close(dop853.reactions().rod, -tension(&expected, u), 1e-10);
    }
}

#[test]
fn a_control_loop_steers_both_forms_alike() {
    let start = State::new([0.0, 0.3], [0.0, 0.0]);
    let law = |state: &State<f64, 2>| [-4.0 * state.q[0] - 3.0 * state.v[0] + 10.0 * state.q[1], 0.5];
    let mut by_angle = BY_ANGLE.stepper::<Jet<10>>(start);
    let mut jet = TIED.stepper::<Jet<10>>(tied(&start));
    let mut rk4 = TIED.stepper::<Rk4>(tied(&start));
    for _ in 0..500 {
        let u = law(by_angle.state());
        by_angle.step(0.004, &u).unwrap();
        jet.step(0.004, &u).unwrap();
        rk4.step(0.004, &u).unwrap();
        close(jet.reactions(&u).rod, -tension(by_angle.state(), u), 1e-9);
    }
    same(jet.state(), by_angle.state(), 1e-11);
    same(rk4.state(), by_angle.state(), 1e-7);
}

#[test]
fn continuous_feedback_moves_both_forms_alike() {
    let start = State::new([0.0, 0.3], [0.0, 0.0]);
    let mut by_angle = BY_ANGLE
        .simulate(start)
        .with_tolerance(1e-13)
        .with_control(|s: &State<f64, 2>| [-4.0 * s.q[0], s.v[0]]);
    let mut loops = TIED
        .simulate(tied(&start))
        .with_tolerance(1e-13)
        .with_control(|s: &State<f64, 3>| [-4.0 * s.q[0], s.v[0]]);
    for k in 1..=5 {
        let t = 0.5 * f64::from(k);
        let expected = *by_angle.advance_to(t).unwrap();
        same(loops.advance_to(t).unwrap(), &expected, 1e-10);
        let u = loops.inputs();
        close(loops.reactions().rod, -tension(&expected, u), 1e-9);
    }
}

#[test]
fn reactions_follow_the_inputs_at_once() {
    let mut samples = Samples::new(7);
    for _ in 0..10 {
        let state: State<f64, 2> = samples.state(-1.5, 1.5);
        let u = [samples.number(-5.0, 5.0), samples.number(-5.0, 5.0)];
        close_on(20.0, TIED.reactions(&tied(&state), &u).unwrap().rod, -tension(&state, u), 1e-13);
        // The rod takes and gives no energy; the inputs and the drag do.
        let tied = tied(&state);
        close_on(20.0, TIED.reaction_power(&tied, &u).unwrap(), 0.0, 1e-15);
        close_on(20.0, TIED.energy_rate(&tied, &u).unwrap(), TIED.power(&tied, &u), 1e-14);
    }
    bound!(TIED, [true], inputs = [2.0, -1.0]).holds([tied(&State::new([0.3, 0.8], [0.2, -0.7]))]);
}

#[test]
fn damping_ends_at_rest_with_the_weight_on_the_rod() {
    let start = State::new([0.0, 0.9], [0.0, 0.0]);
    let mut motion = Tied(Parts { damping: 2.0, ..PARTS }).simulate(tied(&start));
    let mut energy = f64::INFINITY;
    for k in 1..=40 {
        motion.advance_to(f64::from(k)).unwrap();
        // Near the lowest energy rounding errors decide: the rod is left alone where f is within four ulps of
        // its summands, (|x| + |cart|)² + y² + L² ≤ 1.7 m², and the bob is then off by f/2L in height.
        let height = 4.0 * f64::EPSILON * 1.7 / (2.0 * PARTS.length);
        assert!(motion.energy() <= energy + 2.0 * PARTS.bob * G * height);
        energy = motion.energy();
    }
    close(motion.reactions().rod, -PARTS.bob * G, 1e-10);
    close(energy, -PARTS.bob * G * PARTS.length, 1e-12);
}

#[test]
fn a_bead_on_a_turning_arm_is_pushed_along_it() {
    // r″ = Ω² r + u/m: r = (r₀ + u/(m Ω²)) cosh Ωt − u/(m Ω²), and the arm pushes across with 2 m Ω r′.
    let Arm { m, rate } = ARM;
    for push in [0.0, 0.8, -0.5] {
        let start = State::new([0.5, 0.0], [0.0, 0.5 * rate]);
        let mut jets = ARM.simulate(start).with_inputs([push]).with_tolerance(TIGHT);
        let mut dop853 = ARM.simulate_with::<Dop853>(start).with_inputs([push]).with_tolerance(TIGHT);
        let mut jet = ARM.stepper::<Jet<12>>(start);
        for k in 1..=10 {
            let t = 0.1 * f64::from(k);
            let shift = push / (m * rate * rate);
            let (r, dr) =
                ((0.5 + shift) * (rate * t).cosh() - shift, (0.5 + shift) * rate * (rate * t).sinh());
            let (sin, cos) = (rate * t).sin_cos();
            jet.step(0.1, &[push]).unwrap();
            for state in [*jets.advance_to(t).unwrap(), *dop853.advance_to(t).unwrap(), *jet.state()] {
                all_close(state.q, [r * cos, r * sin], 1e-12);
                all_close(state.v, [dr * cos - r * rate * sin, dr * sin + r * rate * cos], 1e-12);
                close(ARM.reactions(&state, &[push]).unwrap().arm, 2.0 * m * rate * dr, 1e-11);
                let power = 2.0 * m * rate * rate * r * dr;
                close(ARM.reaction_power(&state, &[push]).unwrap(), power, 1e-11);
                close(ARM.energy_rate(&state, &[push]).unwrap(), power + push * dr, 1e-11);
            }
        }
        close(jets.reactions().arm, dop853.reactions().arm, 1e-11);
    }
    let state = State::new([0.5, 0.0], [0.3, 0.5 * rate]);
    bound!(ARM, [true], inputs = [0.8]).holds([state]);
}
