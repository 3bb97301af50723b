//! Where steps end: onto the constraints, with derivatives.

use super::{From, Retraction};
use crate::constraints::Surface;
use crate::constraints::residuals::Level;
use crate::linear::SaddlePoint;
use crate::number::elements::Each;
use crate::number::real::Real;
use crate::system::error::Cause;
use crate::system::state::{State, difference};

/// Moves a state that a step has left beside the constraints onto them. A state that is on them already keeps
/// its values.
///
/// Without an estimate of its error a step in fixed steps shows by its correction whether it makes sense:
/// with `from`, the state before it, a correction that is larger than all that the step itself has changed is
/// an error.
///
/// # Errors
/// The constraint that stays violated or contradicts others, [`Cause::Undetermined`], [`Cause::NotFinite`];
/// [`Cause::StepTooLong`].
#[inline]
pub fn project<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &mut State<S::Scalar, N>,
    from: Option<&State<S::Scalar, N>>,
) -> Result<(), Cause>
where
    S: Surface<N, K, C>,
{
    let residuals = system.residuals_at(state.t, &state.q, &state.v);
    if residuals.are_roundings() {
        slopes(system, state);
        return Ok(());
    }
    let mut retraction = Retraction::new(system, state, residuals);
    for level in [Level::Positions, Level::Velocities] {
        retraction.level(system, level, From::Near).map_err(|cause| match cause {
            // As many corrections as serve any state near the constraints were too few.
            Cause::PositionViolated { .. } | Cause::VelocityViolated { .. }
                if from.is_some() && !retraction.is_stuck =>
            {
                Cause::StepTooLong
            }
            cause => cause,
        })?;
    }
    if from.is_some_and(|from| retraction.outweighs(state, from)) {
        return Err(Cause::StepTooLong);
    }
    *state = retraction.state;
    slopes(system, state);
    Ok(())
}

impl<S, const N: usize, const K: usize, const C: usize> Retraction<S, N, K, C>
where
    S: Surface<N, K, C>,
{
    /// Whether the way from the `end` of a step to here is longer than the step from `from` to its end, in
    /// coordinates or in velocities, by more than noise.
    fn outweighs(&self, end: &State<S::Scalar, N>, from: &State<S::Scalar, N>) -> bool {
        let here = &self.state;
        let apart = |a, b| self.metric.extent(&difference(a, b));
        let noise = S::Scalar::epsilon().sqrt();
        [(&here.q, &end.q, &from.q), (&here.v, &end.v, &from.v)].into_iter().any(|(here, end, from)| {
            let own = apart(end, from) + noise * self.metric.extent(end);
            (apart(here, end) - own).largest() > num_traits::Zero::zero()
        })
    }
}

/// Moves the derivatives of a state on the constraints onto their tangent space, and leaves its values: one
/// correction of each level is linear in the derivatives, and makes good one order of them.
#[inline]
pub(in crate::constraints) fn slopes<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &mut State<S::Scalar, N>,
) where
    S: Surface<N, K, C>,
{
    let none = [num_traits::Zero::zero(); N];
    for _ in 0..S::Scalar::DEPTH {
        for level in [Level::Positions, Level::Velocities] {
            let (saddle, _) = system.saddle_at(state.t, &state.q, &state.v);
            let residuals = system.residuals_at(state.t, &state.q, &state.v);
            let lack = residuals.values(level).each(|residual| residual.part(0) - residual);
            let (change, _) = saddle.solve(&none, &lack);
            let numbers = if level == Level::Positions { &mut state.q } else { &mut state.v };
            for (number, change) in numbers.iter_mut().zip(change) {
                *number += change - change.part(0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use core::cell::Cell;

    use super::*;
    use crate::constraints::samples::Twofold;

    #[test]
    fn a_state_on_the_constraints_is_left_as_it_is_and_costs_no_factors() {
        for k in 0..100 {
            let rod = Twofold { factored: Cell::new(0) };
            let (sine, cosine) = (0.1 * f64::from(k)).sin_cos();
            let state = State::new([cosine, sine], [-3.0 * sine, 3.0 * cosine]);
            let mut projected = state;
            assert_eq!(project(&rod, &mut projected, None), Ok(()));
            assert_eq!((projected, rod.factored.get()), (state, 0), "{k}");
        }
    }

    #[test]
    fn a_state_beside_the_constraints_is_brought_back_by_the_shortest_way() {
        let rod = Twofold { factored: Cell::new(0) };
        let mut state = State::new([0.8 * 1.001, -0.6 * 1.001], [0.6 + 0.08, 0.8 - 0.06]);
        project(&rod, &mut state, None).unwrap();
        for (found, expected) in state.iter().zip([0.8, -0.6, 0.6, 0.8]) {
            assert!((found - expected).abs() < 1e-15, "{state:?}");
        }
    }
}
