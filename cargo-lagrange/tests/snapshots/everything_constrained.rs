// Imported from `everything.urdf` by `cargo lagrange import`.
// Left out: stops of Slide-Joint, type, follower (--limits).
// Left out: dry friction in Slide-Joint, follower (--friction).

use core::f64::consts::{FRAC_PI_2, PI};

use lagrangian::prelude::*;

/// The robot `everything`; `Everything::default()` is the one of the file.
#[derive(Clone, Copy, Debug)]
pub struct Everything {
    /// Gravitational acceleration [m/s²].
    pub gravity: f64,
}

impl Default for Everything {
    fn default() -> Self {
        Everything { gravity: 9.81 }
    }
}

#[lagrangian(
    coordinates = [slide_joint, type_, follower, puck_x, puck_y, puck_angle, drone: Pose],
    inputs = [slide_joint_force, type_torque, follower_torque],
)]
#[allow(dead_code, clippy::approx_constant)]
impl Everything {
    /// The frame of `base_link`, which stands still.
    pub fn base_link_frame(&self) -> IsometryMatrix3<f64> {
        Translation3::new(0.0, 0.0, 1.0) * Rotation3::identity()
    }

    /// The frame of `Slider`, shifted by `Slide-Joint`.
    pub fn slider_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.base_link_frame()
            * Translation3::new(0.1, 0.0, 0.0)
            * Rotation3::from_euler_angles(FRAC_PI_2, 0.0, -1.5707963)
            * Translation3::new(0.0, -q.slide_joint, 0.0)
    }

    /// The frame of `box`, fixed to `Slider`.
    pub fn box_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.slider_frame(q)
            * Translation3::new(0.0, 0.0, 0.5)
            * Rotation3::from_euler_angles(0.0, 0.0, PI)
    }

    /// The frame of `tip`, fixed to `box`.
    pub fn tip_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.box_frame(q)
            * Translation3::new(0.0, 0.0, 0.1)
            * Rotation3::from_euler_angles(0.3, 0.0, 0.0)
    }

    /// The frame of `finger 1`, turned by `type`.
    pub fn finger_1_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.tip_frame(q)
            * Rotation3::from_axis_angle(
                &Unit::new_unchecked(Vector3::new(0.7071067811865475, 0.7071067811865475, 0.0)),
                q.type_,
            )
    }

    /// The frame of `finger-1`, turned by `follower`.
    pub fn finger_1_2_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.tip_frame(q)
            * Translation3::new(0.0, 0.05, 0.0)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.follower)
    }

    /// The frame of `puck`, moved by `puck`.
    pub fn puck_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.base_link_frame()
            * Translation3::new(0.0, q.puck_x, q.puck_y)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.puck_angle)
    }

    /// The frame of `drone`, moved by `drone`.
    pub fn drone_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        q.drone.translation * q.drone.rotation.to_rotation_matrix()
    }

    /// The mass of `Slider` with `box` fixed to it.
    #[body(mass = 4.0, inertia = Matrix3::new(
        0.55, 0.01, 0.1,
        0.01, 0.5900000000000001, 0.0,
        0.1, 0.0, 0.44000000000000006,
    ))]
    pub fn slider_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.slider_frame(q) * Translation3::new(-0.1, 0.0, 0.25)
    }

    /// The mass of `finger 1`.
    #[body(mass = 0.3, inertia = [0.001, 0.001, 0.001])]
    pub fn finger_1_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.finger_1_frame(q) * Translation3::new(0.0, 0.1, 0.0)
    }

    /// The mass of `finger-1`.
    #[body(mass = 0.3, inertia = [0.001, 0.001, 0.001])]
    pub fn finger_1_2_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.finger_1_2_frame(q) * Translation3::new(0.0, 0.1, 0.0)
    }

    /// The mass of `puck`.
    #[body(mass = 0.5, inertia = [0.002, 0.001, 0.001])]
    pub fn puck_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.puck_frame(q)
    }

    /// The mass of `drone`.
    #[body(mass = 0.9, inertia = Matrix3::new(
        0.020394695029985574, 0.0, 0.001947091711543252,
        0.0, 0.02, 0.0,
        0.001947091711543252, 0.0, 0.029605304970014425,
    ))]
    pub fn drone_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.drone_frame(q)
    }

    /// The potential of the weight.
    #[potential]
    pub fn weight(&self, q: &Coordinates) -> f64 {
        self.gravity
            * (4.0 * self.slider_body(q).translation.z
                + 0.3 * self.finger_1_body(q).translation.z
                + 0.3 * self.finger_1_2_body(q).translation.z
                + 0.5 * self.puck_body(q).translation.z
                + 0.9 * self.drone_body(q).translation.z)
    }

    /// Viscous damping in the joints: half its power.
    #[dissipation]
    pub fn damping(&self, v: &Velocities) -> f64 {
        0.5 * (0.5 * v.slide_joint.powi(2) + 0.02 * v.follower.powi(2))
    }

    /// `follower` follows `type`.
    #[holonomic]
    pub fn follower_mimic(&self, q: &Coordinates) -> f64 {
        q.follower + 0.5 * q.type_ - 0.1
    }

    /// The motor of `slide_joint`.
    #[force(on = slide_joint)]
    pub fn slide_joint_motor(&self, u: &Inputs) -> f64 {
        u.slide_joint_force
    }

    /// The motor of `type_`.
    #[force(on = type_)]
    pub fn type_motor(&self, u: &Inputs) -> f64 {
        u.type_torque
    }

    /// The motor of `follower`.
    #[force(on = follower)]
    pub fn follower_motor(&self, u: &Inputs) -> f64 {
        u.follower_torque
    }
}
