//! What a step has passed that was taken by a method that does not look for kinks.
//!
//! An energy, a momentum or a constraint that jumps at a kink need not show in the equations on its sides, so
//! that the errors of a step do not tell. The functions that are zero there do: they have changed sign.

use super::corners::{break_at, corner_at, jumps};
use super::scene::entry;
use super::{Row, Switching};
use crate::number::elements::{Each, array};
use crate::number::real::{Real, any};
use crate::system::error::Cause;
use crate::system::name::Name;
use crate::system::state::State;

/// Refuses a step across a kink at which an energy, a momentum or a constraint jumps. What changes sign twice
/// within the step is not seen.
///
/// # Errors
/// [`Cause::EnergyJumps`], [`Cause::MomentumJumps`], [`Cause::GapJumps`].
#[doc(hidden)]
pub fn passed<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    system: &S,
    from: &State<S::Scalar, N>,
    to: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Result<(), Cause>
where
    S: Switching<N, K, C, W>,
{
    let kinks_at = |State { t, q, v }: &State<S::Scalar, N>| system.laws_at(*t, q, v, u).kinks;
    let [before, after] = [kinks_at(from), kinks_at(to)];
    for kink in 0..W {
        let crossed = crossing(entry(&before, kink), entry(&after, kink));
        if any(crossed) {
            let place = between(from, to, &|state| entry(&kinks_at(state), kink));
            found_at(system, kink, &place, [from, to], u, crossed)?;
        }
    }
    Ok(())
}

/// One in the lanes in which a function has changed sign. Zero counts as positive, so that a step that ends
/// at a zero and the next one pass it once.
fn crossing<R: Real>(before: R, after: R) -> R {
    (before.step() - after.step()).abs()
}

/// The state on the straight line from one to another at which a function vanishes, lane by lane.
fn between<R: Real, const N: usize>(
    from: &State<R, N>,
    to: &State<R, N>,
    function: &impl Fn(&State<R, N>) -> R,
) -> State<R, N> {
    let at = |part: R| {
        let mix = |a: R, b: R| a + part * (b - a);
        State {
            t: mix(from.t, to.t),
            q: array(|i| mix(from.q[i], to.q[i])),
            v: array(|i| mix(from.v[i], to.v[i])),
        }
    };
    let start = function(from);
    let (mut part, mut width) = (R::zero(), R::one());
    while (width - R::epsilon()).is_positive() {
        width *= R::from_f64(0.5);
        let crossed = crossing(start, function(&at(part + width)));
        part += width * (R::one() - crossed);
    }
    at(part + width)
}

/// What jumps at a kink, in the lanes where `crossed` is one.
fn found_at<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    system: &S,
    kink: usize,
    place: &State<S::Scalar, N>,
    ends: [&State<S::Scalar, N>; 2],
    u: &[S::Scalar; K],
    crossed: S::Scalar,
) -> Result<(), Cause>
where
    S: Switching<N, K, C, W>,
{
    let name = S::KINKS.get(kink).copied().unwrap_or(Name::NONE);
    let [elsewhere, _] = ends;
    let energy = |State { t, q, v }: &State<S::Scalar, N>| {
        let [gain, size] = system.jumps_at(*t, q, v, u).each(|numbers| entry(&numbers, kink));
        [crossed * gain, size]
    };
    if jumps(place, elsewhere, &energy) {
        return Err(Cause::EnergyJumps { kink, name });
    }
    let (mut number, mut corner) = (0, false);
    system.corners_at(place.t, &place.q, &place.v, u, |own, _, _| {
        number += 1;
        // At the kink itself a momentum may be nothing but rounding errors, and so may its gain.
        let sizes = ends.map(|end| corner_at(system, number, end, u)).into_iter().flatten();
        let size = sizes.fold(num_traits::Zero::zero(), |most: S::Scalar, size| most.max(size.abs()));
        let beside = |state: &State<S::Scalar, N>| {
            let [gain, here] = corner_at(system, number, state, u);
            [crossed * gain, here.max(size)]
        };
        corner |= own == kink && jumps(place, elsewhere, &beside);
    });
    if corner {
        return Err(Cause::MomentumJumps { kink, name });
    }
    let constraint = |row: usize, state: &State<S::Scalar, N>| {
        let State { t, q, v } = state;
        let sizes = system.laws_at(*t, q, v, u).rows.position_sizes;
        [crossed * break_at(system, [kink, row], state, u), entry(&sizes, row)]
    };
    let mut held = (0..C).filter(|&row| S::ROWS.get(row) == Some(&Row::Bilateral));
    match held.find(|&row| jumps(place, elsewhere, &|state| constraint(row, state))) {
        Some(row) => Err(Cause::GapJumps { constraint: row, name: S::NAMES.constraint(row) }),
        None => Ok(()),
    }
}
