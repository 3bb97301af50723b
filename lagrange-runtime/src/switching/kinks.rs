//! The sides of kinks that a state tells.

use super::scene::{above, entry, rounding};
use super::{Regime, Switching, Wanted};
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

/// The sides of kinks after some have been crossed, which had the sides `before`. A switch in the argument of
/// another one makes that argument leap, and the other one goes to the side where it is then. Zero counts as
/// positive, as in the condition that an argument is not negative.
pub(super) fn followed<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    inputs: &[S::Scalar; K],
    before: &[S::Scalar; W],
    crossed: &[S::Scalar; W],
) -> [S::Scalar; W]
where
    S: Switching<N, K, C, W>,
{
    if const { W < 2 } {
        return *crossed;
    }
    let State { t, q, v } = state;
    let sizes = system.laws_at(*t, q, v, inputs).kink_sizes;
    let wanted = Wanted { rows: [false; C], fixed: [false; C], kinks: [true; W] };
    let values = |kinks: &[S::Scalar; W]| {
        let in_regime = system.in_regime(&Regime { kinks: *kinks, ..Regime::open(&S::ROWS) });
        S::functions_in(&in_regime, |x| x, *t, q, v, inputs, &wanted).kinks
    };
    let (mut sides, mut last) = (*crossed, values(before));
    // The argument of a switch contains others, but not itself: each round settles one more layer.
    for _ in 0..W {
        let here = values(&sides);
        let present = sides;
        for (kink, side) in sides.iter_mut().enumerate() {
            let (now, least) = (entry(&here, kink), rounding::<S::Scalar>() * entry(&sizes, kink));
            let has_leapt = above((now - entry(&last, kink)).abs(), least);
            let is_zero = !above(now.abs(), least);
            if has_leapt && (above(-*side * now, least) || is_zero && (-*side).is_positive()) {
                *side = -*side;
            }
        }
        if sides == present {
            break;
        }
        last = here;
    }
    sides
}
