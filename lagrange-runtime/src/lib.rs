//! Runtime of the `lagrangian` crate: what generated equations of motion are made of and how they run.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`real`] | the scalar trait, open to scalars of your own |
//! | [`state`] | time, coordinates, velocities |
//! | [`attitude`] | orientations in space as three numbers of a state |
//! | [`system`] | the trait that generated code implements |
//! | [`smooth`] | the same for Taylor coefficients of the motion |
//! | [`simulation`] | a motion under error control: advance, sample, steer |
//! | [`events`] | zeros of functions along a motion |
//! | [`batch`] | several motions at once, in the lanes of a SIMD vector |
//! | [`stepper`] | a motion in fixed steps, for control loops |
//! | [`integrator`] | the methods: Taylor series, Dormand–Prince 8(5,3), RK4, symplectic splittings, Gauss collocation |
//! | [`constraints`] | multipliers, starts on the constraints, projection back onto them |
//! | [`analysis`] | inertia forces by origin, Christoffel symbols, Legendre's transformation |
//! | [`proved`] | what the macro proved of a system and a method may demand |
//! | [`linearized`] | derivatives of the equations, for implicit methods and for control |
//! | [`tangent`] | the same with constraints, and what follows: equilibria, linear models, modes |
//! | [`linear`] | factorisations of small dense matrices |
//! | [`algebra`] | vector functions for any scalar |
//! | [`twist`] | velocities of rigid bodies |
//! | [`verify`] | the certificate of a model: identities at sampled states |
//! | [`stored`] | large tables on the heap where there is one |
//! | [`structure`] | operation counts and proven facts of a model |
//! | [`error`] | why and when a motion stopped |
//! | [`name`] | names of coordinates and constraints in errors |
//!
//! Nothing allocates but analyses with `std` ([`Stored`]), nothing panics, and an error leaves the motion at
//! its last good state.
//!
//! | feature | math functions | use |
//! | --- | --- | --- |
//! | `std` (default) | the platform's | fastest where there is an operating system |
//! | `wide` | | SIMD vectors of the `wide` crate as scalars: [`Batch`] |
//! | `double-double` | | `DoubleDouble`, a scalar with 31 digits |
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
pub mod analysis;
pub mod attitude;
pub mod batch;
mod columns;
pub mod constraints;
pub mod error;
pub mod events;
pub mod integrator;
pub mod linear;
pub mod linearized;
mod math;
pub mod name;
pub mod proved;
pub mod reading;
pub mod real;
pub(crate) mod roots;
pub mod simulation;
pub mod smooth;
mod solve;
pub mod state;
pub mod stepper;
pub mod stored;
pub mod structure;
pub mod switching;
pub mod system;
mod tables;
pub mod tangent;
mod taylor;
pub mod twist;
pub mod verify;

pub use algebra::PrincipalMoments;
pub use analysis::InertiaForces;
pub use attitude::PoseVelocity;
pub use batch::Batch;
pub use constraints::{Constrained, Footing, Reactions};
pub use error::{Cause, Function, Magnitude, MotionError};
pub use events::{Crossing, Event, Events, Guard};
pub use integrator::{
    Adaptive, BlanesMoan, BlanesMoan4, BlanesMoan6, Dop853, FixedStep, Gauss, Gauss4, Gauss6, Gauss8, Jet,
    Jets, Leapfrog, Rk4, Yoshida, Yoshida4, Yoshida6, Yoshida8,
};
pub use linear::Independence;
pub use linearized::{Jacobians, Linearization, Linearized};
pub use nalgebra;
pub use name::{Name, Names};
pub use num_traits::{One, Zero};
pub use proved::{Autonomous, Conservative, ConstantMass, Cyclic, Holonomic, Scleronomic, Separable};
#[cfg(feature = "wide")]
pub use real::Lanes;
#[cfg(feature = "double-double")]
pub use real::{Digits, DoubleDouble};
pub use real::{Dual, Ordered, Real};
pub use simulation::{Control, Feedback, Held, Samples, Simulation, Steps};
pub use smooth::{Series, Smooth};
pub use state::State;
pub use stepper::Stepper;
pub use stored::Stored;
pub use structure::{Cost, Costs, Structure};
pub use switching::{Contact, Functions, Hybrid, Laws, NamedRows, Regime, Row, Switch, Switching};
pub use system::System;
pub use tangent::{
    Basis, ByParameters, Equilibrium, EquilibriumError, FoundBy, Imbalance, InverseDynamics, LinearModel,
    Response, Sensitive, Sensitivities, Stability, Tangent, Transition, Variation, Variational,
    VariationalMotion,
};
#[cfg(feature = "std")]
pub use tangent::{Mode, Monodromy};
pub use twist::{Twist2, Twist3};
pub use verify::{Certificate, Identity, Violation};
#[cfg(feature = "wide")]
pub use wide;

/// The only path that an expansion may name. No part of the public interface.
#[doc(hidden)]
pub mod __private {
    pub use crate::algebra::{self, PrincipalMoments};
    pub use crate::analysis::{self, InertiaForces};
    pub use crate::attitude;
    pub use crate::error::{Cause, Function, MotionError};
    pub use crate::events::Guard;
    pub use crate::linear::{Independence, Inverse, Ldlt, Lu, RecursionStep};
    pub use crate::linearized::{Linearization, Linearized};
    pub use crate::name::{Name, Names};
    pub use crate::proved::{
        Autonomous, Conservative, ConstantMass, Cyclic, Holonomic, Scleronomic, Separable,
    };
    pub use crate::reading;
    pub use crate::real::Real;
    pub mod solve {
        //! Solving for the accelerations.
        pub use crate::solve::{
            are_finite, check, check_block, factor, finite, has_length, outlined, pivot, solve, symmetric,
            unbounded,
        };
    }
    pub use crate::columns::Columns;
    pub use crate::constraints::{
        self, Balance, Constrained, Equations, Footing, Reactions, Residuals, Surface,
    };
    pub use crate::integrator::{Dop853, Jets};
    pub use crate::smooth::{Series, Smooth};
    pub use crate::state::State;
    pub use crate::tables::Tables;
    pub use crate::tangent::{self, ByParameters, Imbalance, Place, Sensitive, Tangent, Variation};
    pub mod saddle {
        //! Saddle-point systems of constrained mechanics.
        pub use crate::linear::{Diagonal, Saddle, SaddlePoint, Schur, Switched};
    }
    pub mod jets {
        //! Recurrences of Taylor coefficients.
        pub use crate::columns::{Pattern, Products, column, product, square, tile};
        pub use crate::tables::{Convolutions, in_line, in_turn, index, multiplier, rate, time};
    }
    pub use crate::structure::{Cost, Costs, Structure};
    pub use crate::switching::{self, Functions, Hybrid, Laws, NamedRows, Regime, Row, Switching};
    pub use crate::system::System;
    pub use crate::twist::{Twist2, Twist3};
    pub use crate::verify::{self, Certificate, Verifiable, Violation};
    pub use nalgebra;
}
