//! The gains of the regulator, computed on the developer's machine.

extern crate std;

use std::vec::Vec;

use lagrangian::prelude::*;

use super::{CartPole, GAINS, RATE, STRONGEST, control};

type Matrix = SMatrix<f64, 4, 4>;
type Column = SMatrix<f64, 4, 1>;

/// ẋ = A x + B u about the upright pole, from the derivatives that the macro generates.
fn linearized() -> (Matrix, Column) {
    let upright = State::at_rest([0.0, 0.0]);
    let derivatives =
        CartPole::<f64>::laboratory().jacobians(&upright, &[0.0]).expect("a regular mass matrix");
    let mut a = Matrix::zeros();
    a.fixed_view_mut::<2, 2>(0, 2).fill_with_identity();
    a.fixed_view_mut::<2, 2>(2, 0).copy_from(&derivatives.by_q);
    a.fixed_view_mut::<2, 2>(2, 2).copy_from(&derivatives.by_v);
    let mut b = Column::zeros();
    b.fixed_view_mut::<2, 1>(2, 0).copy_from(&derivatives.by_u);
    (a, b)
}

/// x[k + 1] = Φ x[k] + Γ u[k] for an input held for `h` \[s]: Φ = exp(A h), Γ = ∫ exp(A s) ds B, by their
/// series.
fn sampled(a: &Matrix, b: &Column, h: f64) -> (Matrix, Column) {
    let (mut phi, mut integral, mut term) = (Matrix::identity(), Matrix::identity() * h, Matrix::identity());
    for k in 1..20 {
        term = term * a * (h / f64::from(k));
        phi += term;
        integral += term * (h / f64::from(k + 1));
    }
    (phi, integral * b)
}

/// The gains K of u = K x that minimise Σ xᵀ Q x + r u²: the Riccati equation by structure-preserving
/// doubling (Chu, Fan, Lin, Wang, "Structure-preserving algorithms for periodic discrete-time algebraic
/// Riccati equations", 2004).
fn regulator(phi: &Matrix, gamma: &Column, weights: &Matrix, r: f64) -> [f64; 4] {
    let (mut a, mut g, mut h) = (*phi, gamma * gamma.transpose() / r, *weights);
    for _ in 0..30 {
        let inverse = (Matrix::identity() + g * h).try_inverse().expect("a system that can be stabilised");
        let half = a * inverse;
        (a, g, h) = (half * a, g + half * g * a.transpose(), h + a.transpose() * h * inverse * a);
    }
    let scale = r + (gamma.transpose() * h * gamma).x;
    (-(gamma.transpose() * h * phi) / scale).transpose().into()
}

/// Position, angle and their rates are weighed by 1, 1, 0.1, 0.1; a force of 1 N by 0.1.
fn designed() -> [f64; 4] {
    let (a, b) = linearized();
    let (phi, gamma) = sampled(&a, &b, 1.0 / f64::from(RATE));
    regulator(&phi, &gamma, &Matrix::from_diagonal(&[1.0, 1.0, 0.1, 0.1].into()), 0.1)
}

#[test]
fn the_target_uses_the_gains_that_were_designed() {
    let designed = designed();
    std::println!("{designed:?}");
    for (gain, exact) in GAINS.iter().zip(designed) {
        assert!((f64::from(*gain) - exact).abs() < 1e-5 * exact.abs(), "{GAINS:?} against {designed:?}");
    }
}

/// The derivatives against differences of the accelerations.
#[test]
fn the_linearization_is_that_of_the_motion() {
    let (a, b) = linearized();
    let plant = CartPole::<f64>::laboratory();
    let at = |x: [f64; 4], u| {
        let state = State::new([x[0], x[1]], [x[2], x[3]]);
        plant.accelerations(&state, &[u]).expect("a regular mass matrix")
    };
    let step = 1e-6;
    for i in 0..2 {
        for j in 0..4 {
            let [mut ahead, mut behind] = [[0.0; 4]; 2];
            (ahead[j], behind[j]) = (step, -step);
            let slope = (at(ahead, 0.0)[i] - at(behind, 0.0)[i]) / (2.0 * step);
            assert!((slope - a[(2 + i, j)]).abs() < 1e-7, "∂a[{i}]/∂x[{j}]");
        }
        let slope = (at([0.0; 4], step)[i] - at([0.0; 4], -step)[i]) / (2.0 * step);
        assert!((slope - b[2 + i]).abs() < 1e-7, "∂a[{i}]/∂u");
    }
}

/// The regulator of the target holds a plant that is integrated in `f64` under error control.
#[test]
fn it_balances_the_exact_plant() {
    let plant = CartPole::<f64>::laboratory();
    let mut motion = plant.simulate(State::at_rest([0.0, 0.3])).with_tolerance(1e-12);
    let mut forces = Vec::new();
    for k in 1..=3 * u32::from(RATE) {
        let [x, theta] = motion.state().q.map(|value| value as f32);
        let force = control(&State::new([x, theta], motion.state().v.map(|value| value as f32)));
        forces.push(force);
        motion.set_inputs([force.into()]);
        motion.advance_to(f64::from(k) / f64::from(RATE)).expect("a motion");
    }
    assert!(
        forces.iter().any(|force| force.abs() == STRONGEST),
        "the start is to be out of the linear range"
    );
    assert!(motion.state().iter().all(|x| x.abs() < 0.02), "{:?}", motion.state());
}
