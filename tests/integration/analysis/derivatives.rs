//! Generated derivatives against dual numbers, which differentiate the generated accelerations and
//! multipliers.

use lagrangian::{Constrained, Response, prelude::*};

use crate::support::close::close_on;
use crate::support::difference::{STEP, derivative};
use crate::support::dual::Dual;
use crate::support::sample::Samples;

/// A cart on a rail that shakes, with a pole on it whose tip is kept on a rope, and a blade that holds:
/// everything that a description may have.
struct Everything<R> {
    mass: R,
    length: R,
    damping: R,
}

#[lagrangian(coordinates = [x, y, theta, s], inputs = [push, wind], jacobians)]
impl<R: Real> Everything<R> {
    #[point(mass = self.mass)]
    fn cart(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[body(mass = 0.4, inertia = 0.07)]
    fn pole(&self, q: &Coordinates<R>) -> (Vector2<R>, R) {
        let half = Vector2::new(q.theta.sin(), q.theta.cos()) * (self.length * R::from_f64(0.5));
        (self.cart(q) + half, q.theta)
    }

    #[kinetic]
    fn flywheel(&self, q: &Coordinates<R>, v: &Velocities<R>) -> R {
        0.2 * (2.0 + q.s.sin()) * v.s * v.s + 0.1 * v.s * v.theta * q.x
    }

    #[potential]
    fn potential(&self, q: &Coordinates<R>, t: R) -> R {
        3.0 * self.pole(q).0.y + (q.s - q.theta).powi(4) + 0.5 * t.sin() * q.x * q.x
    }

    #[dissipation]
    fn damper(&self, q: &Coordinates<R>, v: &Velocities<R>) -> R {
        0.5 * self.damping * (v.x - v.s * q.y).powi(2) + 0.05 * v.theta.powi(4)
    }

    #[force(at = pole)]
    fn wind(&self, v: &Velocities<R>, u: &Inputs<R>) -> (Vector2<R>, R) {
        (Vector2::new(u.wind * u.wind - v.x, u.wind * v.s), u.push)
    }

    #[force(on = s)]
    fn push(&self, q: &Coordinates<R>, u: &Inputs<R>) -> R {
        u.push * q.theta.cos()
    }

    #[holonomic]
    fn rope(&self, q: &Coordinates<R>, t: R) -> R {
        let tip = self.pole(q).0;
        tip.x * tip.x + 2.0 * tip.y * tip.y - 3.0 - 0.1 * t.sin()
    }

    #[nonholonomic]
    fn blade(&self, q: &Coordinates<R>, v: &Velocities<R>, t: R) -> R {
        v.s * q.theta.cos() - v.x * q.theta.sin() + 0.3 * t.cos() * q.y
    }
}

fn constant(x: f64) -> Dual {
    Dual::constant(x)
}

/// Accelerations and multipliers with their derivatives in one direction of (q, v, t, u).
fn slopes(system: &Everything<f64>, state: &State<f64, 4>, u: [f64; 2], direction: usize) -> [f64; 6] {
    let system = Everything {
        mass: constant(system.mass),
        length: constant(system.length),
        damping: constant(system.damping),
    };
    let mut q = state.q.map(constant);
    let mut v = state.v.map(constant);
    let (mut t, mut u) = (constant(state.t), u.map(constant));
    match direction {
        0..4 => q[direction].slope = 1.0,
        4..8 => v[direction - 4].slope = 1.0,
        8 => t.slope = 1.0,
        _ => u[direction - 9].slope = 1.0,
    }
    let constants = system.constants();
    let a = system.accelerations_at(&constants, t, &q, &v, &u);
    let reactions = system.reactions_at(&constants, t, &q, &v, &u);
    [a[0], a[1], a[2], a[3], reactions.rope, reactions.blade].map(|x| x.slope)
}

fn column(response: &Response<f64, 4, 2, 2>, direction: usize) -> [f64; 6] {
    let mut found = [0.0; 6];
    for (i, found) in found.iter_mut().enumerate() {
        let (is_acceleration, c) = (i < 4, i.wrapping_sub(4));
        *found = match (direction, is_acceleration) {
            (0..4, true) => response.by_q[(i, direction)],
            (0..4, false) => response.multipliers_by_q[(c, direction)],
            (4..8, true) => response.by_v[(i, direction - 4)],
            (4..8, false) => response.multipliers_by_v[(c, direction - 4)],
            (8, true) => response.by_t[i],
            (8, false) => response.multipliers_by_t[c],
            (_, true) => response.by_u[(i, direction - 9)],
            (_, false) => response.multipliers_by_u[(c, direction - 9)],
        };
    }
    found
}

const SYSTEM: Everything<f64> = Everything { mass: 1.2, length: 0.8, damping: 0.3 };

#[test]
fn responses_are_the_derivatives_of_accelerations_and_multipliers() {
    let mut samples = Samples::new(11);
    for _ in 0..50 {
        let state = samples.state::<4>(0.2, 1.2);
        let u = [samples.number(-2.0, 2.0), samples.number(-2.0, 2.0)];
        let response = SYSTEM.response(&state, &u).unwrap();
        for direction in 0..11 {
            let expected = slopes(&SYSTEM, &state, u, direction);
            let scale = expected.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
            for (found, expected) in column(&response, direction).into_iter().zip(expected) {
                close_on(scale, found, expected, 1e-11);
            }
        }
    }
}

#[test]
fn jacobians_of_a_constrained_system_are_its_responses() {
    let state = Samples::new(3).state::<4>(0.2, 1.2);
    let u = [0.4, -0.7];
    let (response, jacobians) = (SYSTEM.response(&state, &u).unwrap(), SYSTEM.jacobians(&state, &u).unwrap());
    assert_eq!(jacobians.by_q, response.by_q);
    assert_eq!(jacobians.by_v, response.by_v);
    assert_eq!(jacobians.by_u, response.by_u);
}

#[test]
fn linear_models_describe_neighbouring_motions() {
    // On the tangent space of the constraints, A x is the change of the field; off it nothing is claimed.
    let start = State::new([0.6, 0.9, 0.4, 0.3], [0.2, -0.1, 0.4, 0.1]);
    let state = SYSTEM.consistent(start).unwrap();
    let u = [0.4, -0.7];
    let model = SYSTEM.linearize(&state, &u).unwrap();
    assert_eq!((model.displacements.len(), model.velocities.len()), (3, 2));
    let a = model.state_matrix::<5>().unwrap();
    let response = SYSTEM.response(&state, &u).unwrap();
    for k in 0..5 {
        let (dq, dv) = if k < 3 {
            let dq = model.displacements.iter().nth(k).unwrap();
            // The velocity that keeps df/dt and g at zero, of least size in M, from the constraints
            // themselves.
            let along = derivative(STEP, |x| {
                let moved = State { q: std::array::from_fn(|i| state.q[i] + x * dq[i]), ..state };
                SYSTEM.constraint_rates(&moved)
            });
            let gradients = SYSTEM.constraint_jacobian(&state);
            let mass = SYSTEM.mass_matrix(&state);
            let inverse = mass.try_inverse().unwrap();
            let normal = inverse * gradients.transpose();
            let schur = (gradients * normal).try_inverse().unwrap();
            (dq, normal * (schur * -SVector::from(along)))
        } else {
            (SVector::zeros(), model.velocities.iter().nth(k - 3).unwrap())
        };
        let upper = model.displacements.components(&dv);
        let lower = model.velocities.components(&(response.by_q * dq + response.by_v * dv));
        for i in 0..3 {
            close_on(1.0, a[(i, k)], upper[i], 1e-10);
        }
        for i in 0..2 {
            close_on(10.0, a[(3 + i, k)], lower[i], 1e-10);
        }
    }
    let drift = model.drift::<5>().unwrap();
    let components = model.displacements.components(&state.velocities());
    assert_eq!([drift[0], drift[1], drift[2]], [components[0], components[1], components[2]]);
}
