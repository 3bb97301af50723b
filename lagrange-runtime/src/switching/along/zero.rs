//! The zero of a guard itself beside that of its polynomial.

use super::super::guards::{Guard, Guards};
use super::super::scene::above;
use super::super::{Row, Switching};
use crate::motion::roots::{Kind, Side, Zero};
use crate::number::real::{Ordered, Real};
use crate::number::rounded::Rounded;
use crate::system::state::State;

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Guards<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The part of the step where a guard itself is zero beside a fall of its polynomial, which is known
    /// until a later part. The polynomial has the rounding errors of the whole part of the step that it is
    /// taken on. The place stays as it is where the guard is within the rounding errors of its own value,
    /// or where it has fallen before. `None` where the guard has not fallen: the polynomial does by its
    /// truncation error. `sizes` bound the summands of the state there.
    pub(in crate::switching) fn at_zero(
        &self,
        guard: Guard,
        [place, until]: [S::Scalar; 2],
        sizes: &State<S::Scalar, N>,
        mut at: impl FnMut(S::Scalar) -> Option<State<S::Scalar, N>>,
    ) -> Option<S::Scalar> {
        let half = S::Scalar::from_f64(0.5);
        let mut value = |place: S::Scalar| {
            let nothing = Rounded::exact(S::Scalar::from_f64(f64::NAN));
            at(place).map_or(nothing, |state| self.value(guard, &state, sizes))
        };
        let there = value(place);
        // No place is before a start, and a guard that is NaN has no better place.
        if place == num_traits::Zero::zero() || !above(there.value.abs(), there.error) {
            return Some(place);
        }
        // The start is excluded: a guard that was zero there is zero there again.
        let bracket = [half * place, until];
        let zero = Zero { theta: place, kind: Kind::Falling, side: Side::Below, bracket };
        let zero = zero.polish(|place| value(place).value);
        // A load is a size: behind its zero it grows again, and its polynomial alone falls.
        let is_size = matches!(guard, Guard::Row(row) if S::ROWS.get(row) == Some(&Row::Load));
        (is_size || zero != place || there.value < num_traits::Zero::zero()).then_some(zero)
    }
}
