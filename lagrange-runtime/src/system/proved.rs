//! Properties that the macro has proved of a system, as traits: an integrator asks for those that it needs.
//!
//! `#[lagrangian]` implements a trait here for a system only if the property follows from its equations
//! whatever the parameters, so that a method which would go wrong on a system does not compile on it.

use crate::system::System;

/// A mass matrix that is the same all through a run: ∂²L/∂v∂v depends on parameters alone.
#[diagnostic::on_unimplemented(
    message = "the mass matrix of `{Self}` is not constant",
    label = "this needs a constant mass matrix",
    note = "use a method for every system, such as `Jet<6>`, or coordinates in which the inertia is constant"
)]
pub trait ConstantMass<const N: usize, const K: usize = 0>: System<N, K> {}

/// Constant mass matrix, forces that do not depend on velocities, and no constraints but eliminated ones: M a
/// = f(q, t, u).
///
/// Drifts (q moves, v stays) and kicks (v changes, q stays) are then exact motions of their own. Splitting
/// methods are made of these.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not separable: its mass matrix varies, a force depends on velocities, or a constraint holds it",
    label = "a splitting method does not work on `{Self}`",
    note = "use `Jet<6>` or `simulate`, or for long runs without constraints `Gauss4`, `Gauss6` or `Gauss8`, which are \
            reversible and need `jacobians` in the attribute"
)]
pub trait Separable<const N: usize, const K: usize = 0>: ConstantMass<N, K> {}

/// Equations of motion M a = f and constraints without time. A Lagrangian with a part such as t v, which
/// equals −q up to a total derivative, may have them. Its momenta depend on time then, and it is not
/// [`Conservative`].
#[diagnostic::on_unimplemented(
    message = "the equations of `{Self}` depend on time",
    label = "this needs a system without explicit time",
    note = "a function of the description takes `t`; make what varies an input if it is held from outside"
)]
pub trait Autonomous<const N: usize, const K: usize = 0>: System<N, K> {}

/// Autonomous, with neither applied forces nor dissipation, and a Lagrangian without time. The Jacobi
/// integral v·∂L/∂v − L is conserved. Where T is a quadratic form in the velocities, it is T + V.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not conservative",
    label = "this needs a conservative system",
    note = "a `#[force]` or `#[dissipation]` function does work on it, or its Lagrangian depends on time"
)]
pub trait Conservative<const N: usize, const K: usize = 0>: Autonomous<N, K> {}

/// Every constraint restricts positions. A constraint on velocities is allowed only if it follows from one on
/// positions.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not holonomic",
    label = "this needs a holonomic system",
    note = "a function with the role `nonholonomic` constrains its velocities"
)]
pub trait Holonomic<const N: usize, const K: usize = 0>: System<N, K> {}

/// Nothing is moved from outside: T is a quadratic form in the velocities, T = ½ v·M v with p = M v, and
/// neither energies nor constraints depend on time.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not scleronomic: something moves as a function of time, or T is no quadratic form in the velocities",
    label = "this needs a scleronomic system",
    note = "a position or a constraint takes `t`, or an energy has terms linear in the velocities or of a moving frame"
)]
pub trait Scleronomic<const N: usize, const K: usize = 0>: System<N, K> {}

/// At least one cyclic coordinate: L does not depend on it and no force acts along it, so that its momentum
/// is conserved. `STRUCTURE` names them, and `analysis` in the attribute gives their momenta.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no cyclic coordinate",
    label = "this needs a cyclic coordinate",
    note = "all coordinates appear in the Lagrangian, or forces or constraints act along them"
)]
pub trait Cyclic<const N: usize, const K: usize = 0>: System<N, K> {}
