//! Equations of motion and their integration from a Lagrangian, at compile time.
//!
//! Write a mechanical system the way a textbook does (positions or T and V, forces) in ordinary
//! Rust, put [`#[lagrangian]`](macro@lagrangian) on it, and get its equations of motion and its motion:
//! monomorphised, allocation-free, `no_std`, readable under `cargo expand`.
//!
//! ```
//! use lagrangian::prelude::*;
//!
//! /// Two point masses on massless rods, swinging in a vertical plane.
//! #[derive(Clone, Copy, Debug)]
//! pub struct DoublePendulum {
//!     /// Masses [kg].
//!     pub m: [f64; 2],
//!     /// Rod lengths [m].
//!     pub l: [f64; 2],
//!     /// Gravitational acceleration [m/s²].
//!     pub g: f64,
//! }
//!
//! #[lagrangian(coordinates = [theta: [2]])]
//! impl DoublePendulum {
//!     #[point(mass = self.m[0])]
//!     fn upper(&self, q: &Coordinates) -> Vector2<f64> {
//!         self.l[0] * Vector2::new(q.theta[0].sin(), -q.theta[0].cos())
//!     }
//!
//!     #[point(mass = self.m[1])]
//!     fn lower(&self, q: &Coordinates) -> Vector2<f64> {
//!         self.upper(q) + self.l[1] * Vector2::new(q.theta[1].sin(), -q.theta[1].cos())
//!     }
//!
//!     #[potential]
//!     fn gravity(&self, q: &Coordinates) -> f64 {
//!         self.g * (self.m[0] * self.upper(q).y + self.m[1] * self.lower(q).y)
//!     }
//! }
//!
//! # fn main() -> Result<(), MotionError<f64>> {
//! let pendulum = DoublePendulum { m: [1.0, 1.0], l: [1.0, 1.0], g: 9.81 };
//! let mut motion = pendulum.simulate(State::at_rest([2.0, 2.0]));
//! let start = motion.energy();
//! motion.advance_to(10.0)?;
//! assert!((motion.energy() - start).abs() < 1e-8);
//! # Ok(())
//! # }
//! ```
#![no_std]
#![forbid(unsafe_code)]

pub use lagrange_macros::lagrangian_facade as lagrangian;
pub use lagrange_runtime::*;

/// What generated code names. No part of the public interface.
#[doc(hidden)]
pub use lagrange_runtime::__private;

/// Everything that a description and its use need: `use lagrangian::prelude::*;`.
pub mod prelude {
    pub use crate::lagrangian;
    pub use lagrange_runtime::__private::nalgebra::{
        Isometry2, Isometry3, IsometryMatrix2, IsometryMatrix3, Matrix2, Matrix3, Point1, Point2, Point3,
        Rotation2, Rotation3, SMatrix, SVector, Translation2, Translation3, Unit, UnitComplex,
        UnitQuaternion, Vector1, Vector2, Vector3,
    };
    pub use lagrange_runtime::{
        BlanesMoan4, BlanesMoan6, Cause, Dop853, Gauss4, Gauss6, Gauss8, Jet, Jets, Leapfrog, Linearized,
        MotionError, Ordered, Real, Rk4, Sensitive, State, System, Tangent, Yoshida4, Yoshida6, Yoshida8,
    };
}

/// The programs of the README are compiled and run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
