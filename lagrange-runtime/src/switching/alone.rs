//! Accelerations and reactions at a state alone, without a motion that leads there.

use super::choice::{Choice, sides};
use super::scene::{Known, Scales, Scene, Status, above, against, entry, extent, rounding};
use super::{Regime, Row, Switching};
use crate::number::real::Real;
use crate::system::System;
use crate::system::state::State;

/// A state alone, without a motion that leads there, and the regime that goes on from it.
fn at_state<'a, S, const N: usize, const K: usize, const C: usize, const W: usize>(
    system: &'a S,
    t: S::Scalar,
    q: &[S::Scalar; N],
    v: &[S::Scalar; N],
    u: &'a [S::Scalar; K],
) -> Option<(Scene<'a, S, N, K, C, W>, Choice<S::Scalar, N, C, W>)>
where
    S: Switching<N, K, C, W>,
{
    let laws = system.laws_at(t, q, v, u);
    let open = Regime::<S::Scalar, C, W>::open(&S::ROWS);
    let kinks = sides(&laws.kinks, &open.kinks, &laws.kink_sizes);
    let state = State { t, q: *q, v: *v };
    let known = Known { closed: [false; C], fired: None, settled: true };
    let scene = Scene::new(system, &state, u, kinks, &Scales::new(), &known);
    let choice = scene.choose(&open, None).ok()?;
    Some((scene, choice))
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
    at_state(system, t, q, v, u).map_or_else(none, |(_, choice)| choice.accelerations)
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
    let Some((scene, choice)) = at_state(system, t, q, v, u) else { return none() };
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
    (multipliers, scene.determines(&choice))
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
{
    /// Whether the motion determines each reaction: what touches and rests may bear, whether it does in this
    /// choice or not, and none of these rows depends on the others.
    fn determines(&self, choice: &Choice<S::Scalar, N, C, W>) -> bool {
        let zero = num_traits::Zero::zero();
        let stays = |row: usize| {
            let Some(gradient) = self.gradients.get(row) else { return false };
            let size = extent(gradient, &choice.sizes.accelerations) + entry(&self.gamma, row).abs();
            !above(self.rate(row, &choice.accelerations).abs(), rounding::<S::Scalar>() * size)
        };
        let touches = |row: usize| matches!(self.status[row], Status::Touches | Status::Meets) && stays(row);
        let mut regime = choice.regime;
        for (row, kind) in S::ROWS.iter().enumerate() {
            let bears = match *kind {
                Row::Unilateral => touches(row),
                Row::Friction { normal, .. } => {
                    let is_rough = self.coefficients.iter().any(|side| entry(&side.fixed, row) != zero);
                    let is_pressed =
                        normal.is_none_or(|normal| S::ROWS[normal] != Row::Unilateral || touches(normal));
                    self.status[row] == Status::Rests && is_rough && is_pressed && stays(row)
                }
                Row::Bilateral | Row::Load => false,
            };
            if bears {
                (regime.active[row], regime.slip[row]) = (true, zero);
            }
        }
        let State { t, q, .. } = &self.state;
        let in_regime = self.system.in_regime(&regime);
        S::equations_in(&in_regime, *t, q, &choice.velocities, self.inputs).is_some_and(|equations| {
            let independence = equations.balance().independence;
            independence.rank == independence.rows
        })
    }
}
