// Imported from `hostile.urdf` by `cargo lagrange import`.
// Left out: stops of q, self (--limits).
// Left out: dry friction in q, self, as_vector (--friction).

use lagrangian::prelude::*;

/// The robot `state`; `State::default()` is the one of the file.
#[derive(Clone, Copy, Debug)]
#[allow(dead_code)] // Not every moment of inertia has a say in the equations.
pub struct State {
    /// Gravitational acceleration [m/s²].
    pub gravity: f64,
    /// The mass of `energy`, in kg.
    pub energy_mass: f64,
    /// The centre of mass of `energy` along x of its frame, in m.
    pub energy_centre_x: f64,
    /// The moment of inertia of `energy` about x through its centre [kg·m²].
    pub energy_inertia_xx: f64,
    /// The moment of inertia of `energy` about y through its centre [kg·m²].
    pub energy_inertia_yy: f64,
    /// The moment of inertia of `energy` about z through its centre [kg·m²].
    pub energy_inertia_zz: f64,
    /// The mass of `Mass Matrix`, in kg.
    pub mass_matrix_mass: f64,
    /// The centre of mass of `Mass Matrix` along x of its frame, in m.
    pub mass_matrix_centre_x: f64,
    /// The moment of inertia of `Mass Matrix` about x through its centre [kg·m²].
    pub mass_matrix_inertia_xx: f64,
    /// The moment of inertia of `Mass Matrix` about y through its centre [kg·m²].
    pub mass_matrix_inertia_yy: f64,
    /// The moment of inertia of `Mass Matrix` about z through its centre [kg·m²].
    pub mass_matrix_inertia_zz: f64,
    /// The mass of `simulate`, in kg.
    pub simulate_mass: f64,
    /// The centre of mass of `simulate` along x of its frame, in m.
    pub simulate_centre_x: f64,
    /// The moment of inertia of `simulate` about x through its centre [kg·m²].
    pub simulate_inertia_xx: f64,
    /// The moment of inertia of `simulate` about y through its centre [kg·m²].
    pub simulate_inertia_yy: f64,
    /// The moment of inertia of `simulate` about z through its centre [kg·m²].
    pub simulate_inertia_zz: f64,
    /// The mass of `weight`, in kg.
    pub weight_mass: f64,
    /// The centre of mass of `weight` along x of its frame, in m.
    pub weight_centre_x: f64,
    /// The moment of inertia of `weight` about x through its centre [kg·m²].
    pub weight_inertia_xx: f64,
    /// The moment of inertia of `weight` about y through its centre [kg·m²].
    pub weight_inertia_yy: f64,
    /// The moment of inertia of `weight` about z through its centre [kg·m²].
    pub weight_inertia_zz: f64,
    /// The mass of `Vector3`, in kg.
    pub vector3_mass: f64,
    /// The moment of inertia of `Vector3` about x through its centre [kg·m²].
    pub vector3_inertia_xx: f64,
    /// The moment of inertia of `Vector3` about y through its centre [kg·m²].
    pub vector3_inertia_yy: f64,
    /// The moment of inertia of `Vector3` about z through its centre [kg·m²].
    pub vector3_inertia_zz: f64,
}

#[allow(clippy::approx_constant)]
impl Default for State {
    fn default() -> Self {
        State {
            gravity: 9.81,
            energy_mass: 1.0,
            energy_centre_x: 0.1,
            energy_inertia_xx: 1.0,
            energy_inertia_yy: 1.0,
            energy_inertia_zz: 1.0,
            mass_matrix_mass: 3.14,
            mass_matrix_centre_x: 0.1,
            mass_matrix_inertia_xx: 1.0,
            mass_matrix_inertia_yy: 1.0,
            mass_matrix_inertia_zz: 1.0,
            simulate_mass: 2.0,
            simulate_centre_x: 0.1,
            simulate_inertia_xx: 1.0,
            simulate_inertia_yy: 1.0,
            simulate_inertia_zz: 1.0,
            weight_mass: 2.0,
            weight_centre_x: 0.1,
            weight_inertia_xx: 1.0,
            weight_inertia_yy: 1.0,
            weight_inertia_zz: 1.0,
            vector3_mass: 2.0,
            vector3_inertia_xx: 1.0,
            vector3_inertia_yy: 1.0,
            vector3_inertia_zz: 1.0,
        }
    }
}

#[lagrangian(
    coordinates = [q, self_, gravity, motors: Pose],
    inputs = [q_torque, self_force, gravity_torque],
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
        self.energy_frame(q) * Rotation3::from_axis_angle(&Vector3::y_axis(), 2.0 * q.self_)
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
    #[body(mass = self.energy_mass, inertia = [
        self.energy_inertia_xx,
        self.energy_inertia_yy,
        self.energy_inertia_zz,
    ])]
    pub fn energy_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.energy_frame(q) * Translation3::new(self.energy_centre_x, 0.0, 0.0)
    }

    /// The mass of `Mass Matrix`.
    #[body(mass = self.mass_matrix_mass, inertia = [
        self.mass_matrix_inertia_xx,
        self.mass_matrix_inertia_yy,
        self.mass_matrix_inertia_zz,
    ])]
    pub fn mass_matrix_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.mass_matrix_frame(q) * Translation3::new(self.mass_matrix_centre_x, 0.0, 0.0)
    }

    /// The mass of `simulate`.
    #[body(mass = self.simulate_mass, inertia = [
        self.simulate_inertia_xx,
        self.simulate_inertia_yy,
        self.simulate_inertia_zz,
    ])]
    pub fn simulate_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.simulate_frame(q) * Translation3::new(self.simulate_centre_x, 0.0, 0.0)
    }

    /// The mass of `weight`.
    #[body(mass = self.weight_mass, inertia = [
        self.weight_inertia_xx,
        self.weight_inertia_yy,
        self.weight_inertia_zz,
    ])]
    pub fn weight_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.weight_frame(q) * Translation3::new(self.weight_centre_x, 0.0, 0.0)
    }

    /// The mass of `Vector3`.
    #[body(mass = self.vector3_mass, inertia = [
        self.vector3_inertia_xx,
        self.vector3_inertia_yy,
        self.vector3_inertia_zz,
    ])]
    pub fn vector3_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.vector3_frame(q)
    }

    /// The potential of the weight.
    #[potential]
    pub fn weight(&self, q: &Coordinates) -> f64 {
        self.gravity
            * (self.energy_mass * self.energy_body(q).translation.z
                + self.mass_matrix_mass * self.mass_matrix_body(q).translation.z
                + self.simulate_mass * self.simulate_body(q).translation.z
                + self.weight_mass * self.weight_body(q).translation.z
                + self.vector3_mass * self.vector3_body(q).translation.z)
    }

    /// Viscous damping in the joints: half its power.
    #[dissipation]
    pub fn damping(&self, v: &Velocities) -> f64 {
        0.5 * (1.0 * v.q.powi(2) + 1.0 * v.self_.powi(2) + 1.0 * (2.0 * v.self_).powi(2))
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

    /// The motor of `gravity`.
    #[force(on = gravity)]
    pub fn gravity_motor(&self, u: &Inputs) -> f64 {
        u.gravity_torque
    }
}
