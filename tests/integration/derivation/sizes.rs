//! Every way in which M a = f is solved: written out, in blocks, factored in the runtime, once or at every
//! step.

use lagrangian::prelude::*;

use crate::support::close::{all_close, all_close_on_largest};
use crate::support::identities::model;
use crate::support::sample::Samples;

/// The solution of M a = −bias by nalgebra, from the generated parts: no forces are applied.
macro_rules! solved {
    ($system:expr, $state:expr) => {{
        let right = -SVector::from($system.bias(&$state));
        $system.mass_matrix(&$state).lu().solve(&right).expect("a regular matrix")
    }};
}

/// A long chain: dense, depends on q, factored at every step.
struct Chain;

#[lagrangian(coordinates = [theta: [Self::LINKS]])]
impl Chain {
    const LINKS: usize = 24;

    #[point(mass = 0.5)]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; Self::LINKS] {
        let mut joints = [Vector2::zeros(); Self::LINKS];
        let mut end = Vector2::zeros();
        for i in 0..Self::LINKS {
            end += 0.25 * Vector2::new(q.theta[i].sin(), -q.theta[i].cos());
            joints[i] = end;
        }
        joints
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.joints(q).iter().map(|joint| 0.5 * 9.81 * joint.y).sum()
    }
}

#[test]
fn a_long_chain_is_factored_in_the_runtime() {
    let state: State<f64, 24> = Samples::new(1).state(-1.0, 1.0);
    all_close_on_largest(Chain.accelerations(&state).unwrap(), solved!(Chain, state).as_slice(), 1e-11);
    model!(Chain).holds(-0.5, 0.5);
}

/// Carts coupled through one mass: dense and constant, factored once.
struct Coupled;

#[lagrangian(coordinates = [x: [18]])]
impl Coupled {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        let total: f64 = v.x.iter().sum();
        let own: f64 = v.x.iter().enumerate().map(|(i, v)| (1.0 + i as f64) * v * v).sum();
        0.5 * own + 0.5 * total * total
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        q.x.windows(2).map(|pair| (pair[1] - pair[0]).powi(4)).sum::<f64>() + q.x[0].cos()
    }
}

#[test]
fn a_constant_matrix_is_factored_once() {
    let mut samples = Samples::new(2);
    for _ in 0..3 {
        let state: State<f64, 18> = samples.state(-1.0, 1.0);
        all_close_on_largest(
            Coupled.accelerations(&state).unwrap(),
            solved!(Coupled, state).as_slice(),
            1e-13,
        );
    }
    model!(Coupled).holds(-0.5, 0.5);
}

/// An indefinite matrix that depends on q: LU at every step.
struct Indefinite;

#[lagrangian(coordinates = [x: [4]])]
impl Indefinite {
    #[lagrangian]
    fn lagrangian(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let [a, b, c, d] = v.x;
        a * b + (2.0 + q.x[0].sin()) * c * d + q.x[1] * a * c - b * b * q.x[3].cos() - q.x[2] * q.x[3] * a
    }
}

/// The same with a constant matrix that has zeros on its diagonal.
struct Swapped;

#[lagrangian(coordinates = [x: [3]])]
impl Swapped {
    #[lagrangian]
    fn lagrangian(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.x[0] * v.x[1] + v.x[1] * v.x[2] - 2.0 * v.x[2] * v.x[0] + q.x[0] * q.x[1].sin() * q.x[2]
    }
}

#[test]
fn indefinite_matrices_are_solved_with_pivoting() {
    let mut samples = Samples::new(3);
    for _ in 0..3 {
        let state: State<f64, 4> = samples.state(-1.0, 1.0);
        all_close_on_largest(
            Indefinite.accelerations(&state).unwrap(),
            solved!(Indefinite, state).as_slice(),
            1e-12,
        );
        let state: State<f64, 3> = samples.state(-1.0, 1.0);
        all_close_on_largest(
            Swapped.accelerations(&state).unwrap(),
            solved!(Swapped, state).as_slice(),
            1e-13,
        );
    }
    model!(Indefinite).holds(-0.5, 0.5);
    model!(Swapped).holds(-0.5, 0.5);
}

/// Independent subsystems declared in a mixed order: a pendulum, a dense triple, two free coordinates.
struct Blocks;

#[lagrangian(coordinates = [a, x, b, y, c, z])]
impl Blocks {
    #[kinetic]
    fn pendulum(&self, q: &Coordinates, v: &Velocities) -> f64 {
        (1.0 + 0.5 * q.x.cos()) * v.x.powi(2)
    }

    #[kinetic]
    fn triple(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.a.powi(2)
            + 2.0 * v.b.powi(2)
            + 3.0 * v.c.powi(2)
            + v.a * v.b * q.c.sin()
            + v.b * v.c * q.a.cos()
            + v.a * v.c
    }

    #[kinetic]
    fn free(&self, v: &Velocities) -> f64 {
        2.0 * v.y.powi(2) + 0.25 * v.z.powi(2)
    }

    #[potential]
    fn coupling(&self, q: &Coordinates) -> f64 {
        q.a * q.x + q.b.sin() * q.y + q.c * q.z
    }
}

#[test]
fn blocks_are_solved_apart_and_put_back_in_order() {
    let mut samples = Samples::new(4);
    for _ in 0..5 {
        let state: State<f64, 6> = samples.state(-1.0, 1.0);
        all_close(Blocks.accelerations(&state).unwrap(), solved!(Blocks, state).as_slice(), 1e-12);
        let mass = Blocks.mass_matrix(&state);
        assert_eq!((mass[(0, 1)], mass[(3, 3)], mass[(5, 5)]), (0.0, 4.0, 0.5));
    }
    model!(Blocks).holds(-1.0, 1.0);
}

/// More inputs than are worth a name each.
struct Keyboard;

#[lagrangian(coordinates = [x: [20]], inputs = [keys: [20], pedal])]
impl Keyboard {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x.iter().enumerate().map(|(i, v)| (1.0 + i as f64) * v * v).sum::<f64>()
    }

    #[force(on = x)]
    fn strings(&self, q: &Coordinates, u: &Inputs) -> [f64; 20] {
        std::array::from_fn(|i| u.keys[i] - u.pedal * q.x[i])
    }
}

#[test]
fn many_inputs_keep_their_order() {
    let u: [f64; 21] = std::array::from_fn(|i| 0.5 + i as f64);
    let state: State<f64, 20> = Samples::new(5).state(-1.0, 1.0);
    let expected: [f64; 20] = std::array::from_fn(|i| (u[i] - u[20] * state.q[i]) / (1.0 + i as f64));
    all_close(Keyboard.accelerations(&state, &u).unwrap(), expected, 1e-14);
    model!(Keyboard, inputs = u).holds(-1.0, 1.0);
}

#[test]
fn cost_and_structure_say_what_was_found() {
    let costs = [Chain::COST, Coupled::COST, Indefinite::COST, Swapped::COST, Blocks::COST, Keyboard::COST];
    for cost in costs {
        assert!(0 < cost.after.total() && cost.after.total() <= cost.before.total(), "{cost}");
    }
    // Sine and cosine of an angle count once, and every angle of the chain has both.
    assert_eq!(Chain::COST.after.functions, 24);
    for (structure, constant) in
        [(Chain::STRUCTURE, false), (Coupled::STRUCTURE, true), (Swapped::STRUCTURE, true)]
    {
        assert_eq!(structure.mass_matrix.contains("constant"), constant, "{structure}");
    }
    assert!(Blocks::STRUCTURE.mass_matrix.contains("block"), "{}", Blocks::STRUCTURE);
    assert!(Keyboard::STRUCTURE.mass_matrix.contains("diagonal"), "{}", Keyboard::STRUCTURE);
}
