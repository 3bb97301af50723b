// Imported from `tied.xml` by `cargo lagrange import`.

use lagrangian::prelude::*;

/// The robot `tied`; `Tied::default()` is the one of the file.
#[derive(Clone, Copy, Debug)]
pub struct Tied {
    /// Gravitational acceleration [m/s²].
    pub gravity: f64,
}

impl Default for Tied {
    fn default() -> Self {
        Tied { gravity: 9.81 }
    }
}

#[lagrangian(coordinates = [one, two, three, rail])]
#[allow(dead_code, clippy::approx_constant)]
impl Tied {
    /// The frame of `a`, turned by `one`.
    pub fn a_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        Translation3::new(0.0, 1.0, 0.0) * Rotation3::from_axis_angle(&Vector3::y_axis(), q.one)
    }

    /// The frame of `b`, turned by `two`.
    pub fn b_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        Translation3::new(0.0, 2.0, 0.0)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), q.two - 0.3490658503988659)
    }

    /// The frame of `c`, turned by `three`.
    pub fn c_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        Translation3::new(0.0, 3.0, 0.0) * Rotation3::from_axis_angle(&Vector3::y_axis(), q.three)
    }

    /// The frame of `d`, shifted by `rail`.
    pub fn d_frame(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        Translation3::new(0.0, 4.0, 0.0)
            * Translation3::new(q.rail, 0.0, 0.0)
            * Rotation3::identity()
    }

    /// The mass of `a`.
    #[body(mass = 1.0, inertia = [
        0.004000000000000001,
        0.004000000000000001,
        0.004000000000000001,
    ])]
    pub fn a_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.a_frame(q) * Translation3::new(0.0, 0.0, -0.5)
    }

    /// The mass of `b`.
    #[body(mass = 2.0, inertia = [
        0.008000000000000002,
        0.008000000000000002,
        0.008000000000000002,
    ])]
    pub fn b_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.b_frame(q) * Translation3::new(0.0, 0.0, -0.4)
    }

    /// The mass of `c`.
    #[body(mass = 3.0, inertia = [
        0.012000000000000004,
        0.012000000000000004,
        0.012000000000000004,
    ])]
    pub fn c_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.c_frame(q) * Translation3::new(0.0, 0.0, -0.3)
    }

    /// The mass of `d`.
    #[body(mass = 4.0, inertia = [
        0.016000000000000004,
        0.016000000000000004,
        0.016000000000000004,
    ])]
    pub fn d_body(&self, q: &Coordinates) -> IsometryMatrix3<f64> {
        self.d_frame(q)
    }

    /// The potential of the weight.
    #[potential]
    pub fn weight(&self, q: &Coordinates) -> f64 {
        self.gravity
            * (1.0 * self.a_body(q).translation.z
                + 2.0 * self.b_body(q).translation.z
                + 3.0 * self.c_body(q).translation.z
                + 4.0 * self.d_body(q).translation.z)
    }

    /// `one` follows `two`.
    #[holonomic]
    pub fn one_mimic(&self, q: &Coordinates) -> f64 {
        q.one - 2.0 * q.two + 0.5981317007977318
    }

    /// `one` follows `three`.
    #[holonomic]
    pub fn one_mimic_2(&self, q: &Coordinates) -> f64 {
        q.one - q.three
    }

    /// `rail` is tied to a value.
    #[holonomic]
    pub fn rail_mimic(&self, q: &Coordinates) -> f64 {
        q.rail - 0.05
    }
}
