//! Accelerations and reactions at a state alone, without a motion that leads there.

use super::choice::{Choice, sides};
use super::scene::{Known, Scales, Scene, against};
use super::{Regime, Row, Switching};
use crate::number::real::Real;
use crate::system::System;
use crate::system::state::State;

/// The regime that goes on from a state alone, without a motion that leads there.
fn at_state<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    system: &S,
    t: S::Scalar,
    q: &[S::Scalar; N],
    v: &[S::Scalar; N],
    u: &[S::Scalar; K],
) -> Option<Choice<S::Scalar, N, C, W>>
where
    S: Switching<N, K, C, W>,
{
    let laws = system.laws_at(t, q, v, u);
    let open = Regime::<S::Scalar, C, W>::open(&S::ROWS);
    let kinks = sides(&laws.kinks, &open.kinks, &laws.kink_sizes);
    let state = State { t, q: *q, v: *v };
    let known = Known { closed: [false; C], fired: None, settled: true };
    let scene = Scene::new(system, &state, u, kinks, &Scales::new(), &known);
    scene.choose(&open, None).ok()
}

/// Accelerations at a state; NaN where the laws of contact have no solution.
#[doc(hidden)]
#[must_use]
pub fn accelerations<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    system: &S,
    t: S::Scalar,
    q: &[S::Scalar; N],
    v: &[S::Scalar; N],
    u: &[S::Scalar; K],
) -> [S::Scalar; N]
where
    S: Switching<N, K, C, W>,
{
    if C == 0 {
        let laws = system.laws_at(t, q, v, u);
        let above = [num_traits::One::one(); W];
        let kinks = sides(&laws.kinks, &above, &laws.kink_sizes);
        let in_regime = system.in_regime(&Regime { kinks, ..Regime::open(&S::ROWS) });
        return in_regime.accelerations_at(&in_regime.constants(), t, q, v, u);
    }
    let none = || [S::Scalar::from_f64(f64::NAN); N];
    at_state(system, t, q, v, u).map_or_else(none, |choice| choice.accelerations)
}

/// The multipliers of all rows at a state, and whether the motion determines each; NaN where the laws of
/// contact have no solution.
#[doc(hidden)]
#[must_use]
pub fn multipliers<S, const N: usize, const K: usize, const C: usize, const W: usize>(
    system: &S,
    t: S::Scalar,
    q: &[S::Scalar; N],
    v: &[S::Scalar; N],
    u: &[S::Scalar; K],
) -> ([S::Scalar; C], bool)
where
    S: Switching<N, K, C, W>,
{
    let none = || ([S::Scalar::from_f64(f64::NAN); C], false);
    let Some(choice) = at_state(system, t, q, v, u) else { return none() };
    let mut multipliers = choice.multipliers;
    // What slips is no constraint: its force is that of its law, against the slip.
    let laws = system.laws_at(t, q, &choice.velocities, u);
    let coefficients = system.coefficients_at(t, q, &choice.velocities, u, &laws);
    for (row, kind) in S::ROWS.iter().enumerate() {
        let Row::Friction { normal, pair } = *kind else { continue };
        let carrier = pair.map_or(row, |other| row.min(other));
        let slip = choice.regime.slip[carrier];
        if choice.regime.active[row] || slip == num_traits::Zero::zero() {
            continue;
        }
        let direction = match pair {
            None => slip,
            Some(other) => laws.rows.rates[row] / laws.rows.rates[row].hypot(laws.rows.rates[other]),
        };
        let load = normal.map_or(num_traits::One::one(), |normal| choice.multipliers[normal].abs());
        multipliers[row] = -(against(&coefficients, slip).kinetic[row] * load * direction);
    }
    (multipliers, choice.is_unique)
}
