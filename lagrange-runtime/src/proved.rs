//! What the macro has proved of a system, as traits: an integrator asks for what it needs.
//!
//! `#[lagrangian]` implements a trait here for a system only if the property follows from its equations whatever the
//! parameters, so that a method which would go wrong on a system does not compile on it.

use crate::system::System;

/// A mass matrix that is the same all through a run: ∂²L/∂v∂v depends on parameters alone.
#[diagnostic::on_unimplemented(
    message = "the mass matrix of `{Self}` is not constant",
    label = "this needs a constant mass matrix",
    note = "use a method for every system, such as `Jet<6>`, or coordinates in which the inertia is constant"
)]
pub trait ConstantMass<const N: usize, const K: usize = 0>: System<N, K> {}

/// Constant mass matrix, and forces that do not depend on velocities: M a = f(q, t, u).
///
/// Drifts (q moves, v stays) and kicks (v changes, q stays) are then exact motions of their own, of which splitting
/// methods are made.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not separable: its mass matrix varies, or a force depends on velocities",
    label = "a splitting method does not work on `{Self}`",
    note = "use `Jet<6>` or `simulate`, or for long runs `Gauss4`, `Gauss6` or `Gauss8`, which are symplectic on every \
            system and need `jacobians` in the attribute"
)]
pub trait Separable<const N: usize, const K: usize = 0>: ConstantMass<N, K> {}

/// Equations without time.
#[diagnostic::on_unimplemented(
    message = "the equations of `{Self}` depend on time",
    label = "this needs a system without explicit time",
    note = "a function of the description takes `t`; make what varies an input if it is held from outside"
)]
pub trait Autonomous<const N: usize, const K: usize = 0>: System<N, K> {}

/// Autonomous, with neither applied forces nor dissipation: the Jacobi integral v·∂L/∂v − L is conserved, which is the
/// energy where T + V is.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not conservative",
    label = "this needs a conservative system",
    note = "a `#[force]` or `#[dissipation]` function does work on it, or its Lagrangian depends on time"
)]
pub trait Conservative<const N: usize, const K: usize = 0>: Autonomous<N, K> {}
