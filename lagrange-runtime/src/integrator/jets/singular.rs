//! A step that starts in a configuration in which constraints depend on each other, or close to one: the
//! first of a motion, or one that has no end before that configuration where the state is determined as well
//! as its start is, or as the tolerance wants.
//!
//! There the equations do not give the multipliers, and beside it they give them with few digits. But the
//! motion is smooth, and a little later it is well determined. So the step is expanded about its **end**: a
//! state on the constraints whose series leads back to the start. It is found by shooting, with free flight
//! as the approximation of the flow, which leaves an error of the square of the time. The velocity of the
//! start decides along which of the motions that meet there it goes on.

use super::super::landing::{Check, apart};
use super::{Determined, Jets, expansion};
use crate::constraints::Footing;
use crate::linear::determined;
use crate::number::real::{Ordered, Real, larger, smaller};
use crate::system::control::Held;
use crate::system::error::Cause;
use crate::system::limits::Limits;
use crate::system::method::Adaptive;
use crate::system::smooth::Smooth;
use crate::system::state::State;

/// The number of lengths that are tried. Each is half of the one before, beginning with half of the time in
/// which coordinates change by their size. So a target close by does not keep a motion where it cannot end.
const LENGTHS: usize = 64;

/// At so many of these lengths as many constraints may depend on each other as at the start. Where that is
/// the rule and not the exception, it is found at all of them: functions without kinks depend on each other
/// everywhere or at single places.
const ALIKE: usize = 4;

/// Corrections of the end of the step. Each leaves a part of the error that is the square of the step over
/// the time in which accelerations change.
const CORRECTIONS: usize = 24;

/// The least factor by which a state is determined better than another one, if it is to be better.
const BETTER: f64 = 2.0;

/// How independent constraints have to be at the end of the step.
#[derive(Clone, Copy, Debug)]
pub(super) enum Beyond<R> {
    /// So that they determine the state. That is enough for the first step of a motion.
    Determined,
    /// And clearly better than at its start.
    Better,
    /// And by more than this, while they are not at its start.
    Wanted(R),
}

/// Takes a step about its end, where the constraints determine the state well. False where they depend on
/// each other beside the start as well, so that the start is as good as any other state. A step that is not
/// taken leaves the memory as it was.
///
/// # Errors
/// [`Cause::Undetermined`] where they are independent beside it, but no motion leads there with this
/// velocity; and why the start cannot be brought onto the constraints.
#[cold]
#[inline(never)]
#[allow(clippy::too_many_arguments)]
pub(super) fn start<S, const N: usize, const K: usize>(
    memory: &mut <Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    system: &S,
    constants: &S::Constants,
    control: &Held<S::Scalar, K>,
    limits: &Limits<S::Scalar>,
    (left, beyond): (S::Scalar, Beyond<S::Scalar>),
) -> Result<bool, Cause>
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    let half = S::Scalar::from_f64(0.5);
    let kept = *memory;
    let State { q, v, .. } = &kept.start;
    let Footing { independence: here, metric, .. } =
        system.land_at(constants, &mut kept.start.clone(), None)?;
    let enough = match beyond {
        Beyond::Determined => determined(),
        Beyond::Better => larger(determined(), S::Scalar::from_f64(BETTER) * here.least),
        Beyond::Wanted(wanted) => larger(determined(), wanted),
    };
    let own = metric.extent(q) / metric.extent(v);
    // At rest coordinates do not change, and at the origin they have no size.
    let longest = if own.is_finite() && own.is_positive() { left.signum() * own } else { left };
    let mut time = half * longest;
    let (mut leads_out, mut alike) = (false, 0);
    for _ in 0..LENGTHS {
        *memory = kept;
        let mut beyond = kept.start.at_time(kept.start.t + time);
        for (q, v) in beyond.q.iter_mut().zip(beyond.v) {
            *q += time * v;
        }
        let there = if beyond.is_finite() { system.land_at(constants, &mut beyond, None).ok() } else { None };
        match there {
            Some(there) if there.independence.improves(&here, enough) => {
                leads_out = true;
                if shoot(memory, system, constants, control, limits, &kept.start, beyond, &there) {
                    memory.determined = Some(Determined::at_start(&there.independence));
                    memory.stand(&there);
                    return Ok(true);
                }
            }
            Some(Footing { independence: there, .. }) if there.rank < there.rows && !leads_out => {
                alike += 1;
                if alike == ALIKE {
                    break;
                }
            }
            _ => {}
        }
        time *= half;
    }
    *memory = kept;
    if leads_out {
        let constraint = here.weakest;
        return Err(Cause::Undetermined { constraint, name: S::NAMES.constraint(constraint) });
    }
    Ok(false)
}

/// Moves `beyond` until its series leads to `from`. The memory then holds the step between them.
///
/// Across the constraints the roundings of a state grow towards `from`, and what differs there says nothing
/// about the motion: no more than half of all digits may. What differs along the constraints is an error of
/// `beyond`, and is carried to it until rounding leaves nothing to carry: a motion that passes many such
/// configurations would add up what is left.
#[allow(clippy::too_many_arguments)]
fn shoot<S, const N: usize, const K: usize>(
    memory: &mut <Jets as Adaptive<S, Held<S::Scalar, K>, N, K>>::Memory,
    system: &S,
    constants: &S::Constants,
    control: &Held<S::Scalar, K>,
    limits: &Limits<S::Scalar>,
    from: &State<S::Scalar, N>,
    mut beyond: State<S::Scalar, N>,
    footing: &Footing<S::Scalar, N>,
) -> bool
where
    S: Smooth<N, K>,
    S::Scalar: Ordered,
{
    let time = beyond.t - from.t;
    let (one, metric): (S::Scalar, _) = (num_traits::One::one(), &footing.metric);
    // This check takes the end for the state before the step, because the series leads from there to `from`.
    let ahead = beyond;
    let check = Check { system, constants, inputs: &control.0, limits, from: &ahead };
    // The state nearest to `from` at which the constraints determine what is along them.
    let half = S::Scalar::from_f64(0.5);
    let near = one - smaller(determined::<S::Scalar>() / footing.independence.least, half);
    let mut rest = S::Scalar::from_f64(f64::MAX);
    for _ in 0..CORRECTIONS {
        memory.start = beyond;
        memory.unit = -time;
        if !expansion::outlined(memory, system, control, &beyond) || !memory.is_finite() {
            return false;
        }
        let near = memory.state_at(near);
        let along = |change: &State<S::Scalar, N>| system.tangential_at(&near, change);
        let is_small = |change: &State<S::Scalar, N>| {
            check.is_half(change, time, footing) && check.is_small(&along(change), time, footing)
        };
        let lack = apart(from, &memory.state_at(one));
        if !memory.last_terms(one).iter().all(is_small) || !lack.is_finite() {
            return false;
        }
        let last = rest;
        let carried = along(&lack);
        rest = metric.extent(&carried.q) + time.abs() * metric.extent(&carried.v);
        let has_converged = rest >= half * last;
        if has_converged && is_small(&lack) && (Check { from, ..check }).keeps_energy(&beyond, footing) {
            memory.series.recentre(one, memory.orders);
            memory.turn();
            memory.is_as_expanded = false;
            (memory.start, memory.end) = (*from, beyond);
            memory.end_residue = apart(from, from);
            memory.end_residue.t = num_traits::Zero::zero();
            (memory.next, memory.last) = (time.abs(), time.abs());
            return true;
        }
        for i in 0..N {
            beyond.q[i] += carried.q[i] + time * carried.v[i];
            beyond.v[i] += carried.v[i];
        }
        if !beyond.is_finite() || system.project_at(constants, &mut beyond, None).is_err() {
            return false;
        }
    }
    false
}
