//! Length of the first step.
//!
//! A state has three times in which it changes by its own size: ‖q‖/‖v‖, ‖v‖/‖a‖ and their geometric mean
//! √(‖q‖/‖a‖). A probe takes a part of the mean, or of another one where the mean is zero or infinite. The
//! accelerations at its end give the next derivative j, and with it ‖a‖/‖j‖ and √(‖v‖/‖j‖), of which the
//! longer one counts. Norms are largest magnitudes, so units of time and length do not matter. A guess that
//! is too long is refused, and one that is too short grows, both by a factor a step: only their cost depends
//! on it.

use num_traits::Zero;

use super::super::slopes::Slope;
use crate::number::real::{Ordered, Real, larger, smaller};
use crate::system::state::State;

/// The part of a time of the state that a probe may take.
const PROBE: f64 = 0.01;

/// The largest magnitude in an array.
fn norm<R: Ordered, const N: usize>(x: &[R; N]) -> R::Lane {
    x.iter().fold(R::Lane::zero(), |most, x| larger(most, x.part(0).largest().abs()))
}

/// Whether a quotient is a time.
fn is_time<L: Ordered>(time: &L) -> bool {
    time.is_finite() && time.is_positive()
}

/// Length of the Euler probe from a state with its `slope` \[s].
pub(super) fn probe<R: Ordered, const N: usize>(from: &State<R, N>, slope: &Slope<R, N>) -> R {
    let [q, v, a] = [norm(&from.q), norm(&from.v), norm(&slope.v)];
    let time = [(q / a).sqrt(), v / a, q / v].into_iter().find(is_time);
    // Where two of the three norms are zero, nothing tells of time.
    R::splat(time.map_or_else(|| R::Lane::from_f64(1e-6), |time| R::Lane::from_f64(PROBE) * time))
}

/// Length of the first step \[s], for accelerations that change by `change` over a probe. The error of a step
/// is of eighth order.
pub(super) fn length<R: Ordered, const N: usize>(
    from: &State<R, N>,
    slope: &Slope<R, N>,
    change: &[R; N],
    probe: R,
    relative: R::Lane,
) -> R {
    let probe = probe.largest();
    let [v, a, jerk] = [norm(&from.v), norm(&slope.v), norm(change) / probe];
    let longest = R::Lane::from_f64(1.0 / PROBE) * probe;
    let part = relative.sqrt().sqrt().sqrt();
    // One of the two is small where the velocity or the force passes through zero.
    let time = larger(a / jerk, (v / jerk).sqrt());
    R::splat(if is_time(&time) { smaller(part * time, longest) } else { longest })
}
