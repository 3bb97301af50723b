//! Accelerations at the stages of a method for ordinary differential equations. These lie beside the
//! constraints, and sometimes in a configuration in which the constraints depend on each other.

use super::residuals::Level;
use super::retraction::{From, Retraction};
use super::start::contradiction;
use super::{Balance, Equations, Factors, Metric, Surface, moved, project};
use crate::linear::{CLEAR, Independence, SaddlePoint, determined};
use crate::number::elements::{Each, array};
use crate::number::real::Real;
use crate::system::error::Cause;
use crate::system::name::Name;
use crate::system::state::State;

/// Accelerations of a state beside the constraints.
///
/// * Where the rows of A are clearly independent they follow from the equations at the state itself.
/// * Where the rows all but depend on each other, the equations beside the constraints have poles: the
///   distance of a state from the constraints changes its accelerations by the reciprocal of the distance of
///   the rows. The accelerations are those of the nearest state on the constraints: as good a continuation of
///   the equations, and a smooth one. It costs three factorisations instead of one, so it is left out where
///   rows of holonomic constraints are only close: the check of the step's end sees what poles do there.
/// * Rows that depend on each other wherever the constraints hold are independent beside them. Together they
///   demand there what no motion can do. The nearest state on the constraints serves there too.
/// * In a configuration where rows lose their independence for a moment, the accelerations are interpolated
///   between states before and after it, along the velocity. They are those of the motion that goes straight
///   on.
#[inline]
pub fn accelerations<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    t: S::Scalar,
    q: &[S::Scalar; N],
    v: &[S::Scalar; N],
    u: &[S::Scalar; K],
) -> [S::Scalar; N]
where
    S: Surface<N, K, C>,
{
    let equations = system.equations_at(constants, t, q, v, u);
    let balance = equations.balance();
    if is_clear::<S, N, K, C>(&balance.independence) && !may_vanish(&equations, q, v) {
        return balance.accelerations;
    }
    settled(system, constants, &State { t, q: *q, v: *v }, equations, u).unwrap_or(balance.accelerations)
}

/// Whether some gradient is so small beside how fast it changes that it may be about to vanish: the distance
/// from there, at the present velocities, is a small part of the coordinates. Gradients that vanish together
/// stay far apart, so the factors do not show this.
#[inline(always)]
fn may_vanish<P, R, const N: usize, const C: usize>(
    equations: &Equations<P, R, N, C>,
    q: &[R; N],
    v: &[R; N],
) -> bool
where
    P: SaddlePoint<R, N, C>,
    R: Real,
{
    let metric = Metric::of(&equations.saddle);
    let (size, speed) = (metric.extent(q), metric.extent(v));
    let least = R::from_f64(CLEAR) * size;
    metric.slopes(&equations.gradients).iter().zip(&equations.gamma).any(|(&slope, gamma)| {
        (least * gamma.abs() - slope * speed * speed).largest() > num_traits::Zero::zero()
    })
}

/// Accelerations of the nearest state on the constraints, or of its neighbours, where those of the state
/// itself are no good.
#[cold]
#[inline(never)]
fn settled<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    Equations { saddle, gradients, .. }: Equations<S::Saddle, S::Scalar, N, C>,
    u: &[S::Scalar; K],
) -> Option<[S::Scalar; N]>
where
    S: Surface<N, K, C>,
{
    if !is_beside(system, state, (saddle, gradients)) {
        return None;
    }
    let (near, equations) = nearest(system, constants, state, u)?;
    let Balance { accelerations, independence: here, .. } = equations.balance();
    let factors = (equations.saddle, equations.gradients);
    if here.is_determined() {
        return Some(accelerations);
    }
    // Independent rows that determine the accelerations neither here nor beside here give none.
    let own = if here.rank < here.rows { accelerations } else { [S::Scalar::from_f64(f64::NAN); N] };
    let Some(time) = travel_time(&near, &factors.0) else { return Some(own) };
    if here.rank < here.rows && are_redundant(system, &near, factors, time) {
        return Some(own);
    }
    Some(between(system, constants, &near, &here, time, u).unwrap_or(own))
}

/// Whether the nearest state on the constraints has better accelerations than the state of these factors.
#[cold]
fn is_beside<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    factors: Factors<S, N, K, C>,
) -> bool
where
    S: Surface<N, K, C>,
{
    let residuals = system.residuals_at(state.t, &state.q, &state.v);
    let own = Retraction::<S, N, K, C>::with(state, residuals, factors);
    let nearness = own.nearness();
    // Where rows all but vanish together, the nearest state has another velocity.
    let is_clear = is_clear::<S, N, K, C>;
    !is_clear(&nearness) && (!is_clear(&own.saddle.independence()) || nearness.is_determined())
}

/// Whether no pole is near enough to count. Holonomic constraints bring the end of a step back from where a
/// pole has led it. Nonholonomic ones leave the coordinates there.
#[inline(always)]
fn is_clear<S, const N: usize, const K: usize, const C: usize>(here: &Independence<S::Scalar>) -> bool
where
    S: Surface<N, K, C>,
{
    if S::HOLONOMIC.contains(&false) { here.are_far_apart() } else { here.is_clear() }
}

/// The state whose derivatives go with [`accelerations`]: of several constraints the nearest state on them,
/// where the accelerations are taken there.
pub(crate) fn settled_state<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> State<S::Scalar, N>
where
    S: Surface<N, K, C>,
{
    // One row depends on no other, and the accelerations of its system are always those of the state itself.
    if C == 1 {
        return *state;
    }
    let equations = system.equations_at(constants, state.t, &state.q, &state.v, u);
    let is_clear = is_clear::<S, N, K, C>(&equations.saddle.independence())
        && !may_vanish(&equations, &state.q, &state.v);
    let mut near = *state;
    // Motions by Baumgarte's method are not projected.
    if !is_clear
        && is_beside(system, state, (equations.saddle, equations.gradients))
        && system.project_at(constants, &mut near, None).is_ok()
    {
        return near;
    }
    *state
}

/// A state on the constraints, and the equations there.
type Settled<S, R, const N: usize, const C: usize> = (State<R, N>, Equations<S, R, N, C>);

/// The nearest state on the constraints, and the equations there.
fn nearest<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Option<Settled<S::Saddle, S::Scalar, N, C>>
where
    S: Surface<N, K, C>,
{
    let mut near = *state;
    project(system, &mut near, None).ok()?;
    let equations = system.equations_at(constants, near.t, &near.q, &near.v, u);
    Some((near, equations))
}

/// Distance of the first neighbours, in units of ∜ε times the time in which coordinates change by their size.
const CLOSE: f64 = 0.125;

/// How often neighbours may be moved further away, by the factor [`WIDER`], until they are well determined.
const WIDENINGS: i32 = 10;

/// See [`WIDENINGS`].
const WIDER: f64 = 2.0;

/// The number of widenings between two questions whether rows are redundant.
const STRIDE: usize = 3;

/// The time \[s] to neighbours that have been moved away so often.
fn apart<R: Real>(time: R, widenings: i32) -> R {
    R::from_f64(CLOSE) * R::from_f64(WIDER).powi(widenings) * determined::<R>() * time
}

/// Whether rows that depend on each other at a state on the constraints do so on all of them: then they do at
/// the furthest neighbour as well. The factors at the state serve the way there, so this is cheap, and
/// the usual case of dependent rows.
fn are_redundant<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    factors: Factors<S, N, K, C>,
    time: S::Scalar,
) -> bool
where
    S: Surface<N, K, C>,
{
    let here = factors.0.independence();
    let none = [num_traits::Zero::zero(); N];
    // Where coordinates are large beside the system, the furthest neighbours have no place in it.
    (0..WIDENINGS).rev().step_by(STRIDE).find_map(|widenings| {
        let there = moved(state, &state.v, &none, apart(time, widenings));
        let mut retraction = Retraction::from_elsewhere(system, &there, factors.clone());
        retraction.level(system, Level::Positions, From::Near).ok()?;
        retraction.refresh(system);
        let there = retraction.saddle.independence();
        retraction.saddle.defect().is_none().then(|| !there.improves(&here, determined()))
    }) == Some(true)
}

/// Whether constraints keep a state from having accelerations.
///
/// # Errors
/// [`Cause::Contradictory`], or [`Cause::Undetermined`] where rows lose their independence at this state.
#[cold]
pub(super) fn check<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    factors: Factors<S, N, K, C>,
) -> Result<(), Cause>
where
    S: Surface<N, K, C>,
{
    let here = factors.0.independence();
    if here.is_determined() {
        return Ok(());
    }
    contradiction(system, state)?;
    let time = travel_time(state, &factors.0);
    let passes =
        here.rank == here.rows || time.is_some_and(|time| !are_redundant(system, state, factors, time));
    let none = [num_traits::Zero::zero(); K];
    let own = || system.balance_at(&system.constants(), state.t, &state.q, &state.v, &none).accelerations;
    // A value that is not finite without constraints is not their fault.
    if passes && own().iter().all(|a| a.is_finite()) {
        return Err(Cause::Undetermined { constraint: here.weakest, name: Name::NONE });
    }
    Ok(())
}

/// Accelerations by interpolation between six neighbours, three on each side along the velocity. The rows
/// have to be more independent there than `here`. `None` where no such neighbours exist.
fn between<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    here: &Independence<S::Scalar>,
    time: S::Scalar,
    u: &[S::Scalar; K],
) -> Option<[S::Scalar; N]>
where
    S: Surface<N, K, C>,
{
    let number = S::Scalar::from_f64;
    let none = [num_traits::Zero::zero(); N];
    (0..WIDENINGS).find_map(|widenings| {
        let at = |place: f64| {
            let there = moved(state, &state.v, &none, number(place) * apart(time, widenings));
            let (_, equations) = nearest(system, constants, &there, u)?;
            let balance = equations.balance();
            balance.independence.improves(here, determined()).then_some(balance.accelerations)
        };
        let sum = |near: f64| {
            let (a, b) = (at(-near)?, at(near)?);
            Some(array::<_, N>(|i| a[i] + b[i]))
        };
        let (a, b, c) = (sum(1.0)?, sum(2.0)?, sum(3.0)?);
        let weights = [0.75, -0.3, 0.05].each(number);
        Some(array(|i| weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i]))
    })
}

/// The time \[s] in which the coordinates change by their size, in the kinetic metric; `None` at rest.
fn travel_time<R: Real, const N: usize, const C: usize>(
    state: &State<R, N>,
    saddle: &impl SaddlePoint<R, N, C>,
) -> Option<R> {
    let metric = Metric::of(saddle);
    let time = metric.extent(&state.q) / metric.extent(&state.v);
    (time.is_finite() && time.is_positive()).then_some(time)
}

#[cfg(test)]
mod tests {
    use core::cell::Cell;

    use super::*;
    use crate::constraints::samples::Twofold;
    use crate::linear::Saddle;

    /// The acceleration of a pendulum along its rod is v², and across it that of gravity.
    fn expected(q: [f64; 2], v: [f64; 2]) -> [f64; 2] {
        let length = q[0].hypot(q[1]);
        let [x, y] = q.map(|x| x / length);
        let tension = v[0] * v[0] + v[1] * v[1] - 9.81 * y;
        [-tension * x, -9.81 - tension * y]
    }

    #[test]
    fn redundant_rows_cost_a_few_factors() {
        // On the rod, and where a stage may lie.
        for beside in [0.0, 1e-9, 1e-5, 1e-3] {
            let rod = Twofold { factored: Cell::new(0) };
            let (q, v) = ([0.8 * (1.0 + beside), -0.6 * (1.0 + beside)], [0.6, 0.8]);
            let found = accelerations(&rod, &(), 0.0, &q, &v, &[]);
            for (found, expected) in found.iter().zip(expected(q, v)) {
                assert!((found - expected).abs() < 1e-13 + 10.0 * beside, "{found} for {expected}");
            }
            assert!(rod.factored.get() <= 8, "{} factors", rod.factored.get());
        }
    }

    #[test]
    fn redundant_rows_determine_a_motion_at_rest_and_at_speed() {
        let rod = Twofold { factored: Cell::new(0) };
        for v in [[0.0, 0.0], [0.6, 0.8]] {
            let state = State::new([0.8, -0.6], v);
            assert_eq!(check(&rod, &state, rod.saddle_at(0.0, &state.q, &state.v)), Ok(()), "{v:?}");
        }
    }

    #[test]
    fn a_gradient_that_is_small_beside_how_fast_it_changes_may_vanish() {
        let (q, v, gamma) = ([3.0, 0.0], [2.0, 0.0], 5.0);
        // |γ| / speed² is how fast the gradient changes along the way, which leads through the coordinates.
        let bound = CLEAR * 3.0 * gamma / 4.0;
        for (part, may) in [(0.9, true), (1.1, false)] {
            let gradients = [[part * bound, 0.0]];
            let saddle = Saddle::factor(&[[1.0, 0.0], [0.0, 1.0]], &gradients);
            let equations = Equations { saddle, gradients, forces: [0.0; 2], gamma: [-gamma] };
            assert_eq!(may_vanish(&equations, &q, &v), may, "{part}");
        }
    }
}
