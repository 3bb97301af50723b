//! Linear models where constraints restrict velocities and no place.

use lagrangian::prelude::*;

use crate::support::close::{close, close_on};

/// A skate on a plane, tied to a place by a spring, with friction of air.
struct Skate {
    air: [f64; 2],
}

#[lagrangian(coordinates = [x, y, theta], jacobians)]
impl Skate {
    #[body(mass = 2.0, inertia = 0.3)]
    fn blade(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, q.y), q.theta)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        4.0 * (q.x.powi(2) + q.y.powi(2))
    }

    #[dissipation]
    fn air(&self, v: &Velocities) -> f64 {
        0.5 * (self.air[0] * (v.x.powi(2) + v.y.powi(2)) + self.air[1] * v.theta.powi(2))
    }

    #[nonholonomic]
    fn blade_holds(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.y * q.theta.cos() - v.x * q.theta.sin()
    }
}

#[test]
fn nonholonomic_constraints_bear_forces_but_restrict_no_place() {
    let skate = Skate { air: [0.0; 2] };
    let rest = skate.equilibrium([0.7, -0.3, 0.2], &[]).unwrap();
    let [x, y, theta] = rest.state.q;
    // The spring is across the blade, and the blade bears it; nearby rests a whole family.
    close(x * theta.cos() + y * theta.sin(), 0.0, 1e-14);
    close(rest.multipliers[0], 8.0 * (y * theta.cos() - x * theta.sin()), 1e-13);
    assert!(x.hypot(y) > 0.1 && !rest.is_isolated);
    let model = skate.linearize(&rest.state, &[]).unwrap();
    assert_eq!((model.order(), model.displacements.len(), model.velocities.len()), (5, 3, 2));
    close(model.drift::<5>().unwrap().norm(), 0.0, 1e-13);
    // Along the blade it oscillates; a turn needs no force, but turns the spring along the blade.
    let modes = skate.modes(&rest.state, &[]).unwrap();
    close(modes.last().unwrap().frequency(), 2.0, 1e-12);
}

/// With the spring across the blade, at a distance of 0.4 m. Along the blade m s″ + c s′ + k s + λ δθ = 0,
/// because a turn by δθ turns the force λ = k 0.4 m along the blade, and J θ″ + d θ′ = 0.
#[test]
fn matrices_act_on_the_velocities_and_displacements_that_constraints_allow() {
    let (sin, cos) = 0.6_f64.sin_cos();
    let state = State::at_rest([-0.4 * sin, 0.4 * cos, 0.6]);
    let model = Skate { air: [1.5, 0.7] }.linearize(&state, &[]).unwrap();
    let (along, across, turn) = (Vector3::new(cos, sin, 0.0), Vector3::new(-sin, cos, 0.0), Vector3::z());
    let velocity = |x: &Vector3<f64>| model.velocities.components(x);
    let displacement = |x: &Vector3<f64>| model.displacements.components(x);
    let (mass, damping) = (model.on_velocities(&model.mass), model.on_velocities(&model.damping));
    let stiffness = model.on_displacements(&model.stiffness);
    for (direction, m, c) in [(along, 2.0, 1.5), (turn, 0.3, 0.7)] {
        let y = velocity(&direction);
        close(y.dot(&(mass * y)), m, 1e-14);
        close(y.dot(&(damping * y)), c, 1e-14);
    }
    close(velocity(&along).dot(&(damping * velocity(&turn))), 0.0, 1e-14);
    for (place, along_blade) in [(along, 8.0), (across, 0.0), (turn, 8.0 * 0.4)] {
        let force = stiffness * displacement(&place);
        close_on(8.0, velocity(&along).dot(&force), along_blade, 1e-13);
        close_on(8.0, velocity(&turn).dot(&force), 0.0, 1e-13);
    }

    // η̇ = −M⁻¹ (C + G) η − M⁻¹ K ξ, where M is 1 in this basis.
    let gyroscopic = model.on_velocities(&model.gyroscopic);
    let all = model.state_matrix::<5>().unwrap();
    for i in 0..2 {
        for j in 0..2 {
            close(mass[(i, j)], f64::from(u8::from(i == j)), 1e-14);
            close(all[(3 + i, 3 + j)], -damping[(i, j)] - gyroscopic[(i, j)], 1e-13);
        }
        for j in 0..3 {
            close(all[(3 + i, j)], -stiffness[(i, j)], 1e-13);
        }
    }
}
