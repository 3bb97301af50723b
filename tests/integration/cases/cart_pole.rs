//! C14: the cart-pole of the reinforcement-learning literature, pushed at the cart.

use lagrangian::prelude::*;

use super::CLOSED_FORM;
use crate::support::close::{all_close, close};
use crate::support::difference::{STEP, eigenvalues, state_matrix};
use crate::support::reference::classical;
use crate::support::sample::Samples;

/// The pole is a uniform rod; its angle is measured clockwise from upright.
struct CartPole {
    cart: f64,
    pole: f64,
    half_length: f64,
    g: f64,
}

#[lagrangian(coordinates = [x, theta], inputs = [push])]
impl CartPole {
    #[point(mass = self.cart)]
    fn cart(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    #[body(mass = self.pole, inertia = self.pole * self.half_length.powi(2) / 3.0)]
    fn pole(&self, q: &Coordinates) -> Isometry2<f64> {
        let centre = self.cart(q) + self.half_length * Vector2::new(q.theta.sin(), q.theta.cos());
        Isometry2::new(centre, -q.theta)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.pole * self.g * self.half_length * q.theta.cos()
    }

    #[force(at = cart)]
    fn push(&self, u: &Inputs) -> Vector2<f64> {
        Vector2::new(u.push, 0.0)
    }
}

const CART_POLE: CartPole = CartPole { cart: 1.0, pole: 0.1, half_length: 0.5, g: 9.8 };

/// The published explicit formula.
fn published(state: &State<f64, 2>, push: f64) -> [f64; 2] {
    let CartPole { cart, pole, half_length, g } = CART_POLE;
    let total = cart + pole;
    let (sin, cos) = state.q[1].sin_cos();
    let temporary = (push + pole * half_length * state.v[1].powi(2) * sin) / total;
    let angular = (g * sin - cos * temporary) / (half_length * (4.0 / 3.0 - pole * cos * cos / total));
    [temporary - pole * half_length * angular * cos / total, angular]
}

#[test]
fn the_accelerations_agree() {
    let state = State::new([0.05, 0.1], [0.2, -0.3]);
    let expected = classical("C14_cartpole").numbers::<2>("acc_x_theta_at_(.05,.1,.2,-.3)_F=10");
    all_close(CART_POLE.accelerations(&state, &[10.0]).unwrap(), expected, CLOSED_FORM);
}

#[test]
fn the_accelerations_are_those_of_the_published_formula() {
    let mut samples = Samples::new(14);
    for _ in 0..20 {
        let state = samples.state(-3.0, 3.0);
        let push = samples.number(-10.0, 10.0);
        all_close(CART_POLE.accelerations(&state, &[push]).unwrap(), published(&state, push), 1e-13);
    }
}

#[test]
fn the_unstable_eigenvalue_agrees() {
    let matrix =
        state_matrix(STEP, &State::at_rest([0.0, 0.0]), |s| CART_POLE.accelerations(s, &[0.0]).unwrap());
    let largest = eigenvalues(&matrix).last().unwrap().re;
    close(largest, classical("C14_cartpole").number("upright_unstable_eig"), CLOSED_FORM);
}

#[test]
fn a_feedback_holds_the_pole_upright() {
    let gain = [1.0, 30.0, 2.0, 8.0];
    let feedback = |s: &State<f64, 2>| [s.iter().zip(gain).map(|(x, k)| k * x).sum()];
    let mut motion = CART_POLE.simulate(State::new([0.1, 0.05], [0.0, 0.0])).with_control(feedback);
    let end = *motion.advance_to(60.0).unwrap();
    all_close(end.iter().collect::<Vec<_>>(), [0.0; 4], 1e-3);
    let mut free = CART_POLE.simulate(State::new([0.1, 0.05], [0.0, 0.0]));
    assert!(free.advance_to(2.0).unwrap().q[1].abs() > 1.0, "without feedback it falls");
}
