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
//!
//! With `jacobians` in the attribute the derivatives of the equations are generated too. With them the model
//! tells where it rests, how it oscillates there, and how its motion depends on the start. `sensitivities`
//! includes `jacobians` and adds derivatives by parameters:
//!
//! ```
//! use lagrangian::prelude::*;
//!
//! /// A bead on a hoop that whirls about its vertical diameter, by the angle from the top.
//! pub struct Hoop {
//!     /// Radius [m].
//!     pub radius: f64,
//!     /// Rate of the hoop [rad/s].
//!     pub rate: f64,
//! }
//!
//! #[lagrangian(coordinates = [phi], sensitivities = [self.rate])]
//! impl Hoop {
//!     #[kinetic]
//!     fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
//!         0.5 * self.radius.powi(2) * (v.phi.powi(2) + (self.rate * q.phi.sin()).powi(2))
//!     }
//!
//!     #[potential]
//!     fn gravity(&self, q: &Coordinates) -> f64 {
//!         9.81 * self.radius * q.phi.cos()
//!     }
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let hoop = Hoop { radius: 0.5, rate: 6.0 };
//! let rest = hoop.equilibrium([2.0], &[])?;
//! assert!((rest.state.q[0] - (-9.81_f64 / (0.5 * 36.0)).acos()).abs() < 1e-14);
//! # #[cfg(feature = "std")]
//! let modes = hoop.modes(&rest.state, &[])?;
//! # #[cfg(feature = "std")]
//! assert!((modes[0].frequency() - 6.0 * rest.state.q[0].sin()).abs() < 1e-13);
//! let model = hoop.linearize(&rest.state, &[])?;
//! let a: SMatrix<f64, 2, 2> = model.state_matrix().expect("one coordinate, one velocity");
//! assert!((a[(1, 0)] + (6.0 * rest.state.q[0].sin()).powi(2)).abs() < 1e-12);
//!
//! // How far off the bead is after a second, to first order, if the hoop turns faster by 0.0001 rad/s.
//! let varied = hoop.variational();
//! let mut motion = varied.motion(State::new([2.0], [0.3]))?;
//! let end = motion.advance_to(1.0)?;
//! let faster = Hoop { rate: 6.0001, ..hoop };
//! let mut other = faster.simulate(State::new([2.0], [0.3]));
//! let shift = other.advance_to(1.0)?.q[0] - end.state.q[0];
//! assert!((shift - 0.0001 * end.q_by_p[0]).abs() < 1e-6);
//! // A deviation from rest is the same after one of its periods: both multipliers are 1.
//! # #[cfg(feature = "std")]
//! let after = varied.monodromy(rest.state, core::f64::consts::TAU / modes[0].frequency())?;
//! # #[cfg(feature = "std")]
//! assert!(after.multipliers.iter().all(|x| (x.re - 1.0).abs() + x.im.abs() < 1e-6));
//! # Ok(())
//! # }
//! ```
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]

/// Many motions: threads, files that survive a kill, array jobs.
#[cfg(feature = "ensemble")]
pub use lagrange_ensemble as ensemble;
pub use lagrange_macros::lagrangian_facade as lagrangian;
/// Pictures of motions: phase portraits, energies, reactions, and drawings that move.
#[cfg(feature = "pictures")]
pub use lagrange_pictures as pictures;
pub use lagrange_runtime::*;

/// Items that generated code names. They are no part of the public interface.
#[doc(hidden)]
pub use lagrange_runtime::__private;

/// Everything that a description and its use need: `use lagrangian::prelude::*;`.
pub mod prelude {
    pub use crate::lagrangian;
    pub use lagrange_runtime::__private::nalgebra::{
        Isometry2, Isometry3, IsometryMatrix2, IsometryMatrix3, Matrix2, Matrix3, Point1, Point2, Point3,
        Quaternion, Rotation2, Rotation3, SMatrix, SVector, Translation2, Translation3, Unit, UnitComplex,
        UnitQuaternion, Vector1, Vector2, Vector3,
    };
    pub use lagrange_runtime::{
        BlanesMoan4, BlanesMoan6, Cause, Crossing, Derivatives, Dop853, Event, Gauss4, Gauss6, Gauss8, Guard,
        Jet, Jets, Leapfrog, Linearized, MotionError, Ordered, Parametric, PoseVelocity, Real, Rk4,
        Sensitive, State, System, Tangent, Twist2, Twist3, Yoshida4, Yoshida6, Yoshida8,
    };
}

/// The programs of the README and of the book are compiled and run as tests. `tests/book.rs` sees to it that
/// no chapter is left out.
#[cfg(doctest)]
mod documents {
    macro_rules! tested {
        ($($name:ident $file:literal)*) => {$(
            #[doc = include_str!($file)]
            struct $name;
        )*};
    }

    tested! {
        Readme "../README.md"
        FirstSteps "../book/src/first-steps.md"
    }

    /// The chapters after the first may use the features `ensemble` and `pictures`.
    #[cfg(all(feature = "ensemble", feature = "pictures"))]
    mod chapters {
        tested! {
            Language "../book/src/language.md"
            Constraints "../book/src/constraints.md"
            Contacts "../book/src/contacts.md"
            Bodies "../book/src/bodies.md"
            Robots "../book/src/robots.md"
            Analysis "../book/src/analysis.md"
            Integrators "../book/src/integrators.md"
            Accuracy "../book/src/accuracy.md"
            Pictures "../book/src/pictures.md"
            Command "../book/src/command.md"
            Errors "../book/src/errors.md"
            ManyMotions "../book/src/many-motions.md"
            BareMetal "../book/src/bare-metal.md"
            HowItWorks "../book/src/how-it-works.md"
        }
    }
}
