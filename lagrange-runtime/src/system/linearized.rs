//! [`Linearized`]: derivatives of the equations of motion, for implicit methods and for control.
//!
//! All derivatives are those of the residual r = f(t, q, v, u) − M(t, q, v) a at given accelerations, so that
//! no inverse of M is differentiated and stiff forces keep their structure.

use nalgebra::SMatrix;

use crate::linear::{COLUMNS, FEW, Lu, Rows};
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
    label = "this needs `jacobians`",
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

    /// ∂a/∂q, ∂a/∂v and ∂a/∂u at a state under the inputs `u`: M⁻¹ times the derivatives of r at the
    /// accelerations there.
    ///
    /// # Errors
    /// A singular mass matrix, or a value that is not finite.
    fn jacobians(
        &self,
        state: &State<Self::Scalar, N>,
        u: &[Self::Scalar; K],
    ) -> Result<Jacobians<Self::Scalar, N, K>, MotionError<Self::Scalar>>
    where
        Self: Sized,
    {
        let constants = self.constants();
        let State { t, q, v } = state;
        let failed = || MotionError { cause: diagnose(self, &constants, *t, q, v), t: *t };
        let a = self.accelerations_at(&constants, *t, q, v, u);
        if !a.iter().all(|a| a.is_finite()) {
            return Err(failed());
        }
        let linearization = self.linearization_at(&constants, *t, q, v, &a, u);
        let by_u = self.by_inputs_at(&constants, *t, q, v, u);
        let jacobians = match Rows::factor(&linearization.mass) {
            Some(factors) => solved(&factors, &linearization, &by_u),
            None => {
                check_masses(self, &constants, state)?;
                pivoted(&linearization, &by_u).ok_or_else(failed)?
            }
        };
        let Jacobians { by_q, by_v, by_u } = &jacobians;
        let finite = [by_q.as_slice(), by_v.as_slice(), by_u.as_slice()].into_iter().all(are_finite);
        if finite { Ok(jacobians) } else { Err(failed()) }
    }
}

/// Whether all numbers are finite. Zero times a number is zero, or else no number; sums of these side by
/// side ask no question until the end.
fn are_finite<R: Real>(numbers: &[R]) -> bool {
    let (chunks, rest) = numbers.as_chunks::<FEW>();
    let mut sums = [R::zero(); FEW];
    for numbers in chunks {
        sums.iter_mut().zip(numbers).for_each(|(sum, &x)| *sum += R::zero() * x);
    }
    sums.iter().chain(rest).all(|x| x.is_finite())
}

/// M⁻¹ times the columns of three matrices, which stand beside each other.
#[inline(never)]
fn solved<R: Real, const N: usize, const K: usize>(
    factors: &Rows<R, N>,
    linearization: &Linearization<R, N>,
    by_u: &[[R; K]; N],
) -> Jacobians<R, N, K> {
    let mut jacobians = Jacobians { by_q: SMatrix::zeros(), by_v: SMatrix::zeros(), by_u: SMatrix::zeros() };
    let (mut first, count) = (0, N + N + K);
    while first < count {
        first = if count - first > FEW {
            side_by_side::<R, N, K, COLUMNS>(factors, linearization, by_u, first, &mut jacobians)
        } else {
            side_by_side::<R, N, K, FEW>(factors, linearization, by_u, first, &mut jacobians)
        };
    }
    jacobians
}

/// The same by pivots, of an M that is not positive definite.
#[cold]
fn pivoted<R: Real, const N: usize, const K: usize>(
    Linearization { mass, by_q, by_v }: &Linearization<R, N>,
    by_u: &[[R; K]; N],
) -> Option<Jacobians<R, N, K>> {
    let factors = Lu::factor(*mass).ok()?;
    let mut jacobians = Jacobians { by_q: SMatrix::zeros(), by_v: SMatrix::zeros(), by_u: SMatrix::zeros() };
    by_column(&factors, by_q, &mut jacobians.by_q);
    by_column(&factors, by_v, &mut jacobians.by_v);
    by_column(&factors, by_u, &mut jacobians.by_u);
    Some(jacobians)
}

/// Solves for some columns from the `first` on; the next.
fn side_by_side<R: Real, const N: usize, const K: usize, const W: usize>(
    factors: &Rows<R, N>,
    Linearization { by_q, by_v, .. }: &Linearization<R, N>,
    by_u: &[[R; K]; N],
    first: usize,
    jacobians: &mut Jacobians<R, N, K>,
) -> usize {
    let mut columns = [[R::zero(); W]; N];
    for (i, columns) in columns.iter_mut().enumerate() {
        take(columns, first, 0, &by_q[i]);
        take(columns, first, N, &by_v[i]);
        take(columns, first, N + N, &by_u[i]);
    }
    factors.solve(&mut columns);
    put(&columns, first, 0, &mut jacobians.by_q);
    put(&columns, first, N, &mut jacobians.by_v);
    put(&columns, first, N + N, &mut jacobians.by_u);
    first + W
}

/// The columns from `first` on that a matrix has, which begins at `offset`: in the target, and in the matrix.
fn common<const W: usize>(
    first: usize,
    offset: usize,
    width: usize,
) -> Option<(core::ops::Range<usize>, usize)> {
    let (low, high) = (first.max(offset), (first + W).min(offset + width));
    (low < high).then(|| (low - first..high - first, low - offset))
}

fn take<R: Real, const C: usize, const W: usize>(
    columns: &mut [R; W],
    first: usize,
    offset: usize,
    row: &[R; C],
) {
    if let Some((range, from)) = common::<W>(first, offset, C) {
        columns[range].iter_mut().zip(&row[from..]).for_each(|(column, &entry)| *column = entry);
    }
}

fn put<R: Real, const N: usize, const C: usize, const W: usize>(
    columns: &[[R; W]; N],
    first: usize,
    offset: usize,
    matrix: &mut SMatrix<R, N, C>,
) {
    let Some((range, from)) = common::<W>(first, offset, C) else { return };
    for (column, target) in range.zip(&mut matrix.data.0[from..]) {
        target.iter_mut().zip(columns).for_each(|(entry, row)| *entry = row[column]);
    }
}

fn by_column<R: Real, const N: usize, const C: usize>(
    factors: &Lu<R, N>,
    rows: &[[R; C]; N],
    matrix: &mut SMatrix<R, N, C>,
) {
    for (j, column) in matrix.data.0.iter_mut().enumerate() {
        *column = factors.solve(core::array::from_fn(|i| rows[i][j]));
    }
}
