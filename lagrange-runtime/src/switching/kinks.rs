//! The sides of kinks that a state tells.

use super::Switching;
use super::scene::{above, rounding};
use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::state::State;

/// The sides of kinks at a state. A switching function that is zero up to rounding has no side of its own and
/// keeps the `present` one.
pub(super) fn sides<R: Real, const W: usize>(kinks: &[R; W], present: &[R; W], sizes: &[R; W]) -> [R; W] {
    array(|kink| {
        if !above(kinks[kink].abs(), rounding::<R>() * sizes[kink]) {
            present[kink]
        } else if kinks[kink].is_positive() {
            R::one()
        } else {
            -R::one()
        }
    })
}

/// The sides of kinks after an impact: where it has made velocities jump over a kink, the motion goes on on
/// the other side, and has never been on the kink.
pub(super) fn jumped<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    system: &S,
    after: &State<S::Scalar, N>,
    inputs: &[S::Scalar; K],
    kinks: &[S::Scalar; W],
) -> [S::Scalar; W]
where
    S: Switching<N, K, C, W>,
{
    if const { W == 0 } {
        return *kinks;
    }
    let laws = system.laws_at(after.t, &after.q, &after.v, inputs);
    sides(&laws.kinks, kinks, &laws.kink_sizes)
}
