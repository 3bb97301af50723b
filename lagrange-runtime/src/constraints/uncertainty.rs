//! How uncertain a state is through the roundings of its constraints.

use super::extent::Extent;
use super::residuals::{Level, ULPS};
use super::{Surface, moved};
use crate::linear::SaddlePoint;
use crate::real::Real;
use crate::state::State;

/// How uncertain a state is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertainty<R, const N: usize> {
    /// Of each coordinate.
    pub q: [R; N],
    /// Of each velocity.
    pub v: [R; N],
    /// A state that cannot be told from this one, displaced as far as roundings may.
    pub other: State<R, N>,
}

impl<R: Real, const N: usize> Uncertainty<R, N> {
    /// None at all.
    pub(crate) fn none(state: &State<R, N>) -> Self {
        Self { q: [R::zero(); N], v: [R::zero(); N], other: *state }
    }
}

/// What roundings of the constraint functions make of the coordinates and of the velocities: the sum of the corrections that
/// they ask for, each as large as it may be. Coordinates are uncertain by ε/σ, with the least singular value σ of the scaled
/// gradients; velocities also by what that makes of the gradients, ε/σ².
#[cold]
pub fn uncertainty<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
) -> Uncertainty<S::Scalar, N>
where
    S: Surface<N, K, C>,
{
    let zero: S::Scalar = num_traits::Zero::zero();
    let none = [zero; N];
    let (saddle, gradients) = system.saddle_at(state.t, &state.q, &state.v);
    let residuals = system.residuals_at(state.t, &state.q, &state.v);
    let ulps = S::Scalar::from_f64(ULPS) * S::Scalar::epsilon();
    // A unit vector times `by`, and what it moves.
    let moves = |c: usize, by: S::Scalar| {
        let mut residual = [zero; C];
        residual[c] = by;
        saddle.solve(&none, &residual).0
    };
    let add = |to: &mut [S::Scalar; N], change: &[S::Scalar; N]| {
        for (to, x) in to.iter_mut().zip(change) {
            *to += x.abs();
        }
    };
    let (mut q, mut v) = (none, none);
    let roundings = |level: Level, numbers: &[S::Scalar; N]| {
        let by_state = Extent::of(&saddle, numbers).sizes(&saddle, &gradients);
        let own = residuals.sizes(level);
        core::array::from_fn::<_, C, _>(|c| ulps * (own[c] + by_state[c]))
    };
    let mut rates = roundings(Level::Velocities, &state.v);
    for (c, by) in roundings(Level::Positions, &state.q).into_iter().enumerate() {
        let change = moves(c, by);
        add(&mut q, &change);
        let there = moved(state, &change, &none, num_traits::One::one());
        let moved = system.residuals_at(there.t, &there.q, &there.v).rates;
        for (rate, (&there, &here)) in rates.iter_mut().zip(moved.iter().zip(&residuals.rates)) {
            *rate += (there - here).abs();
        }
    }
    for (c, by) in rates.into_iter().enumerate() {
        add(&mut v, &moves(c, by));
    }
    // The signs to which multipliers respond add up, and the velocities follow the gradients.
    let sizes = roundings(Level::Positions, &state.q);
    let (_, response) = saddle.solve(&none, &sizes);
    let signed = core::array::from_fn(|c| sizes[c] * response[c].signum());
    let one = num_traits::One::one();
    let turned = moved(state, &saddle.solve(&none, &signed).0, &none, one);
    let rates = system.residuals_at(turned.t, &turned.q, &turned.v).rates;
    let back = core::array::from_fn(|c| residuals.rates[c] - rates[c]);
    let other = moved(&turned, &none, &saddle.solve(&none, &back).0, one);
    Uncertainty { q, v, other }
}
