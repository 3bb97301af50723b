//! Laws on one side of kinks.

use super::{Functions, Laws, Regime, Row, Switching, Wanted};
use crate::number::elements::{Each, array};
use crate::number::real::{Dual, Real};
use crate::system::state::State;

/// The numbers that decide about regimes, at a state, on these sides of the kinks. A state on a kink does not
/// tell its side, but its gaps open or close as they do there.
pub(super) fn laws_on<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    inputs: &[S::Scalar; K],
    kinks: &[S::Scalar; W],
) -> Laws<S::Scalar, C, W>
where
    S: Switching<N, K, C, W>,
{
    let mut laws = system.laws_at(state.t, &state.q, &state.v, inputs);
    if const { C > 0 && W > 0 } {
        let tells = |(&side, &value): (&S::Scalar, &S::Scalar)| (side * value).is_positive();
        if !kinks.iter().zip(&laws.kinks).all(tells) {
            take_side(system, state, inputs, kinks, &mut laws);
        }
    }
    laws
}

/// Sets gaps and their rates, and slip velocities, to those on these sides.
#[cold]
fn take_side<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    inputs: &[S::Scalar; K],
    kinks: &[S::Scalar; W],
    laws: &mut Laws<S::Scalar, C, W>,
) where
    S: Switching<N, K, C, W>,
{
    let wanted = Wanted { rows: [true; C], fixed: [false; C], kinks: [false; W] };
    let functions = along(system, state, &[num_traits::Zero::zero(); N], inputs, kinks, &wanted);
    let positions = laws.rows.positions.iter_mut().zip(&mut laws.rows.position_sizes);
    let rates = laws.rows.rates.iter_mut().zip(&mut laws.rows.rate_sizes);
    let rows = positions.zip(rates).zip(S::ROWS.iter().zip(&functions.rows));
    for (((position, extent), (rate, size)), (kind, function)) in rows {
        match kind {
            // The derivative of a gap along the motion is its rate. Slip velocities are no rates.
            Row::Unilateral => {
                (*position, *rate) = (function.value, function.slopes[0]);
                if !extent.is_finite() || (position.abs() - *extent).is_positive() {
                    *extent = position.abs();
                }
            }
            Row::Friction { .. } => *rate = function.value,
            Row::Bilateral | Row::Load => continue,
        }
        // Where the function of another side has no gradient, its summands have no size, either.
        if !size.is_finite() || (rate.abs() - *size).is_positive() {
            *size = rate.abs();
        }
    }
}

/// Turns the kinks on which a state `lies` to the sides that the motion goes to with these accelerations.
/// Returns whether any has another side now.
#[cold]
pub(super) fn turn_ahead<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    accelerations: &[S::Scalar; N],
    inputs: &[S::Scalar; K],
    lies: &[bool; W],
    kinks: &mut [S::Scalar; W],
) -> bool
where
    S: Switching<N, K, C, W>,
{
    if !lies.contains(&true) {
        return false;
    }
    let wanted = Wanted { rows: [false; C], fixed: [false; C], kinks: *lies };
    let functions = along(system, state, accelerations, inputs, kinks, &wanted);
    let mut has_turned = false;
    for ((side, function), _) in kinks.iter_mut().zip(&functions.kinks).zip(lies).filter(|(_, lies)| **lies) {
        if (-*side * function.slopes[0]).is_positive() {
            (*side, has_turned) = (-*side, true);
        }
    }
    has_turned
}

/// Functions on these sides of the kinks, and their rates along a motion with these accelerations.
pub(super) fn along<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    accelerations: &[S::Scalar; N],
    inputs: &[S::Scalar; K],
    kinks: &[S::Scalar; W],
    wanted: &Wanted<C, W>,
) -> Functions<Dual<S::Scalar, 1>, C, W>
where
    S: Switching<N, K, C, W>,
{
    let in_regime = system.in_regime(&Regime { kinks: *kinks, ..Regime::open(&S::ROWS) });
    let moving = |value: S::Scalar, rate: S::Scalar| Dual::<_, 1> { value, slopes: [rate] };
    let t = moving(state.t, num_traits::One::one());
    let q = array(|i| moving(state.q[i], state.v[i]));
    let v = array(|i| moving(state.v[i], accelerations[i]));
    S::functions_in(&in_regime, Dual::constant, t, &q, &v, &inputs.each(Dual::constant), wanted)
}
