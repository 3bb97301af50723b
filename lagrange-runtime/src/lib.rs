//! Runtime of the `lagrangian` crate: what generated equations of motion are made of and how they run.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`real`] | the scalar trait, open to scalars of your own |
//! | [`state`] | time, coordinates, velocities |
//! | [`system`] | the trait that generated code implements |
//! | [`smooth`] | the same for Taylor coefficients of the motion |
//! | [`simulation`] | a motion under error control: advance, sample, steer |
//! | [`stepper`] | a motion in fixed steps, for control loops |
//! | [`integrator`] | the methods: RK4, Dormand–Prince 8(5,3) |
//! | [`linear`] | factorisations of small dense matrices |
//! | [`algebra`] | vector functions for any scalar |
//! | [`structure`] | operation counts and proven facts of a model |
//! | [`error`] | why and when a motion stopped |
//!
//! Nothing allocates, nothing panics, and an error leaves the motion at its last good state.
//!
//! | feature | math functions | use |
//! | --- | --- | --- |
//! | `std` (default) | the platform's | fastest where there is an operating system |
//! | `libm` | the `libm` crate's | bare metal; the same bits on every target; wins over `std` |
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "std")]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!(
    "lagrange-runtime needs math functions: enable feature `std` (default), or `libm` on targets without a \
     standard library: `default-features = false, features = [\"libm\"]`"
);

pub mod algebra;
pub mod error;
pub mod integrator;
pub mod linear;
mod math;
pub mod real;
pub mod simulation;
pub mod smooth;
mod solve;
pub mod state;
pub mod stepper;
pub mod structure;
pub mod system;
mod tables;

pub use algebra::PrincipalMoments;
pub use error::{Cause, MotionError};
pub use integrator::{Adaptive, Dop853, FixedStep, Jet, Jets, Rk4};
pub use num_traits::{One, Zero};
pub use real::{Ordered, Real};
pub use simulation::{Control, Feedback, Held, Samples, Simulation, Steps};
pub use smooth::{Series, Smooth};
pub use state::State;
pub use stepper::Stepper;
pub use structure::{Cost, Costs, Structure};
pub use system::System;

/// The only path that an expansion may name. No part of the public interface.
#[doc(hidden)]
pub mod __private {
    pub use crate::algebra::{self, PrincipalMoments};
    pub use crate::error::{Cause, MotionError};
    pub use crate::linear::{Ldlt, Lu};
    pub use crate::real::Real;
    pub mod solve {
        //! Solving for the accelerations.
        pub use crate::solve::{
            check, check_block, factor, finite, has_length, outlined, pivot, solve, symmetric,
        };
    }
    pub use crate::integrator::{Dop853, Jets};
    pub use crate::smooth::{Series, Smooth};
    pub use crate::state::State;
    pub use crate::tables::Tables;
    pub mod jets {
        //! Recurrences of Taylor coefficients.
        pub use crate::tables::{first, fraction, ramp, rate};
    }
    pub use crate::structure::{Cost, Costs, Structure};
    pub use crate::system::System;
    pub use nalgebra;
}
