//! Runtime of the `lagrangian` crate: what generated equations of motion are made of and how they run.
//!
//! Its modules stand on each other: each names only those below it.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`analysis`] | derivatives of the equations, and what follows: equilibria, linear models, modes, sensitivities; the certificate of a model |
//! | [`switching`] | contacts, dry friction and kinks: regimes, impacts, and the motion through them |
//! | [`motion`] | a motion under error control, in fixed steps, several at once; events along it |
//! | [`integrator`] | the methods: Taylor series, Dormand–Prince 8(5,3), RK4, symplectic splittings, Gauss collocation |
//! | [`constraints`] | multipliers, starts on the constraints, projection back onto them |
//! | [`system`] | what generated code implements, states, errors, what is proved or known of a model |
//! | `series` | Taylor coefficients and their convolutions |
//! | [`linear`] | factorisations of small dense matrices, vectors for any scalar |
//! | [`number`] | the scalar trait, open to scalars of your own |
//!
//! Nothing allocates but analyses, and many constraints that depend on each other, with `std` ([`Stored`]).
//! Nothing panics, and an error leaves the motion at
//! its last good state.
//!
//! | feature | math functions | use |
//! | --- | --- | --- |
//! | `std` (default) | the platform's | fastest where there is an operating system |
//! | `wide` | | SIMD vectors of the `wide` crate as scalars: [`Batch`] |
//! | `double-double` | | `DoubleDouble`, a scalar with 31 digits |
//! | `libm` | the `libm` crate's | bare metal; the same bits on every target; wins over `std` |
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![cfg_attr(target_arch = "nvptx64", feature(core_float_math))]
#![forbid(unsafe_code)]

#[cfg(feature = "std")]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!(
    "lagrange-runtime needs math functions: enable feature `std` (default), or `libm` on targets without a \
     standard library: `default-features = false, features = [\"libm\"]`"
);

pub mod analysis;
pub mod constraints;
pub mod integrator;
pub mod linear;
pub mod motion;
pub mod number;
pub(crate) mod series;
pub mod switching;
pub mod system;

pub use analysis::inertia::InertiaForces;
pub use analysis::verify::{self, Certificate, Identity, Violation};
pub use analysis::{
    self as tangent, Basis, ByParameters, Derivatives, Equilibrium, EquilibriumError, FoundBy, Imbalance,
    InverseDynamics, LinearModel, Parametric, Response, Sensitive, Sensitivities, Stability, Tangent,
    Transition, Variation, Variational, VariationalMotion,
};
#[cfg(feature = "std")]
pub use analysis::{Mode, Monodromy};
pub use constraints::{Constrained, Footing, Reactions};
pub use integrator::{
    Adaptive, BlanesMoan, BlanesMoan4, BlanesMoan6, Dop853, FixedStep, Gauss, Gauss4, Gauss6, Gauss8, Jet,
    Jets, Leapfrog, Rk4, Yoshida, Yoshida4, Yoshida6, Yoshida8,
};
pub use linear::Independence;
pub use linear::algebra::{self, PrincipalMoments};
pub use linear::stored::{self, Stored};
pub use motion::batch::relay::{self, Relay};
pub use motion::batch::{self, Batch};
pub use motion::events::{self, Crossing, Event, Events, Guard};
pub use motion::simulation::{self, Control, Feedback, Held, Samples, Simulation, Steps};
pub use motion::stepper::{self, Stepper};
pub use nalgebra;
pub use num_traits::{One, Zero};
#[cfg(feature = "double-double")]
pub use number::real::DoubleDouble;
#[cfg(feature = "wide")]
pub use number::real::Lanes;
pub use number::real::{self, Dual, Ordered, Real, Vector};
pub use switching::{
    Along, Coefficients, Contact, Functions, Hybrid, Laws, NamedRows, Regime, Row, Switch, Switching,
};
pub use system::System;
pub use system::attitude::{self, BodyAxes, ByName, PoseVelocity};
#[cfg(feature = "double-double")]
pub use system::digits::Digits;
pub use system::error::{self, Cause, Function, Magnitude, MotionError};
pub use system::linearized::{self, Jacobians, Linearization, Linearized};
pub use system::name::{self, Name, Names};
pub use system::proved::{
    self, Autonomous, Conservative, ConstantMass, Cyclic, Holonomic, Scleronomic, Separable,
};
pub use system::reading;
pub use system::smooth::{self, Series, Smooth};
pub use system::state::{self, State};
pub use system::structure::{self, Cost, Costs, Structure};
pub use system::twist::{self, Twist2, Twist3};
#[cfg(feature = "wide")]
pub use wide;

/// The only path that an expansion may name. No part of the public interface.
#[doc(hidden)]
pub mod __private {
    pub use crate::analysis::inertia::{self as analysis, InertiaForces};
    pub use crate::linear::algebra::{self, PrincipalMoments};
    pub use crate::linear::{Independence, Inverse, Ldlt, Lu, RecursionStep};
    pub use crate::motion::events::Guard;
    pub use crate::number::real::{Ordered, Real};
    pub use crate::system::attitude;
    pub use crate::system::error::{Cause, Function, MotionError};
    pub use crate::system::linearized::{Factored, Linearization, Linearized};
    pub use crate::system::name::{Name, Names};
    pub use crate::system::proved::{
        Autonomous, Conservative, ConstantMass, Cyclic, Holonomic, Scleronomic, Separable,
    };
    pub use crate::system::reading;
    pub use crate::system::screws;
    pub use num_traits::{One, Zero};
    pub mod solve {
        //! Solving for the accelerations.
        pub use crate::system::solve::{
            are_finite, check, check_all, check_block, factor, finite, has_length, mass_of, outlined, pivot,
            solve, symmetric, unbounded,
        };
    }
    pub use crate::analysis::{
        self as tangent, ByParameters, Imbalance, Parametric, Place, Sensitive, Tangent, Variation,
    };
    pub use crate::constraints::{
        self, Balance, Constrained, Equations, Footing, Reactions, Residuals, Surface,
    };
    pub use crate::integrator::{Dop853, FixedStep, Jet, Jets};
    pub use crate::series::columns::Columns;
    pub use crate::series::tables::Tables;
    pub use crate::system::footing::Apart;
    pub use crate::system::hidden::{Hidden, hidden};
    pub use crate::system::smooth::{Series, Smooth};
    pub use crate::system::state::State;
    pub mod saddle {
        //! Saddle-point systems of constrained mechanics.
        pub use crate::linear::{
            Diagonal, Load, Parts, Pattern, Saddle, SaddlePoint, Schur, Sparse, SparseRows, Switched,
            SwitchedRows,
        };
    }
    pub mod jets {
        //! Recurrences of Taylor coefficients.
        pub use crate::series::columns::{Pattern, Products, column, packed, product, square, tile};
        pub use crate::series::followed::Followed;
        pub use crate::series::tables::{
            Convolutions, Pairs, in_line, in_turn, index, multiplier, rate, time,
        };
    }
    pub use crate::analysis::verify::{self, Certificate, Verifiable, Violation};
    pub use crate::switching::{
        self, Along, Coefficients, Functions, Hybrid, Laws, NamedRows, Regime, Row, Switching, Wanted,
    };
    pub use crate::system::System;
    pub use crate::system::structure::{Cost, Costs, Structure};
    pub use crate::system::twist::{Twist2, Twist3};
    pub use nalgebra;
}
