//! The energy as a check of a step of a series: where the macro has proved that it is conserved, a step changes
//! it by what the last terms of its series make of it, and by roundings. Beside a configuration in which
//! constraints depend on each other roundings grow by more than the terms show. Such a step is expanded about
//! its end.

use super::super::landing::NOISE;
use super::{JetMemory, backward};
use crate::number::real::Real;
use crate::system::System;
use crate::system::error::Cause;
use crate::system::smooth::{Series, Smooth};
use crate::system::state::State;

/// The change of the energy from one state to another, without derivatives.
#[inline]
pub(super) fn lost<S, const N: usize, const K: usize>(
    system: &S,
    outer: &S::Constants,
    from: &State<S::Scalar, N>,
    end: &State<S::Scalar, N>,
) -> S::Scalar
where
    S: System<N, K>,
{
    let energy = |state: &State<S::Scalar, N>| system.energy_at(outer, state.t, &state.q, &state.v).part(0);
    (energy(end) - energy(from)).abs()
}

/// Whether a change of the energy is what the last two terms of a series make of it, and roundings. Symmetry
/// makes every other term vanish.
#[inline]
pub(super) fn is_small<S, const N: usize, const K: usize, const P: usize>(
    system: &S,
    outer: &S::Constants,
    series: &Series<S::Scalar, N, P>,
    end: &State<S::Scalar, N>,
    change: S::Scalar,
) -> bool
where
    S: System<N, K>,
{
    let resting = State { v: [num_traits::Zero::zero(); N], ..*end };
    let kinetic = lost(system, outer, &resting, end);
    let roundings = S::Scalar::from_f64(NOISE) * S::Scalar::epsilon() * kinetic;
    (change - roundings).largest() <= num_traits::Zero::zero()
        || (change - roundings - by_terms(system, outer, series, end)).largest() <= num_traits::Zero::zero()
}

/// What the last two terms of a series make of the energy, one of each coordinate and velocity, and roundings of
/// it.
fn by_terms<S, const N: usize, const K: usize, const P: usize>(
    system: &S,
    outer: &S::Constants,
    series: &Series<S::Scalar, N, P>,
    end: &State<S::Scalar, N>,
) -> S::Scalar
where
    S: System<N, K>,
{
    let size = |rows: &[[S::Scalar; N]; P], i: usize| {
        let terms = rows.iter().rev().take(2).map(|row| row.get(i).map_or(num_traits::Zero::zero(), |x| x.abs()));
        terms.fold(num_traits::Zero::zero(), |sum: S::Scalar, x| sum + x)
    };
    let energy = system.energy_at(outer, end.t, &end.q, &end.v).part(0);
    let mut sum = S::Scalar::from_f64(4.0) * S::Scalar::epsilon() * energy.abs();
    for i in 0..N {
        let mut beside = [*end; 2];
        beside[0].q[i] += size(&series.q, i);
        beside[1].v[i] += size(&series.v, i);
        for beside in &beside {
            sum += lost(system, outer, end, beside);
        }
    }
    sum
}

/// The end of a step that loses less, if there is one.
///
/// # Errors
/// [`Cause::Undetermined`] beside a configuration in which constraints depend on each other, where what is lost
/// is more than roundings there explain.
#[cold]
#[inline(never)]
pub(super) fn mended<S, const N: usize, const K: usize, const ORDER: usize>(
    memory: &mut JetMemory<S::JetConstants, S::Tables<ORDER>, S::Scalar, N, ORDER>,
    system: &S,
    outer: &S::Constants,
    from: &State<S::Scalar, N>,
    end: State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Result<State<S::Scalar, N>, Cause>
where
    S: Smooth<N, K>,
{
    let here = system.land_at(outer, &mut end.clone(), None)?;
    let begun = system.land_at(outer, &mut from.clone(), None)?.independence;
    if here.independence.are_far_apart() && begun.are_far_apart() {
        return Ok(end);
    }
    let other = backward::advance(memory, system, outer, from, end.t - from.t, u).and_then(|mut other| {
        system.project_at(outer, &mut other, Some(from))?;
        Ok(other)
    });
    let least = |state: &State<S::Scalar, N>| lost(system, outer, from, state);
    let (best, cause) = match other {
        Ok(other) if (least(&end) - least(&other)).largest() > num_traits::Zero::zero() => (other, None),
        Ok(_) => (end, None),
        Err(cause) => (end, Some(cause)),
    };
    let constraint = here.independence.weakest;
    let cause = cause.unwrap_or(Cause::Undetermined { constraint, name: S::NAMES.constraint(constraint) });
    // A velocity is known to ε/σ² there.
    let least_distance = here.independence.least.min(begun.least);
    let speed = here.metric.extent(&best.v);
    let known = S::Scalar::from_f64(NOISE) * S::Scalar::epsilon() / (least_distance * least_distance);
    let excess =
        least(&best) - known * speed * speed - by_terms(system, outer, &memory.series, &best);
    if excess.largest() > num_traits::Zero::zero() { Err(cause) } else { Ok(best) }
}
