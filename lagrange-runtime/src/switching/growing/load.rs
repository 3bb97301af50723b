//! The load that makes slips begin, at a later time.

use super::super::known::Known;
use super::super::scales::Scales;
use super::super::scene::{Scene, Status, above, entry, most, put};
use super::super::way::shift;
use super::super::{Regime, Switching};
use crate::number::elements::{Each, array};
use crate::number::real::{Ordered, Real};
use crate::system::System;
use crate::system::state::State;

/// The load at a later time.
pub(super) struct Load<R, const N: usize, const C: usize> {
    /// The time \[s] from now.
    pub(super) later: R,
    pub(super) accelerations: [R; N],
    /// The accelerations of slips that begin.
    pub(super) rates: [R; C],
    /// What forces could give each slip \[slip/s].
    pub(super) sizes: [R; C],
    /// The accelerations of each slip as parts of that: now and then.
    parts: [[R; C]; 2],
}

impl<R: Real, const N: usize, const C: usize> Load<R, N, C> {
    /// The largest acceleration of a slip, at least zero.
    pub(super) fn most(&self) -> R {
        self.parts[1].iter().fold(R::zero(), |a, &b| most(a, b))
    }

    /// Whether slips are driven in the `middle` of the time as by a load that grows linearly, up to a tenth.
    /// Forces, too, are at most twice as large at the end. Those of a motion that has run away grow like the
    /// squares of its velocities, and in their rounding errors all others would vanish.
    pub(super) fn is_even(&self, middle: &Self) -> bool {
        let (half, tenth) = (R::from_f64(0.5), R::from_f64(0.1));
        let twice = R::from_f64(2.0) + tenth;
        (0..C).all(|row| {
            let [start, end] = self.parts.each(|parts| entry(&parts, row));
            let part = entry(&middle.parts[1], row);
            !above((part - half * (start + end)).abs(), tenth * most(start, end))
                && !above(entry(&self.sizes, row), twice * entry(&middle.sizes, row))
        })
    }
}

/// The reason why there is no such motion for a time.
pub(super) enum Not<R, const C: usize, const W: usize> {
    /// The load has not grown beyond what friction holds, or not evenly, or no motion is found.
    Grown,
    /// The motion obeys the equations no better in a shorter time.
    Strays,
    /// Another regime has begun meanwhile.
    Alone(Regime<R, C, W>),
}

impl<S, const N: usize, const K: usize, const C: usize, const W: usize> Scene<'_, S, N, K, C, W>
where
    S: Switching<N, K, C, W>,
    S::Scalar: Ordered,
{
    /// The load after a time \[s], with the accelerations `a` now.
    pub(super) fn load_at(
        &self,
        regime: Regime<S::Scalar, C, W>,
        a: &[S::Scalar; N],
        scales: &Scales<S::Scalar, C>,
        later: S::Scalar,
    ) -> Result<Load<S::Scalar, N, C>, Not<S::Scalar, C, W>> {
        let zero: S::Scalar = num_traits::Zero::zero();
        let begins = self.beginning(&regime);
        let in_regime = self.system.in_regime(&begins.held(&regime));
        let state = self.moved(&in_regime, a, later).ok_or(Not::Grown)?;
        // Contacts that bear and friction at rest: the state has been projected onto them, so that what is
        // left of their rates is rounding errors.
        let rested = array(|row| match self.status.get(row) {
            Some(Status::Touches) => regime.active.get(row) == Some(&true),
            status => status == Some(&Status::Rests),
        });
        let known = Known { rested, ..Known::settled(self.is_closed) };
        let scene = Scene::new(self.system, &state, self.inputs, self.kinks, scales, &known);
        let there = scene.choose(&regime, None).map_err(|_| Not::Grown)?;
        let slips = |row: usize| entry(&there.regime.slip, row) != zero;
        if !begins
            .slips(&S::ROWS)
            .all(|rows| scene.status.get(rows[0]) == Some(&Status::Rests) && slips(rows[0]))
        {
            return Err(Not::Grown);
        }
        if there.regime != regime {
            return Err(Not::Alone(there.regime));
        }
        let (mut parts, mut rates, mut sizes) = ([[zero; C]; 2], [zero; C], [zero; C]);
        for rows in begins.slips(&S::ROWS) {
            let strength = scene.strength(rows, &there.sizes.accelerations);
            put(&mut sizes, rows[0], strength);
            put(&mut parts[0], rows[0], self.driven_part(rows, a, strength));
            put(&mut parts[1], rows[0], scene.driven_part(rows, &there.accelerations, strength));
            for row in rows {
                put(&mut rates, row, scene.rate(row, &there.accelerations));
            }
        }
        Ok(Load { later, accelerations: there.accelerations, rates, sizes, parts })
    }

    /// The acceleration of a slip, as a part of what the forces could give it, its `strength`.
    pub(super) fn driven_part(
        &self,
        rows: [usize; 2],
        accelerations: &[S::Scalar; N],
        strength: S::Scalar,
    ) -> S::Scalar {
        let [x, y] = rows.each(|row| self.rate(row, accelerations));
        // A number alone: the time that follows from it has no variation.
        if strength.is_positive() { (x.hypot(y) / strength).part(0) } else { num_traits::Zero::zero() }
    }

    /// The state after a time with constant accelerations, on the constraints of a regime.
    pub(in crate::switching) fn moved(
        &self,
        in_regime: &S::InRegime,
        a: &[S::Scalar; N],
        later: S::Scalar,
    ) -> Option<State<S::Scalar, N>> {
        let mut state = self.state;
        shift(&mut state, a, later);
        state.t += later;
        in_regime.project_at(&in_regime.constants(), &mut state, None).ok()?;
        Some(state)
    }
}
