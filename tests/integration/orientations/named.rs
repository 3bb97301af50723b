//! Momenta, torques, accelerations and the mass matrix in body axes, against Euler's equations.

use lagrangian::prelude::*;
use nalgebra::{Matrix3, SMatrix};

use crate::support::close::{all_close, close};

const MOMENTS: [f64; 3] = [1.0, 2.0, 3.0];
const MASS: f64 = 1.5;

/// A body under a torque in its axes and a force in space.
struct Craft;

#[lagrangian(coordinates = [hull: Pose, wheel])]
impl Craft {
    #[body(mass = MASS, inertia = MOMENTS)]
    fn body(&self, q: &Coordinates) -> Isometry3<f64> {
        q.hull
    }

    #[kinetic]
    fn apart(&self, v: &Velocities) -> f64 {
        0.5 * v.wheel.powi(2)
    }

    #[force(at = body)]
    fn load(&self, q: &Coordinates) -> (Vector3<f64>, Vector3<f64>) {
        (Vector3::new(0.3, -0.1, 0.2), q.hull.rotation * Vector3::new(0.5, 0.4, -0.7))
    }
}

#[test]
fn what_belongs_to_angular_velocities_is_in_body_axes() {
    let omega = Vector3::new(0.4, -1.3, 0.8);
    let velocity = PoseVelocity { linear: Vector3::new(0.1, 0.2, 0.3), angular: omega };
    let hull = Isometry3::new(Vector3::new(1.0, 2.0, 3.0), Vector3::new(1.1, -0.7, 1.6));
    let state =
        Craft.state(CraftCoordinates { hull, wheel: 0.0 }, CraftVelocities { hull: velocity, wheel: 2.0 });
    let axes = Craft.body_axes(&state);
    let inertia = Matrix3::from_diagonal(&MOMENTS.into());
    let torque = Vector3::new(0.5, 0.4, -0.7);

    let found = CraftVelocities::from(axes.velocities());
    all_close(found.hull.angular, omega, 1e-14);
    all_close(found.hull.linear, velocity.linear, 1e-15);
    close(found.wheel, 2.0, 1e-15);

    let momenta = CraftVelocities::from(axes.loads(Craft.momenta(&state)));
    all_close(momenta.hull.angular, inertia * omega, 1e-13);
    all_close(momenta.hull.linear, velocity.linear * MASS, 1e-14);

    let forces = CraftVelocities::from(axes.loads(Craft.applied_forces(&state)));
    all_close(forces.hull.angular, torque, 1e-13);
    all_close(forces.hull.linear, [0.3, -0.1, 0.2], 1e-14);

    // Euler's equations: I ω′ = I ω × ω + τ.
    let a = Craft.accelerations(&state).unwrap();
    let rates = CraftVelocities::from(axes.accelerations(a));
    let expected = Vector3::from(MOMENTS)
        .map(|moment| 1.0 / moment)
        .component_mul(&((inertia * omega).cross(&omega) + torque));
    all_close(rates.hull.angular, expected, 1e-13);
    all_close(axes.second_rates(axes.accelerations(a)), a, 1e-13);

    let mass = axes.matrix(&Craft.mass_matrix(&state));
    let mut expected = SMatrix::<f64, 7, 7>::from_diagonal_element(MASS);
    expected.fixed_view_mut::<3, 3>(3, 3).copy_from(&inertia);
    expected[(6, 6)] = 1.0;
    all_close(mass - expected, SMatrix::<f64, 7, 7>::zeros(), 1e-12);
}

/// An orientation beside a coordinate that a constraint gives.
struct Geared;

#[lagrangian(coordinates = [pinion, wheel, attitude: Rotation])]
impl Geared {
    #[body(mass = 1.0, inertia = MOMENTS)]
    fn body(&self, q: &Coordinates) -> (Vector3<f64>, UnitQuaternion<f64>) {
        (Vector3::zeros(), q.attitude)
    }

    #[kinetic]
    fn gears(&self, v: &Velocities) -> f64 {
        0.5 * (v.pinion.powi(2) + v.wheel.powi(2))
    }

    #[holonomic(eliminate = pinion)]
    fn mesh(&self, q: &Coordinates) -> f64 {
        q.pinion + 3.0 * q.wheel
    }
}

#[test]
fn a_state_is_made_beside_coordinates_that_constraints_give() {
    let attitude = UnitQuaternion::new(Vector3::new(0.4, 2.0, -0.3));
    let coordinates = GearedCoordinates { pinion: -0.6, wheel: 0.2, attitude };
    let angular = Vector3::new(0.3, 0.2, 0.9);
    let velocities = GearedVelocities { pinion: -1.5, wheel: 0.5, attitude: angular };
    let state = Geared.state(coordinates, velocities);
    let found = (Geared.coordinates(&state), Geared.velocities(&state));
    all_close([found.0.pinion, found.0.wheel], [-0.6, 0.2], 1e-15);
    all_close([found.1.pinion, found.1.wheel], [-1.5, 0.5], 1e-15);
    all_close(found.1.attitude, angular, 1e-14);
    close(found.0.attitude.angle_to(&attitude), 0.0, 1e-12);
    close(Geared.kinetic_energy(&state), 0.5 * (1.5 * 1.5 + 0.25 + 0.09 + 0.08 + 2.43), 1e-14);
}
