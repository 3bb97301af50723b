//! Accelerations where the stages of a method for ordinary differential equations lie: beside the
//! constraints, and sometimes in a configuration in which these depend on each other.

use super::{Balance, Metric, Surface, moved, project};
use crate::linear::{Independence, determined};
use crate::real::Real;
use crate::state::State;

/// Accelerations of a state beside the constraints.
///
/// * Where the rows of A are clearly independent they follow from the equations at the state itself.
/// * Rows that depend on each other wherever the constraints hold are independent beside them, and what they
///   then demand together is no motion. The accelerations are those of the nearest state on the constraints:
///   as good a continuation of the equations, and a smooth one.
/// * In a configuration where rows lose their independence for a moment, they are interpolated between states
///   before and after it, along the velocity: accelerations of the motion that goes straight on.
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
    let balance = system.balance_at(constants, t, q, v, u);
    if balance.independence.is_clear() {
        return balance.accelerations;
    }
    settled(system, constants, &State { t, q: *q, v: *v }, u).unwrap_or(balance.accelerations)
}

/// Accelerations of the nearest state on the constraints, or of its neighbours, where those of the state
/// itself are no good.
#[cold]
#[inline(never)]
fn settled<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Option<[S::Scalar; N]>
where
    S: Surface<N, K, C>,
{
    let (near, balance) = nearest(system, constants, state, u)?;
    if balance.independence.is_determined() {
        return Some(balance.accelerations);
    }
    let here = balance.independence;
    let through = between(system, constants, &near, &here, u);
    // Independent rows that determine the accelerations neither here nor beside here give none.
    let own = if here.rank < here.rows { balance.accelerations } else { [S::Scalar::from_f64(f64::NAN); N] };
    Some(through.unwrap_or(own))
}

/// A state on the constraints, and the equations there.
type Settled<R, const N: usize, const C: usize> = (State<R, N>, Balance<R, N, C>);

/// The nearest state on the constraints, and the equations there.
fn nearest<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Option<Settled<S::Scalar, N, C>>
where
    S: Surface<N, K, C>,
{
    let mut near = *state;
    project(system, &mut near, None).ok()?;
    let balance = system.balance_at(constants, near.t, &near.q, &near.v, u);
    Some((near, balance))
}

/// The first neighbours are so many times ∜ε of the time in which coordinates change by their size away.
const CLOSE: f64 = 0.125;

/// How often neighbours may be moved further away, by the factor [`WIDER`], until they are well determined.
const WIDENINGS: usize = 10;

/// See [`WIDENINGS`].
const WIDER: f64 = 2.0;

/// Accelerations by interpolation between six neighbours, three on each side along the velocity. The rows have to be
/// more independent there than `here`. `None` where no such neighbours exist, because the rows depend on each other
/// everywhere or because nothing moves.
fn between<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    constants: &S::Constants,
    state: &State<S::Scalar, N>,
    here: &Independence<S::Scalar>,
    u: &[S::Scalar; K],
) -> Option<[S::Scalar; N]>
where
    S: Surface<N, K, C>,
{
    let number = S::Scalar::from_f64;
    let well = determined::<S::Scalar>();
    let mut apart = number(CLOSE) * well * travel_time(system, state)?;
    let none = [num_traits::Zero::zero(); N];
    for _ in 0..WIDENINGS {
        let at = |place: f64| {
            let there = moved(state, &state.v, &none, number(place) * apart);
            let (_, balance) = nearest(system, constants, &there, u)?;
            balance.independence.improves(here, well).then_some(balance.accelerations)
        };
        let sum = |near: f64| {
            let (a, b) = (at(-near)?, at(near)?);
            Some(core::array::from_fn::<_, N, _>(|i| a[i] + b[i]))
        };
        if let (Some(a), Some(b), Some(c)) = (sum(1.0), sum(2.0), sum(3.0)) {
            let weights = [0.75, -0.3, 0.05].map(number);
            return Some(core::array::from_fn(|i| weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i]));
        }
        apart *= number(WIDER);
    }
    None
}

/// The time \[s] in which the coordinates change by their size, in the kinetic metric; `None` at rest.
pub(crate) fn travel_time<S, const N: usize, const K: usize, const C: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
) -> Option<S::Scalar>
where
    S: Surface<N, K, C>,
{
    let (saddle, _) = system.saddle_at(state.t, &state.q, &state.v);
    let metric = Metric::of(&saddle);
    let time = metric.extent(&state.q) / metric.extent(&state.v);
    (time.is_finite() && time.is_positive()).then_some(time)
}
