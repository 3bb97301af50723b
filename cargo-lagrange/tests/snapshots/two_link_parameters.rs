// Imported from `two_link.urdf` by `cargo lagrange import`.
// Left out: stops of shoulder (--limits).
// Left out: dry friction in shoulder (--friction).

use lagrangian::prelude::*;

/// The robot `two-link arm`; `TwoLinkArm::default()` is the one of the file.
#[derive(Clone, Copy, Debug)]
#[allow(dead_code)] // Not every moment of inertia has a say in the equations.
pub struct TwoLinkArm {
    /// Gravitational acceleration [m/s²].
    pub gravity: f64,
    /// How far `upper` is off along z of what it hangs on, in m.
    pub upper_z: f64,
    /// How far `lower` is off along y of what it hangs on, in m.
    pub lower_y: f64,
    /// How far `lower` is off along z of what it hangs on, in m.
    pub lower_z: f64,
    /// The mass of `upper`, in kg.
    pub upper_mass: f64,
    /// The centre of mass of `upper` along z of its frame, in m.
    pub upper_centre_z: f64,
    /// The moment of inertia of `upper` about x through its centre [kg·m²].
    pub upper_inertia_xx: f64,
    /// The moment of inertia of `upper` about y through its centre [kg·m²].
    pub upper_inertia_yy: f64,
    /// The moment of inertia of `upper` about z through its centre [kg·m²].
    pub upper_inertia_zz: f64,
    /// The mass of `lower`, in kg.
    pub lower_mass: f64,
    /// The centre of mass of `lower` along z of its frame, in m.
    pub lower_centre_z: f64,
    /// The moment of inertia of `lower` about x through its centre [kg·m²].
    pub lower_inertia_xx: f64,
    /// The moment of inertia of `lower` about y through its centre [kg·m²].
    pub lower_inertia_yy: f64,
    /// The moment of inertia of `lower` about z through its centre [kg·m²].
    pub lower_inertia_zz: f64,
}

#[allow(clippy::approx_constant)]
impl Default for TwoLinkArm {
    fn default() -> Self {
        TwoLinkArm {
            gravity: 9.81,
            upper_z: 0.5,
            lower_y: 0.1,
            lower_z: -0.4,
            upper_mass: 1.5,
            upper_centre_z: -0.2,
            upper_inertia_xx: 0.02,
            upper_inertia_yy: 0.03,
            upper_inertia_zz: 0.01,
            lower_mass: 0.8,
            lower_centre_z: -0.15,
            lower_inertia_xx: 0.01,
            lower_inertia_yy: 0.012,
            lower_inertia_zz: 0.004,
        }
    }
}

#[lagrangian(coordinates = [shoulder, elbow], inputs = [shoulder_torque, elbow_torque], jacobians)]
#[allow(dead_code, clippy::approx_constant)]
impl TwoLinkArm {
    /// The frame of `upper`, turned by `shoulder`.
    pub fn upper_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        Translation3::new(0.0, 0.0, self.upper_z)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), q.shoulder)
    }

    /// The frame of `lower`, turned by `elbow`.
    pub fn lower_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.upper_frame(q)
            * Translation3::new(0.0, self.lower_y, self.lower_z)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), q.elbow)
    }

    /// The mass of `upper`.
    #[body(mass = self.upper_mass, inertia = [
        self.upper_inertia_xx,
        self.upper_inertia_yy,
        self.upper_inertia_zz,
    ])]
    pub fn upper_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.upper_frame(q) * Translation3::new(0.0, 0.0, self.upper_centre_z)
    }

    /// The mass of `lower`.
    #[body(mass = self.lower_mass, inertia = [
        self.lower_inertia_xx,
        self.lower_inertia_yy,
        self.lower_inertia_zz,
    ])]
    pub fn lower_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.lower_frame(q) * Translation3::new(0.0, 0.0, self.lower_centre_z)
    }

    /// The potential of the weight.
    #[potential]
    pub fn weight(&self, q: &Coordinates) -> f64 {
        self.gravity
            * (self.upper_mass * self.upper_body(q).translation.z
                + self.lower_mass * self.lower_body(q).translation.z)
    }

    /// Viscous damping in the joints: half its power.
    #[dissipation]
    pub fn damping(&self, v: &Velocities) -> f64 {
        0.5 * (0.2 * v.shoulder.powi(2) + 0.1 * v.elbow.powi(2))
    }

    /// The forces and torques of the motors.
    #[force]
    pub fn motors(&self, u: &Inputs) -> [f64; 2] {
        [u.shoulder_torque, u.elbow_torque]
    }
}
