//! Fixed steps of a Taylor series: one `sin_cos` per angle and one factorisation a step, whatever the order.
//!
//! Beside a configuration in which constraints depend on each other, the coefficients of higher orders
//! consist of rounding errors, and grow. A step whose last terms grow is expanded about its end instead
//! (`jet/backward.rs`).
//!
//! The series is that of time in units of the step, so the state after it is the plain sum of the
//! coefficients, added to the state with compensation.

mod backward;

use super::FixedStep;
use crate::number::compensated::add;
use crate::number::elements::Each;
use crate::number::real::Real;
use crate::system::error::Cause;
use crate::system::smooth::{Series, Smooth};
use crate::system::state::State;

/// A Taylor step of order `ORDER`, for control loops: `stepper::<Jet<6>>(start)`. Error O(h^(ORDER + 1)) a
/// step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Jet<const ORDER: usize>;

/// The memory of a [`Jet`] between steps.
#[derive(Clone, Copy, Debug)]
pub struct JetMemory<C, T, R, const N: usize, const ORDER: usize> {
    constants: C,
    tables: T,
    series: Series<R, N, ORDER>,
    /// Residues of compensated summation, of coordinates and velocities.
    residue: ([R; N], [R; N]),
    /// The largest number of independent constraints that steps have found.
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
            // A start may be exact. Series about later states show what rounding errors make of them.
            let begins_beside = || {
                rank_so_far.is_none()
                    && !system
                        .land_at(outer, &mut from.clone(), None)
                        .is_ok_and(|here| here.independence.is_determined())
            };
            if is_dependent || !is_sound(series, from) || begins_beside() {
                return backward::advance(memory, system, outer, from, h, u);
            }
            *rank_so_far = Some(here.rank.max(rank_so_far.unwrap_or(here.rank)));
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

/// Whether a series about a state describes the motion: independent rows determine the state well, and the
/// terms do not grow beyond the rounding errors of the state.
pub(super) fn is_sound<R: Real, const N: usize, const P: usize>(
    series: &Series<R, N, P>,
    at: &State<R, N>,
) -> bool {
    let here = &series.independence;
    let largest = |row: &[R; N]| row.iter().fold(R::zero(), |all, x| all.max(x.abs()));
    let known = [&at.q, &at.v].each(|x| R::epsilon() * largest(x));
    (here.rank < here.rows || here.is_determined()) && falls(series, known, |rows| rows.each(largest))
}

/// Whether the last terms of a series are no larger than those before them, or than the `known` uncertainty
/// of the coordinates and of the velocities, by a measure of their sizes. Terms beside which those before are
/// rounding errors are the first of a motion that begins from rest, and tell nothing.
fn falls<R: Real, const N: usize, const P: usize>(
    series: &Series<R, N, P>,
    known: [R; 2],
    sizes: impl Fn([&[R; N]; 2]) -> [R; 2],
) -> bool {
    // Symmetry makes every other term vanish, so the last one is compared with two.
    let ([.., q0, q1, q2], [.., v0, v1, v2]) = (series.q.as_slice(), series.v.as_slice()) else {
        return true;
    };
    let [before_last, next_to_last, last] = [[q0, v0], [q1, v1], [q2, v2]].map(sizes);
    let terms = last.iter().zip(before_last).zip(next_to_last).zip(known);
    terms.map(|(((&last, a), b), known)| (last, a.max(b), known)).all(|(last, before, known)| {
        let begins = (before - R::epsilon().sqrt() * last).largest() <= R::zero().largest();
        begins || (last - before.max(known)).largest() <= R::zero().largest()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_that_grow_beyond_rounding_errors_are_no_series_of_a_motion() {
        let at = State::new([1.0], [1.0]);
        let series = |size: f64, growth: f64| {
            let mut series = Series::<f64, 1, 6>::default();
            for order in 1..=6 {
                let term = size * growth.powi(order as i32);
                series.set(order, [term], [term]);
            }
            series
        };
        assert!(is_sound(&series(1e-3, 0.5), &at) && !is_sound(&series(1e-3, 2.0), &at));
        // Rounding errors of the state may grow.
        assert!(is_sound(&series(1e-3 * f64::EPSILON, 2.0), &at));
        // Independent rows that all but depend on each other determine no motion.
        let mut undetermined = series(1e-3, 0.5);
        undetermined.independence.least = 1e-7;
        assert!(!is_sound(&undetermined, &at));
    }
}
