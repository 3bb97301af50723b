//! States beside one, which show what a change of its numbers does to accelerations.

use crate::number::elements::{Each, array};
use crate::number::real::Real;
use crate::system::state::State;

/// The states in which the numbers of one have moved `by` these amounts: all up, all down, and half of them
/// against the other half in both ways. The halves are those of a binary digit of the numbers' places, so
/// any two numbers move against each other in some of these states: what depends on their difference changes.
pub(crate) fn beside<R: Real, const N: usize>(
    state: &State<R, N>,
    by: &State<R, N>,
) -> impl Iterator<Item = State<R, N>> + use<R, N> {
    let (state, by) = (*state, *by);
    // Time has place 0, coordinates come next, then velocities.
    let digits = usize::BITS - (2 * N).leading_zeros();
    (0..2 * (digits + 1)).map(move |pattern| {
        let (mask, is_down) = ((1_usize << (pattern / 2)) >> 1, pattern % 2 == 1);
        let moved = |place: usize, x: R, by: R| if (place & mask == 0) == is_down { x - by } else { x + by };
        State {
            t: moved(0, state.t, by.t),
            q: array(|i| moved(1 + i, state.q[i], by.q[i])),
            v: array(|i| moved(1 + N + i, state.v[i], by.v[i])),
        }
    })
}

/// An ulp of each number of a state.
pub(crate) fn ulps<R: Real, const N: usize>(state: &State<R, N>) -> State<R, N> {
    let ulp = |x: R| R::epsilon() * x.abs();
    State { t: ulp(state.t), q: state.q.each(ulp), v: state.v.each(ulp) }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::*;

    #[test]
    fn any_two_numbers_move_together_and_against_each_other() {
        let state = State { t: 3.0, q: [10.0, 20.0, 30.0, 40.0, 50.0], v: [1.0, 2.0, 4.0, 5.0, 6.0] };
        let by = State { t: 0.5, q: [0.5; 5], v: [0.5; 5] };
        let numbers = |state: &State<f64, 5>| [&[state.t][..], &state.q, &state.v].concat();
        let moves: Vec<Vec<f64>> = beside(&state, &by)
            .map(|there| {
                numbers(&there).iter().zip(numbers(&state)).map(|(there, here)| there - here).collect()
            })
            .collect();
        assert!(moves.iter().flatten().all(|change| change.abs() == 0.5));
        for (i, j) in (0..11).flat_map(|i| (0..i).map(move |j| (i, j))) {
            for together in [true, false] {
                let ways = moves.iter().filter(|changes| (changes[i] == changes[j]) == together);
                let ups = ways.clone().filter(|changes| changes[i] > 0.0).count();
                assert!(ups > 0 && 2 * ups == ways.count(), "{i} {j} {together}: {moves:?}");
            }
        }
    }
}
