// Imported from `hostile.urdf` by `cargo lagrange import`.

use lagrangian::prelude::*;

/// The robot `state`; `State::default()` is the one of the file.
#[derive(Clone, Copy, Debug)]
pub struct State {
    /// Gravitational acceleration [m/s²].
    pub gravity: f64,
}

impl Default for State {
    fn default() -> Self {
        State { gravity: 9.81 }
    }
}

#[lagrangian(
    coordinates = [
        q,
        self_,
        as_vector,
        gravity,
        motors_x,
        motors_y,
        motors_z,
        motors_roll,
        motors_pitch,
        motors_yaw,
    ],
    inputs = [q_torque, self_force, as_vector_torque, gravity_torque],
)]
#[allow(dead_code, clippy::approx_constant)]
impl State {
    /// The frame of `energy`, turned by `q`.
    pub fn energy_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        Translation3::identity() * Rotation3::from_axis_angle(&Vector3::y_axis(), q.q)
    }

    /// The frame of `Mass Matrix`, shifted by `self`.
    pub fn mass_matrix_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.energy_frame(q)
            * Translation3::new(0.0, -0.7071067811865475 * q.self_, 0.7071067811865475 * q.self_)
    }

    /// The frame of `simulate`, turned by `as_vector`.
    pub fn simulate_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.energy_frame(q) * Rotation3::from_axis_angle(&Vector3::y_axis(), q.as_vector)
    }

    /// The frame of `weight`, turned by `gravity`.
    pub fn weight_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.simulate_frame(q) * Rotation3::from_axis_angle(&Vector3::z_axis(), -q.gravity)
    }

    /// The orientation of `Vector3`: roll, pitch and yaw about fixed axes.
    pub fn vector3_orientation(&self, q: &Coordinates) -> Rotation3<f64> {
        Rotation3::from_euler_angles(q.motors_roll, q.motors_pitch, q.motors_yaw)
    }

    /// The frame of `Vector3`, moved by `motors`.
    pub fn vector3_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        Translation3::new(q.motors_x, q.motors_y, q.motors_z) * self.vector3_orientation(q)
    }

    /// The mass of `energy`.
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    pub fn energy_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.energy_frame(q) * Translation3::new(0.1, 0.0, 0.0)
    }

    /// The mass of `Mass Matrix`.
    #[body(mass = 3.14, inertia = [1.0, 1.0, 1.0])]
    pub fn mass_matrix_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.mass_matrix_frame(q) * Translation3::new(0.1, 0.0, 0.0)
    }

    /// The mass of `simulate`.
    #[body(mass = 2.0, inertia = [1.0, 1.0, 1.0])]
    pub fn simulate_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.simulate_frame(q) * Translation3::new(0.1, 0.0, 0.0)
    }

    /// The mass of `weight`.
    #[body(mass = 2.0, inertia = [1.0, 1.0, 1.0])]
    pub fn weight_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.weight_frame(q) * Translation3::new(0.1, 0.0, 0.0)
    }

    /// The mass of `Vector3`.
    #[body(mass = 2.0, inertia = [1.0, 1.0, 1.0])]
    pub fn vector3_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.vector3_frame(q)
    }

    /// The potential of the weight.
    #[potential]
    pub fn weight(&self, q: &Coordinates) -> f64 {
        self.gravity
            * (1.0 * self.energy_body(q).translation.z
                + 3.14 * self.mass_matrix_body(q).translation.z
                + 2.0 * self.simulate_body(q).translation.z
                + 2.0 * self.weight_body(q).translation.z
                + 2.0 * self.vector3_body(q).translation.z)
    }

    /// Viscous damping in the joints: half its power.
    #[dissipation]
    pub fn damping(&self, v: &Velocities) -> f64 {
        0.5 * (1.0 * v.q.powi(2) + 1.0 * v.self_.powi(2) + 1.0 * v.as_vector.powi(2))
    }

    /// Dry friction in `q`.
    #[friction(limit = 1.0)]
    pub fn q_friction(&self, v: &Velocities) -> f64 {
        v.q
    }

    /// Dry friction in `self`.
    #[friction(limit = 1.0)]
    pub fn self_friction(&self, v: &Velocities) -> f64 {
        v.self_
    }

    /// Dry friction in `as_vector`.
    #[friction(limit = 1.0)]
    pub fn as_vector_friction(&self, v: &Velocities) -> f64 {
        v.as_vector
    }

    /// The stops of `q`, lower and upper.
    #[unilateral]
    pub fn q_limits(&self, q: &Coordinates) -> [f64; 2] {
        [q.q + 1.0, 1.0 - q.q]
    }

    /// The stops of `self`, lower and upper.
    #[unilateral]
    pub fn self_limits(&self, q: &Coordinates) -> [f64; 2] {
        [q.self_ + 1.0, 1.0 - q.self_]
    }

    /// `as_vector` follows `self`.
    #[holonomic]
    pub fn as_vector_mimic(&self, q: &Coordinates) -> f64 {
        q.as_vector - 2.0 * q.self_
    }

    /// The forces and torques of the motors.
    #[force]
    pub fn motors(&self, u: &Inputs) -> [f64; 10] {
        [
            u.q_torque,
            u.self_force,
            u.as_vector_torque,
            u.gravity_torque,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
        ]
    }
}
