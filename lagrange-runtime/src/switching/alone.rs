//! Accelerations and reactions at a state alone, without a motion that leads there.

use super::choice::Choice;
use super::kinks::sides;
use super::known::Known;
use super::scales::Scales;
use super::scene::{Scene, Sticking};
use super::{Regime, Row, Switching};
use crate::number::real::Real;
use crate::system::System;
use crate::system::state::State;

/// A state alone, without a motion that leads there, and the regime that goes on from it; `None` where the
/// laws of contact have no solution, or several.
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
    let known = Known::alone();
    let scene = Scene::new(system, &state, u, kinks, &Scales::new(), &known);
    // As where a motion begins there, a body bears on all its feet.
    let choice = scene.choose(&scene.touching(&open), None).ok()?;
    Some((scene, choice))
}

/// Accelerations at a state; NaN where the laws of contact have no solution, or several.
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

/// The multipliers of all rows at a state, and whether the motion determines each. If not, they are the
/// shortest that are possible, or with loads just possible ones. NaN and false where the laws of contact have
/// no solution, or several.
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
    let v = &choice.velocities;
    // A friction that slips is no constraint: its force is that of its law, against the slip.
    let with_slips = |regime: &Regime<_, C, W>, drags: &[S::Scalar; C], mut multipliers: [S::Scalar; C]| {
        for (row, kind) in S::ROWS.iter().enumerate() {
            if let Row::Friction { normal, .. } = *kind
                && !regime.active[row]
            {
                let load = normal.map_or(num_traits::One::one(), |normal| multipliers[normal].abs());
                multipliers[row] = drags[row] * load;
            }
        }
        multipliers
    };
    let multipliers = with_slips(&choice.regime, &scene.drags(&choice.regime, v), choice.multipliers);
    let bearing = scene.bearing(&choice);
    if scene.determines(&bearing, v) {
        return (multipliers, true);
    }
    let drags = scene.drags(&bearing, v);
    let shortest = scene.shortest(&bearing, &drags, &multipliers, Sticking::ByForces);
    (shortest.map_or(multipliers, |shortest| with_slips(&bearing, &drags, shortest)), false)
}
