// Imported from `floating.xml` by `cargo lagrange import`.

use lagrangian::prelude::*;

/// The robot `floating`; `Floating::default()` is the one of the file.
#[derive(Clone, Copy, Debug)]
pub struct Floating {
    /// Gravitational acceleration [m/s²].
    pub gravity: f64,
}

impl Default for Floating {
    fn default() -> Self {
        Floating { gravity: 9.81 }
    }
}

#[lagrangian(coordinates = [base: Pose, shoulder: Rotation, wrist], inputs = [wrist_torque])]
#[allow(dead_code, clippy::approx_constant)]
impl Floating {
    /// The frame of `hull`, which moves freely.
    pub fn hull_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        q.base.translation * q.base.rotation.to_rotation_matrix()
    }

    /// The frame of `arm`, moved by `shoulder`.
    pub fn arm_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.hull_frame(q)
            * Translation3::new(0.2, 0.0, 0.1)
            * Rotation3::from_euler_angles(0.3, 0.0, 0.0)
            * q.shoulder.to_rotation_matrix()
    }

    /// The frame of `hand`, turned by `wrist`.
    pub fn hand_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.arm_frame(q)
            * Translation3::new(0.0, 0.0, -0.3)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), q.wrist)
    }

    /// The mass of `hull`.
    #[body(mass = 2.0, inertia = [0.008333333333333335, 0.02833333333333334, 0.03333333333333334])]
    pub fn hull_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.hull_frame(q) * Translation3::new(0.01, 0.0, 0.0)
    }

    /// The mass of `arm`.
    #[body(mass = 0.5, inertia = [0.0038625, 0.0038625, 0.000225])]
    pub fn arm_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.arm_frame(q) * Translation3::new(0.0, 0.0, -0.15)
    }

    /// The mass of `hand`.
    #[body(mass = 0.2, inertia = [
        0.00045333333333333337,
        0.0005933333333333335,
        0.0001933333333333334,
    ])]
    pub fn hand_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.hand_frame(q) * Translation3::new(0.0, 0.01, -0.1)
    }

    /// The potential of the weight.
    #[potential]
    pub fn weight(&self, q: &Coordinates) -> f64 {
        self.gravity
            * (2.0 * self.hull_body(q).translation.z
                + 0.5 * self.arm_body(q).translation.z
                + 0.2 * self.hand_body(q).translation.z)
    }

    /// The energy of rotors in the joints.
    #[kinetic]
    pub fn armature(&self, v: &Velocities) -> f64 {
        0.5
            * (0.02 * (v.base.linear.norm_squared() + v.base.angular.norm_squared())
                + 0.01 * v.shoulder.norm_squared())
    }

    /// Viscous damping in the joints: half its power.
    #[dissipation]
    pub fn damping(&self, v: &Velocities) -> f64 {
        0.5
            * (0.3 * (v.base.linear.norm_squared() + v.base.angular.norm_squared())
                + 0.1 * v.shoulder.norm_squared()
                + 0.05 * v.wrist.powi(2))
    }

    /// The motor of `wrist`.
    #[force(on = wrist)]
    pub fn wrist_motor(&self, u: &Inputs) -> f64 {
        3.0 * u.wrist_torque
    }
}
