//! [`Linearized`]: derivatives of the equations of motion, for implicit methods and for control.
//!
//! All derivatives are those of the residual r = f(t, q, v, u) − M(t, q, v) a at given accelerations, so that
//! no inverse of M is differentiated and stiff forces keep their structure.

use nalgebra::SMatrix;

use crate::linear::{Lu, Rows};
use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::error::MotionError;
use crate::system::state::State;
use crate::system::{System, check_masses, diagnose};

/// M, and the derivatives of r = f − M a; rows are equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linearization<R, const N: usize> {
    /// M = −∂r/∂a.
    pub mass: [[R; N]; N],
    /// ∂r/∂q.
    pub by_q: [[R; N]; N],
    /// ∂r/∂v.
    pub by_v: [[R; N]; N],
}

/// M in factors, and the derivatives of r = f − M a at the accelerations of the motion.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Factored<R, const N: usize> {
    factors: Rows<R, N>,
    /// Whether M is positive definite and the accelerations are finite.
    is_sound: bool,
    /// ∂r/∂q.
    pub by_q: [[R; N]; N],
    /// ∂r/∂v.
    pub by_v: [[R; N]; N],
}

impl<R: Real, const N: usize> Factored<R, N> {
    /// Without anything.
    fn new() -> Self {
        let zero = [[R::zero(); N]; N];
        Factored { factors: Rows::new(), is_sound: false, by_q: zero, by_v: zero }
    }

    /// Where M is put.
    pub(crate) fn mass(&mut self) -> &mut [[R; N]; N] {
        self.factors.matrix()
    }

    /// Factors M; whether it is positive definite.
    pub(crate) fn factor(&mut self) -> bool {
        self.is_sound = self.factors.factor();
        self.is_sound
    }

    /// Turns forces into accelerations.
    pub(crate) fn accelerate(&mut self, forces: &mut [R; N]) {
        self.factors.solve_one(forces);
        self.is_sound = forces.iter().all(|a| a.is_finite());
    }
}

/// Derivatives of the accelerations; rows are accelerations.
///
/// With x = (q, v) the motion near a state is ẋ = A x + B u, where A has the rows (0, 1) and (`by_q`,
/// `by_v`), and B has the rows 0 and `by_u`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jacobians<R, const N: usize, const K: usize> {
    /// ∂a/∂q.
    pub by_q: SMatrix<R, N, N>,
    /// ∂a/∂v.
    pub by_v: SMatrix<R, N, N>,
    /// ∂a/∂u.
    pub by_u: SMatrix<R, N, K>,
}

/// A system with generated derivatives: one whose attribute asks for `jacobians`.
#[diagnostic::on_unimplemented(
    message = "the derivatives of the equations of `{Self}` are not generated",
    label = "this needs `jacobians`, and a system without contacts and dry friction",
    note = "say so in the attribute: `#[lagrangian(coordinates = […], jacobians)]`"
)]
pub trait Linearized<const N: usize, const K: usize = 0>: System<N, K> {
    /// r = f − M a: zero on the motion, and the inverse dynamics with the sign changed.
    fn residual_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        a: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
    ) -> [Self::Scalar; N];

    /// M, ∂r/∂q and ∂r/∂v.
    fn linearization_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        a: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
    ) -> Linearization<Self::Scalar, N>;

    /// ∂r/∂u; rows are equations.
    fn by_inputs_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
    ) -> [[Self::Scalar; K]; N];

    /// The equations that `Derivatives::jacobians` solves, into matrices of zeros.
    #[doc(hidden)]
    fn factored_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
        u: &[Self::Scalar; K],
        matrices: &mut Factored<Self::Scalar, N>,
    ) {
        let a = self.accelerations_at(constants, t, q, v, u);
        if a.iter().all(|a| a.is_finite()) {
            let Linearization { mass, by_q, by_v } = self.linearization_at(constants, t, q, v, &a, u);
            *matrices.mass() = mass;
            matrices.factor();
            (matrices.by_q, matrices.by_v) = (by_q, by_v);
        }
    }
}

/// The method of `Derivatives`.
///
/// # Errors
/// A singular mass matrix, or a value that is not finite.
pub(crate) fn jacobians<S: Linearized<N, K>, const N: usize, const K: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Result<Jacobians<S::Scalar, N, K>, MotionError<S::Scalar>> {
    let constants = system.constants();
    let State { t, q, v } = state;
    let mut factored = Factored::new();
    system.factored_at(&constants, *t, q, v, u, &mut factored);
    let mut by_u = system.by_inputs_at(&constants, *t, q, v, u);
    if factored.is_sound {
        factored.factors.solve(&mut factored.by_q, &mut factored.by_v, &mut by_u);
    } else {
        pivoted(system, &constants, state, u, &mut factored, &mut by_u)?;
    }
    let Factored { by_q, by_v, .. } = &factored;
    if !(are_finite(by_q) && are_finite(by_v) && are_finite(&by_u)) {
        return Err(failed(system, &constants, state));
    }
    let mut jacobians = Jacobians { by_q: SMatrix::zeros(), by_v: SMatrix::zeros(), by_u: SMatrix::zeros() };
    put_columns(by_q, &mut jacobians.by_q);
    put_columns(by_v, &mut jacobians.by_v);
    put_columns(&by_u, &mut jacobians.by_u);
    Ok(jacobians)
}

fn failed<S: System<N, K>, const N: usize, const K: usize>(
    system: &S,
    constants: &S::Constants,
    State { t, q, v }: &State<S::Scalar, N>,
) -> MotionError<S::Scalar> {
    MotionError { cause: diagnose(system, constants, *t, q, v), t: *t }
}

/// What `Derivatives::jacobians` solves for, by pivots, where M is not positive definite.
#[cold]
fn pivoted<S: Linearized<N, K>, const N: usize, const K: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
    factored: &mut Factored<S::Scalar, N>,
    by_u: &mut [[S::Scalar; K]; N],
) -> Result<(), MotionError<S::Scalar>> {
    let failed = || failed(system, constants, state);
    let State { t, q, v } = state;
    let a = system.accelerations_at(constants, *t, q, v, u);
    if !a.iter().all(|a| a.is_finite()) {
        return Err(failed());
    }
    check_masses(system, constants, state)?;
    let Linearization { mass, by_q, by_v } = system.linearization_at(constants, *t, q, v, &a, u);
    let factors = Lu::factor(mass).map_err(|_| failed())?;
    (factored.by_q, factored.by_v) = (by_q, by_v);
    by_column(&factors, &mut factored.by_q);
    by_column(&factors, &mut factored.by_v);
    by_column(&factors, by_u);
    Ok(())
}

/// Whether all numbers are finite. Zero times a finite number is zero, and NaN otherwise. Sums of these
/// products need no branch until the end.
fn are_finite<R: Real, const N: usize, const W: usize>(rows: &[[R; W]; N]) -> bool {
    let mut sums = [R::zero(); W];
    for row in rows {
        sums.iter_mut().zip(row).for_each(|(sum, &x)| *sum += R::zero() * x);
    }
    sums.iter().all(|sum| sum.is_finite())
}

fn by_column<R: Real, const N: usize, const W: usize>(factors: &Lu<R, N>, rows: &mut [[R; W]; N]) {
    for j in 0..W {
        let column = factors.solve(array(|i| rows[i][j]));
        rows.iter_mut().zip(column).for_each(|(row, entry)| row[j] = entry);
    }
}

/// The same matrix as nalgebra has it: column by column. Filled in where it stands, because a result would be
/// copied.
fn put_columns<R: Real, const N: usize, const W: usize>(rows: &[[R; W]; N], matrix: &mut SMatrix<R, N, W>) {
    for (j, column) in matrix.data.0.iter_mut().enumerate() {
        column.iter_mut().zip(rows).for_each(|(entry, row)| *entry = row[j]);
    }
}
