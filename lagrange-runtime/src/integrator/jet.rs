//! Fixed steps of a Taylor series: one `sin_cos` per angle and one factorisation a step, whatever the order.
//!
//! Beside a configuration in which constraints depend on each other, the coefficients of higher orders
//! consist of rounding errors, and grow. A step whose last terms grow is replaced by Runge–Kutta stages,
//! which lie where the accelerations are known.
//!
//! The series is that of time in units of the step, so the state after it is the plain sum of the
//! coefficients, added to the state with compensation.

use super::dop853::add;
use super::{FixedStep, stages};
use crate::number::real::Real;
use crate::system::System;
use crate::system::diagnose;
use crate::system::error::Cause;
use crate::system::smooth::{Series, Smooth};
use crate::system::state::State;

/// A Taylor step of order `ORDER`, for control loops: `stepper::<Jet<6>>(start)`. Error O(h^(ORDER + 1)) a
/// step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Jet<const ORDER: usize>;

/// What a [`Jet`] remembers between steps.
#[derive(Clone, Copy, Debug)]
pub struct JetMemory<C, T, R, const N: usize, const ORDER: usize> {
    constants: C,
    tables: T,
    series: Series<R, N, ORDER>,
    /// The compensation of coordinates and velocities: what rounding has taken from them.
    residue: ([R; N], [R; N]),
    /// The largest number of independent constraints that a step has started with.
    rank_so_far: Option<usize>,
}

impl<S, const N: usize, const K: usize, const ORDER: usize> FixedStep<S, N, K> for Jet<ORDER>
where
    S: Smooth<N, K>,
{
    type Memory = JetMemory<S::JetConstants, S::Tables<ORDER>, S::Scalar, N, ORDER>;

    #[inline]
    fn begin(system: &S) -> Self::Memory {
        let zero = [num_traits::Zero::zero(); N];
        JetMemory {
            constants: system.jet_constants(),
            tables: S::Tables::default(),
            series: Series::default(),
            residue: (zero, zero),
            rank_so_far: None,
        }
    }

    #[inline]
    fn step(
        memory: &mut Self::Memory,
        system: &S,
        outer: &S::Constants,
        from: &State<S::Scalar, N>,
        h: S::Scalar,
        u: &[S::Scalar; K],
    ) -> Result<State<S::Scalar, N>, Cause> {
        let JetMemory { constants, tables, series, residue, rank_so_far } = memory;
        let mut next = from.at_time(from.t + h);
        if !system.jet_at(constants, from.t, &from.q, &from.v, u, h, ORDER, tables, series) {
            next.v = [S::Scalar::from_f64(f64::NAN); N];
            return Ok(next);
        }
        if S::COUPLED {
            let here = &series.independence;
            let is_dependent = here.rank < rank_so_far.unwrap_or(here.rows);
            *rank_so_far = Some(here.rank.max(rank_so_far.unwrap_or(here.rank)));
            let is_poor = here.rank == here.rows && !here.is_determined();
            if is_dependent || is_poor || grows(series, from) {
                return in_parts::<S, N, K, ORDER>(system, outer, from, h, u);
            }
        }
        let (gain_q, gain_v) = series.sum();
        let mut rest = *residue;
        for i in 0..N {
            (next.q[i], rest.0[i]) = add(from.q[i], rest.0[i], gain_q[i]);
            (next.v[i], rest.1[i]) = add(from.v[i], rest.1[i], gain_v[i]);
        }
        // A step that fails is not taken.
        if next.is_finite() {
            *residue = rest;
        }
        Ok(next)
    }
}

/// Whether the last terms of a series are larger than those before them, and larger than the rounding errors
/// of the state.
fn grows<R: Real, const N: usize, const P: usize>(series: &Series<R, N, P>, from: &State<R, N>) -> bool {
    let largest = |row: &[R; N]| row.iter().fold(R::zero(), |all, x| all.max(x.abs()));
    [(&series.q, &from.q), (&series.v, &from.v)].into_iter().any(|(rows, start)| {
        // Symmetry makes every other term vanish, so the last one is held against two.
        let [.., before_last, next_to_last, last] = rows.as_slice() else { return false };
        let known = R::epsilon() * largest(start);
        let usual = largest(before_last).max(largest(next_to_last)).max(known);
        (largest(last) - usual).largest() > R::zero().largest()
    })
}

/// Orders of a series that one step by stages replaces. The method by stages has order 8, so its error is
/// smaller than that of the series.
const ORDERS: usize = 4;

/// A step by stages in the place of one of a series.
#[cold]
#[inline(never)]
fn in_parts<S: System<N, K>, const N: usize, const K: usize, const ORDER: usize>(
    system: &S,
    constants: &S::Constants,
    from: &State<S::Scalar, N>,
    h: S::Scalar,
    u: &[S::Scalar; K],
) -> Result<State<S::Scalar, N>, Cause> {
    let parts = ORDER.div_ceil(ORDERS);
    let part = h / S::Scalar::from_f64(parts as f64);
    let mut state = *from;
    for _ in 0..parts {
        let mut next = stages::step(system, constants, &state, part, u);
        if !next.is_finite() {
            return Err(diagnose(system, constants, state.t, &state.q, &state.v));
        }
        system.project_at(constants, &mut next, None)?;
        state = next;
    }
    Ok(state.at_time(from.t + h))
}
