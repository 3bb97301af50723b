// Imported from `two_link.urdf` by `cargo lagrange import`.
// Left out: stops of shoulder (--limits).
// Left out: dry friction in shoulder (--friction).

use lagrangian::prelude::*;

/// The robot `two-link arm`; `TwoLinkArm::default()` is the one of the file.
#[derive(Clone, Copy, Debug)]
pub struct TwoLinkArm {
    /// Gravitational acceleration [m/s²].
    pub gravity: f64,
}

impl Default for TwoLinkArm {
    fn default() -> Self {
        TwoLinkArm { gravity: 9.81 }
    }
}

#[lagrangian(coordinates = [base: Pose, shoulder, elbow])]
#[allow(dead_code, clippy::approx_constant)]
impl TwoLinkArm {
    /// The frame of `base`, which moves freely.
    pub fn base_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        q.base.translation * q.base.rotation.to_rotation_matrix()
    }

    /// The frame of `upper`, turned by `shoulder`.
    pub fn upper_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.base_frame(q)
            * Translation3::new(0.0, 0.0, 0.5)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), q.shoulder)
    }

    /// The frame of `lower`, turned by `elbow`.
    pub fn lower_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.upper_frame(q)
            * Translation3::new(0.0, 0.1, -0.4)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), q.elbow)
    }

    /// The mass of `upper`.
    #[body(mass = 1.5, inertia = [0.02, 0.03, 0.01])]
    pub fn upper_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.upper_frame(q) * Translation3::new(0.0, 0.0, -0.2)
    }

    /// The mass of `lower`.
    #[body(mass = 0.8, inertia = [0.01, 0.012, 0.004])]
    pub fn lower_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.lower_frame(q) * Translation3::new(0.0, 0.0, -0.15)
    }

    /// The potential of the weight.
    #[potential]
    pub fn weight(&self, q: &Coordinates) -> f64 {
        self.gravity
            * (1.5 * self.upper_body(q).translation.z
                + 0.8 * self.lower_body(q).translation.z)
    }

    /// Viscous damping in the joints: half its power.
    #[dissipation]
    pub fn damping(&self, v: &Velocities) -> f64 {
        0.5 * (0.2 * v.shoulder.powi(2) + 0.1 * v.elbow.powi(2))
    }
}
