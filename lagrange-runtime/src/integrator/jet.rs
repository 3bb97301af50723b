//! Fixed steps of a Taylor series: one `sin_cos` per angle and one factorisation a step, whatever the order.
//!
//! The series is that of time in units of the step, so the state after it is the plain sum of the coefficients, added
//! to the state with compensation.

use super::FixedStep;
use super::dop853::add;
use crate::error::Cause;
use crate::real::Real;
use crate::smooth::{Series, Smooth};
use crate::state::State;

/// A Taylor step of order `ORDER`, for control loops: `stepper::<Jet<6>>(start)`. Error O(h^(ORDER + 1)) a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Jet<const ORDER: usize>;

/// What a [`Jet`] remembers between steps.
#[derive(Clone, Copy, Debug)]
pub struct JetMemory<C, T, R, const N: usize, const ORDER: usize> {
    constants: C,
    tables: T,
    series: Series<R, N, ORDER>,
    /// What rounding took from the coordinates and the velocities.
    residue: ([R; N], [R; N]),
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
        }
    }

    #[inline]
    fn step(
        memory: &mut Self::Memory,
        system: &S,
        _: &S::Constants,
        from: &State<S::Scalar, N>,
        h: S::Scalar,
        u: &[S::Scalar; K],
    ) -> Result<State<S::Scalar, N>, Cause> {
        let JetMemory { constants, tables, series, residue } = memory;
        let mut next = from.at_time(from.t + h);
        if !system.jet_at(constants, from.t, &from.q, &from.v, u, h, ORDER, tables, series) {
            next.v = [S::Scalar::from_f64(f64::NAN); N];
            return Ok(next);
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
