//! A step of a series that is expanded about its **end**.
//!
//! At a distance d from a configuration in which constraints depend on each other, a state is known across
//! them to ε/d, and the terms of its series are those of the motion and (ε/d)(h/d)ᵏ. A step that begins close
//! to such a configuration and leads away ends at a larger distance, so the series about its end has far
//! smaller errors. The end is found by shooting: the state on the constraints whose series leads back to the
//! start, along the constraints. What rounding errors have made of the start across them does not matter, and
//! its velocity decides along which of the motions that meet there it goes on.

use super::super::landing::NOISE;
use super::{JetMemory, falls};
use crate::number::real::Real;
use crate::system::error::Cause;
use crate::system::footing::Footing;
use crate::system::smooth::{Series, Smooth};
use crate::system::state::{State, difference};

/// Corrections of the end of a step. Each leaves a part of the error that is the square of the step over
/// the time in which accelerations change.
const CORRECTIONS: usize = 24;

/// The most halvings of a step, until one end of its first part is far enough from configurations in which
/// constraints depend on each other.
const HALVINGS: i32 = 6;

/// The largest accepted gap between the series and the start of the step, in units of its last terms, beside
/// half of all digits.
const MARGIN: f64 = 16.0;

/// The state after a step, by series about the start or the end of its parts, whichever describes the motion.
#[cold]
#[inline(never)]
pub(super) fn advance<S, const N: usize, const K: usize, const ORDER: usize>(
    memory: &mut JetMemory<S::JetConstants, S::Tables<ORDER>, S::Scalar, N, ORDER>,
    system: &S,
    outer: &S::Constants,
    from: &State<S::Scalar, N>,
    h: S::Scalar,
    u: &[S::Scalar; K],
) -> Result<State<S::Scalar, N>, Cause>
where
    S: Smooth<N, K>,
{
    let JetMemory { constants, tables, series, rank_so_far, .. } = memory;
    let mut step = Step { system, outer, constants, tables, series, u, rank: 0, contradiction: None };
    let here = system.land_at(outer, &mut from.clone(), None)?;
    let mut weakest = here.independence.weakest;
    step.rank = rank_so_far.unwrap_or_else(|| {
        // Rows that depend on each other at the start of a motion do so everywhere, or at this configuration
        // only.
        let ahead = system.land_at(outer, &mut flown(from, h), None);
        ahead.map_or(0, |ahead| ahead.independence.rank).max(here.independence.rank)
    });
    *rank_so_far = Some(step.rank);
    let shortest = S::Scalar::from_f64(0.5).powi(HALVINGS);
    // The remaining part of the step, and the next part: sums of few powers of two.
    let (mut left, mut part): (S::Scalar, S::Scalar) = (num_traits::One::one(), num_traits::One::one());
    let mut state = *from;
    while left.abs().largest() > num_traits::Zero::zero() {
        let length = part * h;
        if let Some(next) = step.about_either(&state, length) {
            state = next;
            left -= part;
            part = part.min(left);
            continue;
        }
        part *= S::Scalar::from_f64(0.5);
        if (shortest - part).largest() > num_traits::Zero::zero() {
            if let Some(contradiction) = step.contradiction {
                return Err(contradiction);
            }
            if let Ok(here) = system.land_at(outer, &mut state, None) {
                weakest = here.independence.weakest;
            }
            return Err(Cause::Undetermined { constraint: weakest, name: S::NAMES.constraint(weakest) });
        }
    }
    Ok(state.at_time(from.t + h))
}

/// The data of a step.
struct Step<'a, S: Smooth<N, K>, const N: usize, const K: usize, const ORDER: usize> {
    system: &'a S,
    outer: &'a S::Constants,
    constants: &'a mut S::JetConstants,
    tables: &'a mut S::Tables<ORDER>,
    series: &'a mut Series<S::Scalar, N, ORDER>,
    u: &'a [S::Scalar; K],
    /// The number of independent constraints.
    rank: usize,
    /// The error of the last landing, if rows contradict each other.
    contradiction: Option<Cause>,
}

impl<S, const N: usize, const K: usize, const ORDER: usize> Step<'_, S, N, K, ORDER>
where
    S: Smooth<N, K>,
{
    /// Expands the series about a state, in units of `h`, and returns the state that it leads to.
    fn expand(&mut self, at: &State<S::Scalar, N>, h: S::Scalar) -> Option<State<S::Scalar, N>> {
        let Self { system, constants, tables, series, u, .. } = self;
        if !system.jet_at(constants, at.t, &at.q, &at.v, u, h, ORDER, tables, series) {
            return None;
        }
        let (gain_q, gain_v) = series.sum();
        let mut next = at.at_time(at.t + h);
        for i in 0..N {
            next.q[i] += gain_q[i];
            next.v[i] += gain_v[i];
        }
        next.is_finite().then_some(next)
    }

    /// Moves a state to the nearest one on the constraints, and returns how well that is determined.
    fn land(&mut self, state: &mut State<S::Scalar, N>) -> Option<Footing<S::Scalar, N>> {
        let landed = self.system.land_at(self.outer, state, None);
        self.contradiction =
            landed.as_ref().err().copied().filter(|cause| matches!(cause, Cause::Contradictory { .. }));
        landed.ok()
    }

    /// Whether the series about a state describes the motion along the constraints up to the `end` of the
    /// step.
    fn is_sound(&self, footing: &Footing<S::Scalar, N>, end: &State<S::Scalar, N>) -> bool {
        let here = &footing.independence;
        if here.rank < self.rank || here.rank == here.rows && !here.is_determined() {
            return false;
        }
        let known = S::Scalar::from_f64(NOISE) * S::Scalar::epsilon() / here.least;
        let metric = &footing.metric;
        let along = |[q, v]: [&[S::Scalar; N]; 2]| {
            let along = self.system.tangential_at(end, &State { q: *q, v: *v, ..*end });
            [metric.extent(&along.q), metric.extent(&along.v)]
        };
        falls(self.series, [known * metric.extent(&end.q), known * metric.extent(&end.v)], along)
    }

    /// The end of a step by the series about its start or about its end. The one at which the constraints are
    /// further from depending on each other is tried first.
    fn about_either(&mut self, from: &State<S::Scalar, N>, h: S::Scalar) -> Option<State<S::Scalar, N>> {
        let here = self.land(&mut from.clone())?.independence;
        let there = self.land(&mut flown(from, h)).map(|there| there.independence);
        if there.is_some_and(|there| there.improves(&here, here.least)) {
            self.about_end(from, h).or_else(|| self.about_start(from, h))
        } else {
            self.about_start(from, h).or_else(|| self.about_end(from, h))
        }
    }

    /// The end of a step by the series about its start.
    fn about_start(&mut self, from: &State<S::Scalar, N>, h: S::Scalar) -> Option<State<S::Scalar, N>> {
        let footing = self.land(&mut from.clone())?;
        let mut end = self.expand(from, h)?;
        self.land(&mut end)?;
        self.is_sound(&footing, &end).then_some(end)
    }

    /// The end of a step as the state on the constraints whose series leads back to `from`.
    fn about_end(&mut self, from: &State<S::Scalar, N>, h: S::Scalar) -> Option<State<S::Scalar, N>> {
        let mut end = flown(from, h);
        self.land(&mut end)?;
        let mut last = None;
        for _ in 0..CORRECTIONS {
            let back = self.expand(&end, -h)?;
            let kept = end;
            let lack = [difference(&from.q, &back.q), difference(&from.v, &back.v)];
            let [positions, velocities] = &lack;
            for ((q, v), (&further, &faster)) in
                end.q.iter_mut().zip(&mut end.v).zip(positions.iter().zip(velocities))
            {
                *q += further + h * faster;
                *v += faster;
            }
            let footing = self.land(&mut end)?;
            let metric = &footing.metric;
            let sizes = [metric.extent(&end.q).max(metric.extent(&end.v) * h.abs()), metric.extent(&end.v)];
            let change = [difference(&end.q, &kept.q), difference(&end.v, &kept.v)];
            let moved =
                (metric.extent(&change[0]) / sizes[0]).max(metric.extent(&change[1]) / sizes[1]).largest();
            // The corrections go on until rounding keeps them from becoming smaller.
            if moved <= S::Scalar::epsilon().largest() || last.is_some_and(|last| moved >= last) {
                let half = S::Scalar::epsilon().sqrt();
                let rows = [&self.series.q, &self.series.v].into_iter();
                let is_back = rows.zip(lack).zip(sizes).all(|((rows, lack), size)| {
                    let last = rows.last().map_or(size, |row| metric.extent(row));
                    let bound = half * size + S::Scalar::from_f64(MARGIN) * last;
                    (metric.extent(&lack) - bound).largest() <= num_traits::Zero::zero()
                });
                let is_settled = moved <= half.largest();
                return (is_back && is_settled && self.is_sound(&footing, &end)).then_some(end);
            }
            last = Some(moved);
        }
        None
    }
}

/// The state after free flight.
fn flown<R: Real, const N: usize>(from: &State<R, N>, h: R) -> State<R, N> {
    let mut end = from.at_time(from.t + h);
    for i in 0..N {
        end.q[i] += h * from.v[i];
    }
    end
}
