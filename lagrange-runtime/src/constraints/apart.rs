//! The retraction onto the constraints in the lanes of a vector, each by its own numbers.
//!
//! Only regular lanes are handled here: their constraints are clearly independent, and a few corrections with
//! the factors of the reached state suffice. The result tells which lanes are not regular. A motion of its
//! own then takes the careful ways for such a lane.

use super::Surface;
use super::residuals::{Level, Residuals, ULPS};
use crate::linear::{CLEAR, SaddlePoint};
use crate::number::elements::Each;
use crate::number::real::Real;
use crate::system::footing::Apart;
use crate::system::metric::Metric;
use crate::system::state::State;

/// The distance that a lane keeps from the states at which lanes would have to decide together, as a multiple
/// of the necessary one: a retraction within the tolerance changes the distance by less.
const AWAY: f64 = 2.0;

/// Corrections of a level. With the factors of the start, each leaves about the same share of what was left
/// before: the relative size of the first correction.
const CORRECTIONS: usize = 8;

/// Moves a state that a step has left beside the constraints onto them.
#[inline]
pub fn land_apart<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    state: &mut State<S::Scalar, N>,
    inputs: &[S::Scalar; K],
) -> Option<Apart<S::Scalar, N>>
where
    S: Surface<N, K, C>,
{
    let number = S::Scalar::from_f64;
    let equations = system.equations_at(constants, state.t, &state.q, &state.v, inputs);
    let saddle = &equations.saddle;
    let mut close = number(AWAY) - saddle.apart()?;
    let metric = Metric::of(saddle);
    let slopes = metric.slopes(&equations.gradients);
    let mut residuals = system.residuals_at(state.t, &state.q, &state.v);
    // How close gradients are to vanishing: the contribution of the coordinates to a constraint, as a part of
    // its summands.
    let extent = metric.extent(&state.q);
    for (&slope, &summands) in slopes.iter().zip(&residuals.position_sizes) {
        close = close.max(number(AWAY * CLEAR) * summands - slope * extent);
    }
    let mut left = -<S::Scalar as num_traits::One>::one();
    for level in [Level::Positions, Level::Velocities] {
        for correction in 0..=CORRECTIONS {
            let excess = excess(&residuals, level);
            if excess.largest() <= num_traits::Zero::zero() {
                break;
            }
            let lack = residuals.values(level).each(|value| -value);
            let (change, _) = saddle.solve(&[num_traits::Zero::zero(); N], &lack);
            let numbers = if level == Level::Positions { &mut state.q } else { &mut state.v };
            // A correction below an ulp counts as none.
            let open = excess.min(metric.extent(&change) - S::Scalar::epsilon() * metric.extent(numbers));
            if correction == CORRECTIONS {
                left = left.max(open);
            } else if open.largest() <= num_traits::Zero::zero() {
                break;
            } else {
                for (number, change) in numbers.iter_mut().zip(change) {
                    *number = (*number + change).where_positive(open, *number);
                }
                residuals = system.residuals_at(state.t, &state.q, &state.v);
            }
        }
    }
    // 0 · ∞ and 0 · NaN are NaN, which comparisons might lose.
    let all: S::Scalar = residuals.positions.iter().chain(&residuals.rates).copied().sum();
    left += all * num_traits::Zero::zero();
    let accelerations = equations.balance().accelerations;
    Some(Apart { accelerations, metric, left, close })
}

/// The excess of the residuals of a level over the rounding errors of their summands.
#[inline(always)]
fn excess<R: Real, const C: usize>(residuals: &Residuals<R, C>, level: Level) -> R {
    let ulps = R::from_f64(ULPS) * R::epsilon();
    let pairs = residuals.values(level).iter().zip(residuals.sizes(level));
    pairs.fold(-R::one(), |most, (&value, &size)| most.max(value.abs() - ulps * size))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraints::samples::Rod;

    #[test]
    fn a_lane_is_brought_back_to_both_levels_or_told_to_be_off() {
        // Lanes are numbers of their own here: one.
        for off in [0.0, 1e-12, 1e-6, 1e-3] {
            let mut state = State::new([0.6 + off, -0.8 + off], [0.8 + off, 0.6 - 2.0 * off]);
            let landed = land_apart(&Rod, &(), &mut state, &[]).unwrap();
            let Residuals { positions, rates, .. } = Rod.residuals_at(0.0, &state.q, &state.v);
            assert!(positions[0].abs() < 1e-15 && rates[0].abs() < 1e-15, "{off}: {positions:?} {rates:?}");
            assert!(landed.left <= 0.0 && landed.close <= 0.0, "{off}: {landed:?}");
            assert!((state.q[0] - 0.6).abs() <= 2.0 * off + 1e-15, "{off}: {state:?}");
        }
        // Far off a few corrections are too few.
        let mut far = State::new([6.0, -80.0], [0.8, 0.6]);
        assert!(land_apart(&Rod, &(), &mut far, &[]).unwrap().left > 0.0);
        // Beside the centre the gradient all but vanishes.
        let mut centre = State::new([1e-3, 0.0], [0.0, 0.0]);
        let landed = land_apart(&Rod, &(), &mut centre, &[]).unwrap();
        assert!(landed.close > 0.0 || landed.left > 0.0, "{landed:?}");
        // What is no number is nowhere.
        let mut lost = State::new([f64::NAN, 0.0], [0.0, 0.0]);
        assert!(land_apart(&Rod, &(), &mut lost, &[]).is_none());
    }
}
