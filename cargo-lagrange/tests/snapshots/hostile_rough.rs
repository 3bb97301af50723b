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
    coordinates = [q, self_, as_vector, gravity, motors: Pose],
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

    /// The frame of `Vector3`, moved by `motors`.
    pub fn vector3_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        q.motors.translation * q.motors.rotation.to_rotation_matrix()
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

    /// The motor of `q`.
    #[force(on = q)]
    pub fn q_motor(&self, u: &Inputs) -> f64 {
        u.q_torque
    }

    /// The motor of `self_`.
    #[force(on = self_)]
    pub fn self_motor(&self, u: &Inputs) -> f64 {
        u.self_force
    }

    /// The motor of `as_vector`.
    #[force(on = as_vector)]
    pub fn as_vector_motor(&self, u: &Inputs) -> f64 {
        u.as_vector_torque
    }

    /// The motor of `gravity`.
    #[force(on = gravity)]
    pub fn gravity_motor(&self, u: &Inputs) -> f64 {
        u.gravity_torque
    }
}
