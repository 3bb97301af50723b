// Imported from `joints.xml` by `cargo lagrange import`.
// Left out: dry friction in left (--friction).

use core::f64::consts::FRAC_PI_2;

use lagrangian::prelude::*;

/// The robot `joints`; `Joints::default()` is the one of the file.
#[derive(Clone, Copy, Debug)]
pub struct Joints {
    /// Gravitational acceleration [m/s²].
    pub gravity: f64,
}

impl Default for Joints {
    fn default() -> Self {
        Joints { gravity: 5.0 }
    }
}

#[lagrangian(
    coordinates = [yaw, roll, body_3: Rotation, left],
    inputs = [yaw_torque, roll_torque, left_force],
)]
#[allow(dead_code, clippy::approx_constant)]
impl Joints {
    /// The frame of `hip_part_1`, turned by `yaw`.
    pub fn hip_part_1_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        Translation3::new(0.0, -0.1, 1.0)
            * Rotation3::from_euler_angles(FRAC_PI_2, 0.0, 0.0)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.yaw - 0.2)
            * Translation3::new(0.0, 0.0, -0.1)
    }

    /// The frame of `hip`, turned by `roll`.
    pub fn hip_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.hip_part_1_frame(q) * Rotation3::from_axis_angle(&Vector3::x_axis(), q.roll)
    }

    /// The frame of `body_3`, moved by `body_3`.
    pub fn body_3_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.hip_frame(q)
            * Translation3::new(0.5, 0.0, 0.0)
            * Rotation3::from_euler_angles(0.0, 0.0, FRAC_PI_2)
            * q.body_3.to_rotation_matrix()
    }

    /// The frame of `left`, shifted by `left`.
    pub fn left_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.body_3_frame(q)
            * Translation3::new(0.1, 0.0, 0.4)
            * Translation3::new(0.0, 0.0, q.left)
    }

    /// The frame of `right`, shifted by `right`.
    pub fn right_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.body_3_frame(q)
            * Translation3::new(-0.1, 0.0, 0.4)
            * Rotation3::from_euler_angles(0.3, 0.2, 0.1)
            * Translation3::new(0.0, 0.0, -q.left + 0.01)
    }

    /// The mass of `hip`.
    #[body(mass = 4.188790204786391, inertia = [
        0.01675516081914557,
        0.01675516081914557,
        0.01675516081914557,
    ])]
    pub fn hip_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.hip_frame(q) * Translation3::new(0.3, 0.0, 0.0)
    }

    /// The mass of `body_3`.
    #[body(mass = 3.1415926535897936, inertia = [
        0.04385139745635754,
        0.04385139745635754,
        0.003926990816987243,
    ])]
    pub fn body_3_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.body_3_frame(q) * Translation3::new(0.0, 0.0, 0.2)
    }

    /// The mass of `left`.
    #[body(mass = 0.2, inertia = [0.005200000000000001, 0.004, 0.0020000000000000005])]
    pub fn left_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.left_frame(q)
    }

    /// The mass of `right`.
    #[body(mass = 0.2, inertia = [0.005200000000000001, 0.004, 0.0020000000000000005])]
    pub fn right_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.right_frame(q)
    }

    /// How high a place is, against the direction of gravity, in m.
    fn height(&self, place: &Translation3<f64>) -> f64 {
        -0.6 * place.y + 0.8 * place.z
    }

    /// The potential of the weight.
    #[potential]
    pub fn weight(&self, q: &Coordinates) -> f64 {
        self.gravity
            * (4.188790204786391 * self.height(&self.hip_body(q).translation)
                + 3.1415926535897936 * self.height(&self.body_3_body(q).translation)
                + 0.2 * self.height(&self.left_body(q).translation)
                + 0.2 * self.height(&self.right_body(q).translation))
    }

    /// The motor of `yaw`.
    #[force(on = yaw)]
    pub fn yaw_motor(&self, u: &Inputs) -> f64 {
        u.yaw_torque
    }

    /// The motor of `roll`.
    #[force(on = roll)]
    pub fn roll_motor(&self, u: &Inputs) -> f64 {
        u.roll_torque
    }

    /// The motor of `left`.
    #[force(on = left)]
    pub fn left_motor(&self, u: &Inputs) -> f64 {
        u.left_force
    }
}
