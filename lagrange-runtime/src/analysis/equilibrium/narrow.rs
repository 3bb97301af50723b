//! Hills on a step that are narrower than the points that look for them.

use super::statics::Statics;
use crate::analysis::Tangent;
use crate::integrator::hidden::{InEquations, Passage};
use crate::number::elements::array;
use crate::number::real::{Ordered, Real, larger};
use crate::system::control::Held;
use crate::system::state::State;

/// The part of the largest power below which a narrow well may hold. The places that are visited in a bump
/// exp(−x²) have six sevenths of its steepest slope.
const HELD: f64 = 0.25;

impl<S, const N: usize, const K: usize, const C: usize> Statics<'_, S, N, K, C>
where
    S: Tangent<N, K, C>,
    S::Scalar: Ordered,
{
    /// Whether the forces on a straight `way` from a position hardly point forward where functions may be
    /// narrow, or an angle of such a function turns further than its course can be followed. `power` is that
    /// of the forces after a share of the way, `known` what it is at some places.
    #[cold]
    #[inline(never)]
    pub fn meets_a_narrow_hill(
        &self,
        from: &[S::Scalar; N],
        way: &[S::Scalar; N],
        known: &[S::Scalar],
        mut power: impl FnMut(S::Scalar) -> S::Scalar,
    ) -> bool {
        let (zero, one): (S::Scalar, S::Scalar) = (num_traits::Zero::zero(), num_traits::One::one());
        let held = S::Scalar::from_f64(HELD) * known.iter().fold(zero, |most, x| larger(x.abs(), most));
        let hiding = InEquations { system: self.system, control: &Held(*self.u), roots: true };
        let state_at = |share: S::Scalar| State {
            t: self.t,
            ..State::at_rest(array(|i| S::Scalar::mul_add(share, way[i], from[i])))
        };
        let passage = Passage { hiding: &hiding, state_at: &state_at, theta: one };
        // The end is visited where nothing is narrow.
        let look = |share: S::Scalar| if share < one && power(share) < held { one } else { zero };
        passage.search(look).is_positive()
    }
}
